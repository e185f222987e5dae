// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares normalised errors of many runs over time with the bands in which those of a consistent
// estimator lie. Both lio-eval and the filter's Monte Carlo tests use it. "Per dof" means divided
// by the number of dimensions: 1 is consistent, above 1 over-confident, below 1 conservative.
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
using TimedValues = std::vector<TimedValue>;  // values of one run, in the order of time

[[nodiscard]] double Mean(const TimedValues& values);  // 0 for no values

// Holds the mean over the runs at each instant, and its 95 % band.
struct BandedSeries {
  int dof = 0;
  std::vector<double> time_s;
  std::vector<double> mean_per_dof;
  std::vector<Band> band_per_dof;  // band for the number of runs at that instant
  double average_per_dof = 0;      // over all instants of all runs: ANEES (ANIS) / dof
  double end_average_per_dof = 0;  // average over the last tenth of the time
  double share_in_band = 0;        // share of the instants inside the band, 0..1
};

// The values must be chi-square distributed with `dof` when the estimator is consistent; at least
// one value is required. Instants of different runs are joined when their times since the start
// agree to half a median interval.
[[nodiscard]] BandedSeries MakeBandedSeries(const std::vector<TimedValues>& runs, int dof);

// Holds the autocorrelation averaged over runs: that of white values stays within +-1.96 / sqrt(N),
// N the number of products.
struct Whiteness {
  std::vector<double> autocorrelation;  // at lags 1, 2, ... 20
  std::vector<double> band;             // half width for each lag
  double share_in_band = 0;
};

// Computes the autocorrelation about `mean`; when absent, about the mean of each run.
[[nodiscard]] Whiteness ComputeWhiteness(const std::vector<TimedValues>& runs,
                                         std::optional<double> mean);

// Holds the shares of |error| inside 1, 2 and 3 sigma; for a Gaussian: 0.683, 0.954, 0.997.
using SigmaShares = std::array<double, 3>;
[[nodiscard]] SigmaShares SharesWithin(const std::vector<double>& errors_in_sigmas);

// Returns e' C^-1 e, which is chi-square with the size of e as dof when e is a draw from N(0, C).
// `cov` must be positive definite.
[[nodiscard]] double NormalisedSquare(const Eigen::VectorXd& error, const Eigen::MatrixXd& cov);

}  // namespace lio
