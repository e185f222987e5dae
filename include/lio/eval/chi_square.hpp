// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The chi-square distribution, exactly (Boost.Math), and the bands that follow from it: Bar-Shalom,
// Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, section 5.4.
#pragma once

namespace lio {

// The x with P(chi2(dof) <= x) = probability; dof > 0, probability in (0, 1).
double ChiSquareQuantile(double probability, double dof);

struct Band {
  double low = 0;
  double high = 0;

  bool Contains(double value) const { return value >= low && value <= high; }
};

// Where the mean of `num_runs` independent chi2(dof) values lies with 95 % probability, both tails
// cut alike. Divided by dof: 1 is in the middle.
Band MeanBandPerDof(int dof, int num_runs);

}  // namespace lio
