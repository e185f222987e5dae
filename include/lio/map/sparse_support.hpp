// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Do so few of a scan's points lie on surfaces of the map that larger cells must help? Beams that
// are far apart leave most small cells with a single ring, which shows no surface.
#pragma once

#include <optional>

namespace lio {

class SparseSupport {
 public:
  // `share` of a scan's points lies on surfaces without the help of larger cells.
  void Add(double share);
  // Nothing was added yet.
  [[nodiscard]] bool is_unknown() const { return !mean_share_; }
  [[nodiscard]] bool is_sparse() const { return is_sparse_; }

 private:
  std::optional<double> mean_share_;  // an exponential mean over scans
  bool is_sparse_ = false;
};

}  // namespace lio
