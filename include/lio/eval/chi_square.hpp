// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The bands in which means of chi-square values lie: Bar-Shalom, Li, Kirubarajan, "Estimation with
// Applications to Tracking and Navigation", 2001, section 5.4.
#pragma once

namespace lio {

struct Band {
  double low = 0;
  double high = 0;

  bool Contains(double value) const { return value >= low && value <= high; }
};

// Where the mean of `num_runs` independent chi2(dof) values lies with 95 % probability, both tails
// cut alike. Divided by dof: 1 is in the middle.
Band MeanBandPerDof(int dof, int num_runs);

}  // namespace lio
