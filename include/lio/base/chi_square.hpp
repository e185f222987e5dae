// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives quantiles of the chi-square distribution, by Boost.Math: gates on a squared, normalized
// innovation compare it with one (Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to
// Tracking and Navigation", 2001, section 5.4).
#pragma once

namespace lio {

// The x with P(chi2(dof) <= x) = probability. Throws std::invalid_argument unless
// 0 <= probability < 1 and dof > 0.
[[nodiscard]] double ChiSquareQuantile(double probability, double dof);

// Six degrees of freedom are those of a pose's innovation.
[[nodiscard]] inline double ChiSquareQuantile6(double probability) {
  return ChiSquareQuantile(probability, 6.0);
}

inline constexpr double kChiSquare3At999 =
    16.27;  // ChiSquareQuantile(0.999, 3), as tables print it

}  // namespace lio
