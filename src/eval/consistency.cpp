// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/consistency.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "lio/eval/statistics.hpp"

namespace lio {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kEndShare = 0.1;
constexpr int kMaxLag = 20;
constexpr double kSparseTruth_s = 0.05;
constexpr int kNisDof = 6;

struct Sample {
  double time_s = 0;
  double value = 0;
};
using Samples = std::vector<Sample>;  // of one run, in time order

double MedianInterval(const std::vector<Samples>& runs) {
  std::vector<double> intervals;
  for (const Samples& run : runs) {
    for (std::size_t i = 1; i < run.size(); ++i) {
      intervals.push_back(run[i].time_s - run[i - 1].time_s);
    }
  }
  return intervals.empty() ? 1.0 : Median(std::move(intervals));
}

BandedSeries MakeSeries(const std::vector<Samples>& runs, int dof) {
  struct Bin {
    double sum = 0;
    int count = 0;
  };
  const double interval_s = MedianInterval(runs);
  std::map<std::int64_t, Bin> bins;
  double sum = 0;
  int count = 0;
  for (const Samples& run : runs) {
    for (const Sample& sample : run) {
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
  std::map<int, Band> bands;  // by number of runs: quantiles are not cheap
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

// NEES of the error's entries `begin` .. `begin + kSize - 1`.
template <int kSize>
double Nees(const RunInstant& instant, int begin) {
  const Eigen::Matrix<double, kSize, 1> error = instant.error.segment<kSize>(begin);
  const Eigen::Matrix<double, kSize, kSize> cov = instant.cov.block<kSize, kSize>(begin, begin);
  return error.dot(cov.ldlt().solve(error));
}

template <int kSize>
std::vector<Samples> NeesOfRuns(const std::vector<RunErrors>& runs, int begin) {
  std::vector<Samples> result;
  for (const RunErrors& run : runs) {
    Samples& samples = result.emplace_back();
    for (const RunInstant& instant : run.instants) {
      samples.push_back({instant.time_s, Nees<kSize>(instant, begin)});
    }
  }
  return result;
}

double MeanValue(const Samples& samples) {
  double sum = 0;
  for (const Sample& sample : samples) sum += sample.value;
  return samples.empty() ? 0 : sum / static_cast<double>(samples.size());
}

template <class Visit>
void ForEachInstant(const std::vector<RunErrors>& runs, Visit visit) {
  for (const RunErrors& run : runs) {
    for (const RunInstant& instant : run.instants) visit(instant);
  }
}

std::array<SigmaShares, 6> ComputeSigmaShares(const std::vector<RunErrors>& runs) {
  std::array<SigmaShares, 6> shares{};
  double count = 0;
  ForEachInstant(runs, [&](const RunInstant& instant) {
    ++count;
    for (int axis = 0; axis < 6; ++axis) {
      const double sigmas = std::abs(instant.error(axis)) / std::sqrt(instant.cov(axis, axis));
      for (int i = 0; i < 3; ++i) shares[axis][i] += sigmas <= i + 1 ? 1 : 0;
    }
  });
  for (SigmaShares& axis : shares) {
    for (double& share : axis) share /= count;
  }
  return shares;
}

void ComputeRms(const std::vector<RunErrors>& runs, Consistency& result) {
  RmsPair horizontal, vertical, tilt, yaw;  // sums of squares first
  double count = 0;
  ForEachInstant(runs, [&](const RunInstant& instant) {
    ++count;
    const Vector3 rotation = instant.rotation_error_world;
    const Vector6 variances = instant.cov_world.diagonal();
    horizontal.real += instant.error.head<2>().squaredNorm();
    horizontal.predicted += variances.head<2>().sum();
    vertical.real += instant.error(2) * instant.error(2);
    vertical.predicted += variances(2);
    tilt.real += rotation.head<2>().squaredNorm();
    tilt.predicted += variances.segment<2>(3).sum();
    yaw.real += rotation.z() * rotation.z();
    yaw.predicted += variances(5);
  });
  const auto rms = [count](const RmsPair& sums, double unit) {
    return RmsPair{std::sqrt(sums.real / count) * unit, std::sqrt(sums.predicted / count) * unit};
  };
  result.horizontal_m = rms(horizontal, 1);
  result.vertical_m = rms(vertical, 1);
  result.tilt_deg = rms(tilt, kDegPerRad);
  result.yaw_deg = rms(yaw, kDegPerRad);
}

Whiteness ComputeWhiteness(const std::vector<Samples>& runs) {
  Whiteness whiteness;
  int num_inside = 0;
  for (int lag = 1; lag <= kMaxLag; ++lag) {
    double products = 0, squares = 0, num_products = 0, num_squares = 0;
    for (const Samples& run : runs) {
      const double mean = MeanValue(run);
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double value = run[i].value - mean;
        squares += value * value;
        ++num_squares;
        if (i + static_cast<std::size_t>(lag) >= run.size()) continue;
        products += value * (run[i + static_cast<std::size_t>(lag)].value - mean);
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

void JudgeNis(const std::vector<RunErrors>& runs, Consistency& result) {
  std::vector<Samples> nis;
  for (const RunErrors& run : runs) {
    if (run.nis.empty()) continue;
    Samples& samples = nis.emplace_back();
    for (const NisSample& sample : run.nis) samples.push_back({sample.time_s, sample.nis});
  }
  if (nis.empty()) {
    result.notes.push_back("no NIS: no registration.csv holds a fused scan");
    return;
  }
  result.nis = MakeSeries(nis, kNisDof);
  result.nis_whiteness = ComputeWhiteness(nis);
}

void NoteRuns(const std::vector<RunErrors>& runs, Consistency& result) {
  int num_without_truth = 0, num_singular = 0;
  double period_s = 0;
  for (const RunErrors& run : runs) {
    num_without_truth += run.num_without_truth;
    num_singular += run.num_singular;
    period_s = std::max(period_s, run.truth_period_s);
  }
  if (num_without_truth > 0) {
    result.notes.push_back(fmt::format("{} rows have no truth at their time", num_without_truth));
  }
  if (num_singular > 0) {
    result.notes.push_back(
        fmt::format("{} rows have a singular covariance and are left out", num_singular));
  }
  if (period_s > kSparseTruth_s) {
    result.notes.push_back(
        fmt::format("the truth comes every {:.2g} s: interpolating it adds an error of up to "
                    "acceleration x {:.2g} s^2",
                    period_s, period_s * period_s / 8));
  }
  if (runs.size() < 10) {
    result.notes.push_back(fmt::format(
        "{} runs are few: errors of one run are correlated in time, more seeds tell more",
        runs.size()));
  }
}

}  // namespace

Consistency JudgeConsistency(const std::vector<RunErrors>& runs) {
  Consistency result;
  const std::vector<Samples> pose = NeesOfRuns<6>(runs, 0);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    result.runs.push_back(runs[i].name);
    result.run_pose_average_per_dof.push_back(MeanValue(pose[i]) / 6);
  }
  result.pose = MakeSeries(pose, 6);
  result.position = MakeSeries(NeesOfRuns<3>(runs, 0), 3);
  result.rotation = MakeSeries(NeesOfRuns<3>(runs, 3), 3);
  result.sigma_shares = ComputeSigmaShares(runs);
  ComputeRms(runs, result);
  JudgeNis(runs, result);
  NoteRuns(runs, result);
  return result;
}

}  // namespace lio
