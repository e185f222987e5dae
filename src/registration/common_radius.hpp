// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The correspondence radius of all points alike: how far off the guess may be, one standard
// deviation, at a range of CorrespondenceParameters::kLever_m. search_radius.hpp has one for each
// range.
#pragma once

#include <algorithm>
#include <cmath>

#include "lio/base/pose.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

class CommonRadius {
 public:
  explicit CommonRadius(const Matrix6& guess_cov) {
    const double translation_var = guess_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
    const double rotation_var = guess_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
    Set(std::min(std::sqrt(std::max(0.0, translation_var) +
                           std::max(0.0, rotation_var) * kLever_m * kLever_m),
                 Parameters::kMaxStd_m));
  }
  [[nodiscard]] double std_m() const { return std_m_; }
  [[nodiscard]] float variance() const { return static_cast<float>(std_m_ * std_m_); }
  void Shrink() { Set(Parameters::kShrink * std_m_); }
  [[nodiscard]] bool IsExhausted() const { return std_m_ == 0.0; }

 private:
  using Parameters = CorrespondenceParameters;
  static constexpr double kLever_m = Parameters::kLever_m;

  void Set(double std_m) { std_m_ = std_m < Parameters::kSmallestStd_m ? 0.0 : std_m; }

  double std_m_ = 0.0;
};

}  // namespace lio
