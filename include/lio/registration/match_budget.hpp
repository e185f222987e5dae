// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Counts the full matches of one scan, that is of all its points to match, and bounds them, so that
// a search cannot hold up the scans behind.
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
  int num_left() const { return num_left_; }
  int num_taken() const { return num_taken_; }

 private:
  int num_left_;
  int num_taken_ = 0;
};

}  // namespace lio
