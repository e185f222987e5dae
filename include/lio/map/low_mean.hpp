// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is the mean of a figure over scans low? Two limits keep the answer from changing to and fro.
#pragma once

#include <optional>

namespace lio {

class LowMean {
 public:
  // The mean becomes low below the first limit, and enough again above the second.
  void Add(double value, double low_below, double enough_above);
  // Nothing was added yet.
  [[nodiscard]] bool is_unknown() const { return !mean_; }
  [[nodiscard]] bool is_low() const { return is_low_; }

 private:
  std::optional<double> mean_;  // an exponential mean over scans
  bool is_low_ = false;
};

}  // namespace lio
