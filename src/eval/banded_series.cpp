// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/banded_series.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "lio/eval/statistics.hpp"

namespace lio {
namespace {

constexpr double kEndShare = 0.1;
constexpr int kMaxLag = 20;

double MedianInterval(const std::vector<TimedValues>& runs) {
  std::vector<double> intervals;
  for (const TimedValues& run : runs) {
    for (std::size_t i = 1; i < run.size(); ++i) {
      intervals.push_back(run[i].time_s - run[i - 1].time_s);
    }
  }
  return intervals.empty() ? 1.0 : Median(std::move(intervals));
}

}  // namespace

double Mean(const TimedValues& values) {
  double sum = 0;
  for (const TimedValue& value : values) sum += value.value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

BandedSeries MakeBandedSeries(const std::vector<TimedValues>& runs, int dof) {
  struct Bin {
    double sum = 0;
    int count = 0;
  };
  const double interval_s = MedianInterval(runs);
  std::map<std::int64_t, Bin> bins;
  double sum = 0;
  int count = 0;
  for (const TimedValues& run : runs) {
    for (const TimedValue& sample : run) {
      Bin& bin = bins[std::llround(sample.time_s / interval_s)];
      bin.sum += sample.value;
      ++bin.count;
      sum += sample.value;
      ++count;
    }
  }
  BandedSeries series;
  series.dof = dof;
  series.average_per_dof = sum / (static_cast<double>(count) * dof);
  int num_inside = 0;
  double end_sum = 0;
  int end_count = 0;
  const double span = static_cast<double>(bins.rbegin()->first - bins.begin()->first);
  const double end_begin = static_cast<double>(bins.rbegin()->first) - kEndShare * span;
  std::map<int, Band> bands;  // keyed by number of runs, because computing quantiles is slow
  for (const auto& [index, bin] : bins) {
    if (!bands.contains(bin.count)) bands[bin.count] = MeanBandPerDof(dof, bin.count);
    series.time_s.push_back(static_cast<double>(index) * interval_s);
    series.mean_per_dof.push_back(bin.sum / (static_cast<double>(bin.count) * dof));
    series.band_per_dof.push_back(bands[bin.count]);
    num_inside += series.band_per_dof.back().Contains(series.mean_per_dof.back()) ? 1 : 0;
    if (static_cast<double>(index) < end_begin) continue;
    end_sum += bin.sum;
    end_count += bin.count;
  }
  series.share_in_band = static_cast<double>(num_inside) / static_cast<double>(bins.size());
  series.end_average_per_dof = end_sum / (static_cast<double>(end_count) * dof);
  return series;
}

Whiteness ComputeWhiteness(const std::vector<TimedValues>& runs, std::optional<double> mean) {
  Whiteness whiteness;
  int num_inside = 0;
  for (int lag = 1; lag <= kMaxLag; ++lag) {
    double products = 0, squares = 0, num_products = 0, num_squares = 0;
    for (const TimedValues& run : runs) {
      const double centre = mean ? *mean : Mean(run);
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double value = run[i].value - centre;
        squares += value * value;
        ++num_squares;
        if (i + static_cast<std::size_t>(lag) >= run.size()) continue;
        products += value * (run[i + static_cast<std::size_t>(lag)].value - centre);
        ++num_products;
      }
    }
    if (num_products < 2 || squares <= 0) break;
    const double rho = (products / num_products) / (squares / num_squares);
    const double band = 1.96 / std::sqrt(num_products);
    whiteness.autocorrelation.push_back(rho);
    whiteness.band.push_back(band);
    num_inside += std::abs(rho) <= band ? 1 : 0;
  }
  if (!whiteness.band.empty()) {
    whiteness.share_in_band = num_inside / static_cast<double>(whiteness.band.size());
  }
  return whiteness;
}

SigmaShares SharesWithin(const std::vector<double>& errors_in_sigmas) {
  SigmaShares shares{};
  for (const double sigmas : errors_in_sigmas) {
    for (int i = 0; i < 3; ++i) shares[i] += std::abs(sigmas) <= i + 1 ? 1 : 0;
  }
  for (double& share : shares) share /= static_cast<double>(errors_in_sigmas.size());
  return shares;
}

double NormalisedSquare(const Eigen::VectorXd& error, const Eigen::MatrixXd& cov) {
  return error.dot(cov.ldlt().solve(error));
}

}  // namespace lio
