// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a function of time at one instant with its first two derivatives. Sums, products, sine and
// cosine of such values are exact, so a pose written in them carries its velocity and acceleration.
#pragma once

#include <cmath>

namespace lio::sim {

struct Jet {
  double value = 0.0;
  double rate = 0.0;   // d/dt
  double accel = 0.0;  // d2/dt2

  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.rate + b.rate, a.accel + b.accel};
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    return {a.value - b.value, a.rate - b.rate, a.accel - b.accel};
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate,
            a.accel * b.value + 2.0 * a.rate * b.rate + a.value * b.accel};
  }
  friend Jet operator*(double a, const Jet& b) { return {a * b.value, a * b.rate, a * b.accel}; }
};

struct SinCos {
  Jet sin;
  Jet cos;
};

[[nodiscard]] inline SinCos SinCosOf(const Jet& x) {
  const double s = std::sin(x.value);
  const double c = std::cos(x.value);
  const double rate_sq = x.rate * x.rate;
  return {{s, c * x.rate, c * x.accel - s * rate_sq}, {c, -s * x.rate, -s * x.accel - c * rate_sq}};
}

}  // namespace lio::sim
