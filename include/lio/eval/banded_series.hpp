// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Normalised errors of many runs over time, against the bands in which honest ones lie: what both
// lio-eval and the Monte Carlo tests of the filter judge by. "Per dof" means divided by the number
// of dimensions: 1 is honest, above 1 over-confident, below 1 timid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "lio/eval/chi_square.hpp"

namespace lio {

struct TimedValue {
  double time_s = 0;
  double value = 0;
};
using TimedValues = std::vector<TimedValue>;  // of one run, in time order

double Mean(const TimedValues& values);  // 0 without values

// The mean over the runs at each instant, and the 95 % band in which it belongs.
struct BandedSeries {
  int dof = 0;
  std::vector<double> time_s;
  std::vector<double> mean_per_dof;
  std::vector<Band> band_per_dof;  // of that many runs
  double average_per_dof = 0;      // over all instants of all runs: ANEES (ANIS) / dof
  double end_average_per_dof = 0;  // over the last tenth of the time
  double share_in_band = 0;        // of the instants, 0..1
};

// Of squares that are chi-square with `dof` when honest; at least one value. Instants of different
// runs meet when they are as late, to half a median interval.
BandedSeries MakeBandedSeries(const std::vector<TimedValues>& runs, int dof);

// Autocorrelation, averaged over runs: white values stay within +-1.96 / sqrt(N), N the number of
// products.
struct Whiteness {
  std::vector<double> autocorrelation;  // of lag 1, 2, ... 20
  std::vector<double> band;             // half width, a lag
  double share_in_band = 0;
};

// About `mean`; absent: about the mean of each run.
Whiteness ComputeWhiteness(const std::vector<TimedValues>& runs, std::optional<double> mean);

// Shares of |error| inside 1, 2, 3 sigma; Gaussian: 0.683, 0.954, 0.997.
using SigmaShares = std::array<double, 3>;
SigmaShares SharesWithin(const std::vector<double>& errors_in_sigmas);

// e' C^-1 e: chi-square with the size of e as dof, when e is a draw from N(0, C). `cov` must be
// positive definite.
double NormalisedSquare(const Eigen::VectorXd& error, const Eigen::MatrixXd& cov);

}  // namespace lio
