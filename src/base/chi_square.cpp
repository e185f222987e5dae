// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/chi_square.hpp"

#include <cmath>
#include <stdexcept>

namespace lio {

double ChiSquareCdf6(double x) {
  if (x <= 0) return 0.0;
  const double h = 0.5 * x;
  return 1.0 - std::exp(-h) * (1.0 + h + 0.5 * h * h);
}

double ChiSquareQuantile6(double probability) {
  if (!(probability >= 0.0 && probability < 1.0)) {
    throw std::invalid_argument("ChiSquareQuantile6: probability outside [0, 1)");
  }
  double low = 0.0;
  double high = 1.0;
  while (ChiSquareCdf6(high) < probability && high < 1e4) high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (ChiSquareCdf6(middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace lio
