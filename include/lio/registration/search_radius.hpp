// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How far off a point may appear on the map, from what is known of the guess: one sigma, by the
// point's range, since a rotation error is felt more by far points. Shrinks as a match closes in.
// So the same settings serve a room and a motorway, a good guess and a poor one.
#pragma once

#include <cmath>

#include "lio/base/pose.hpp"

namespace lio {

class SearchRadius {
 public:
  // `guess_cov`: right error, [translation; rotation].
  explicit SearchRadius(const Matrix6& guess_cov)
      : translation_var_(LargestVariance(guess_cov.topLeftCorner<3, 3>())),
        rotation_var_(LargestVariance(guess_cov.bottomRightCorner<3, 3>())) {}

  // Standard deviation of where a point at this range appears [m].
  double StdAt(double range_m) const {
    const double std = std::sqrt(translation_var_ + rotation_var_ * range_m * range_m);
    return share_ * std::fmin(std, kMaxStd_m);
  }
  // After a step toward the solution.
  void Shrink() {
    share_ *= kShrink;
    if (share_ * std::sqrt(translation_var_ + rotation_var_ * kLever_m * kLever_m) < kSmallest_m) {
      share_ = 0.0;
    }
  }
  bool IsExhausted() const { return share_ == 0.0; }

 private:
  static constexpr double kShrink = 0.3;
  static constexpr double kMaxStd_m = 2.0;  // beyond it nearest neighbours mean nothing
  static constexpr double kLever_m = 20.0;
  static constexpr double kSmallest_m = 0.01;

  static double LargestVariance(const Matrix3& cov) {
    return std::fmax(0.0, cov.diagonal().maxCoeff());
  }

  double translation_var_;
  double rotation_var_;
  double share_ = 1.0;
};

}  // namespace lio
