// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/jet.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

// Returns f(t) with its first two derivatives at an instant.
Jet Cubic(double t) {
  return {t * t * t - 2.0 * t, 3.0 * t * t - 2.0, 6.0 * t};
}
Jet Square(double t) {
  return {t * t, 2.0 * t, 2.0};
}

void ExpectNear(const Jet& a, const Jet& b) {
  EXPECT_NEAR(a.value, b.value, 1e-12);
  EXPECT_NEAR(a.rate, b.rate, 1e-12);
  EXPECT_NEAR(a.accel, b.accel, 1e-12);
}

TEST(Jet, SumsAndMultiplesAreTermByTerm) {
  ExpectNear(Cubic(1.5) + Square(1.5), {3.375 - 3.0 + 2.25, 6.75 - 2.0 + 3.0, 9.0 + 2.0});
  ExpectNear(Cubic(1.5) - Square(1.5), {3.375 - 3.0 - 2.25, 6.75 - 2.0 - 3.0, 9.0 - 2.0});
  ExpectNear(-3.0 * Square(2.0), {-12.0, -12.0, -6.0});
}

// The product is (t^3 - 2 t) t^2 = t^5 - 2 t^3.
TEST(Jet, ProductsFollowTheProductRuleTwice) {
  const double t = 1.3;
  ExpectNear(Cubic(t) * Square(t),
             {std::pow(t, 5) - 2.0 * std::pow(t, 3), 5.0 * std::pow(t, 4) - 6.0 * t * t,
              20.0 * std::pow(t, 3) - 12.0 * t});
}

// The sine of the angle t^2 has the derivatives 2 t cos(t^2) and 2 cos(t^2) - 4 t^2 sin(t^2).
TEST(Jet, SinesFollowTheChainRuleTwice) {
  const double t = 0.9, s = std::sin(t * t), c = std::cos(t * t);
  const SinCos of = SinCosOf(Square(t));
  ExpectNear(of.sin, {s, 2.0 * t * c, 2.0 * c - 4.0 * t * t * s});
  ExpectNear(of.cos, {c, -2.0 * t * s, -2.0 * s - 4.0 * t * t * c});
}

TEST(Jet, SineAndCosineSquaredAreOneForEver) {
  const SinCos of = SinCosOf(Cubic(0.7));
  ExpectNear(of.sin * of.sin + of.cos * of.cos, {1.0, 0.0, 0.0});
}

}  // namespace
}  // namespace lio::sim
