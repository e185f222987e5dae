// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the bands in which means of chi-square values lie: Bar-Shalom, Li, Kirubarajan, "Estimation
// with Applications to Tracking and Navigation", 2001, section 5.4.
#pragma once

namespace lio {

struct Band {
  double low = 0;
  double high = 0;

  [[nodiscard]] bool Contains(double value) const { return value >= low && value <= high; }
};

// Returns the interval in which the mean of `num_runs` independent chi2(dof) values, divided by
// dof, lies with 95 % probability; both tails are equally likely. A consistent estimator's expected
// value is 1.
[[nodiscard]] Band MeanBandPerDof(int dof, int num_runs);

}  // namespace lio
