// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/chi_square.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace lio {

double ChiSquareQuantile(double probability, double dof) {
  if (!(probability >= 0.0 && probability < 1.0)) {
    throw std::invalid_argument("ChiSquareQuantile: probability outside [0, 1)");
  }
  if (!(dof > 0.0)) throw std::invalid_argument("ChiSquareQuantile: dof must be above zero");
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

}  // namespace lio
