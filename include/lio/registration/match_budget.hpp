// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Counts the matches of one scan. Full ones, of all its points to match, are bounded here, so that
// a search cannot hold up the scans behind; coarse ones, of a few hundred points, are bounded by
// the searches that rank their candidates by them.
#pragma once

namespace lio {

class MatchBudget {
 public:
  explicit MatchBudget(int max_matches) : num_left_(max_matches) {}

  // Takes one match; false where none is left: then it must not be run.
  [[nodiscard]] bool Take() {
    if (num_left_ == 0) return false;
    --num_left_;
    ++num_taken_;
    return true;
  }
  void CountCoarse() { ++num_coarse_; }

  int num_left() const { return num_left_; }
  int num_taken() const { return num_taken_; }
  int num_coarse() const { return num_coarse_; }

 private:
  int num_left_;
  int num_taken_ = 0;
  int num_coarse_ = 0;
};

}  // namespace lio
