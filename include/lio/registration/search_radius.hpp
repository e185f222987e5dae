// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Computes the correspondence radius: how far off a point may appear on the map, one standard
// deviation, from the covariance of the guess and the point's range, since a rotation error moves
// far points more. It shrinks as a match closes in, so that the same settings serve a room and a
// motorway, a good guess and a poor one.
#pragma once

#include <cmath>

#include "lio/base/pose.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

class SearchRadius {
 public:
  // `guess_cov` is of the right error, [translation; rotation].
  explicit SearchRadius(const Matrix6& guess_cov)
      : translation_var_(LargestVariance(guess_cov.topLeftCorner<3, 3>())),
        rotation_var_(LargestVariance(guess_cov.bottomRightCorner<3, 3>())) {}

  // Returns the standard deviation of where a point at this range appears [m].
  [[nodiscard]] double StdAt(double range_m) const {
    const double std = std::sqrt(translation_var_ + rotation_var_ * range_m * range_m);
    return share_ * std::fmin(std, Parameters::kMaxStd_m);
  }
  // Call it after a step toward the solution.
  void Shrink() {
    constexpr double kLever_m = Parameters::kLever_m;
    share_ *= Parameters::kShrink;
    const double std = std::sqrt(translation_var_ + rotation_var_ * kLever_m * kLever_m);
    if (share_ * std < Parameters::kSmallestStd_m) share_ = 0.0;
  }
  [[nodiscard]] bool IsExhausted() const { return share_ == 0.0; }

 private:
  using Parameters = CorrespondenceParameters;

  static double LargestVariance(const Matrix3& cov) {
    return std::fmax(0.0, cov.diagonal().maxCoeff());
  }

  double translation_var_;
  double rotation_var_;
  double share_ = 1.0;
};

}  // namespace lio
