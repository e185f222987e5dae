// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Computes the mean and the standard deviation of what a test measures many times.
#pragma once

namespace lio::test {

struct Spread {
  double mean = 0.0;
  double std = 0.0;
};

}  // namespace lio::test
