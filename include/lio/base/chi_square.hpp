// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The chi-square distribution with six degrees of freedom, that of a pose's innovation, and a
// quantile of that with three.
#pragma once

namespace lio {

// P(X <= x), closed form for even degrees of freedom.
double ChiSquareCdf6(double x);

// The x with ChiSquareCdf6(x) = probability, for 0 <= probability < 1.
double ChiSquareQuantile6(double probability);

inline constexpr double kChiSquare3At999 = 16.27;  // 99.9 % of it are below

}  // namespace lio
