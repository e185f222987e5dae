// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr double kLongTruthPeriod_s = 0.05;
constexpr int kNisDof = 6;

// Returns the NEES of the entries `begin` .. `begin + kSize - 1` of the error.
template <int kSize>
std::vector<TimedValues> NeesOfRuns(const std::vector<RunErrors>& runs, int begin) {
  std::vector<TimedValues> result;
  for (const RunErrors& run : runs) {
    TimedValues& samples = result.emplace_back();
    for (const RunInstant& instant : run.instants) {
      samples.push_back(
          {instant.time_s, NormalisedSquare(instant.error.segment<kSize>(begin),
                                            instant.cov.block<kSize, kSize>(begin, begin))});
    }
  }
  return result;
}

template <class Visit>
void ForEachInstant(const std::vector<RunErrors>& runs, Visit visit) {
  for (const RunErrors& run : runs) {
    for (const RunInstant& instant : run.instants) visit(instant);
  }
}

std::array<SigmaShares, 6> ComputeSigmaShares(const std::vector<RunErrors>& runs) {
  std::array<std::vector<double>, 6> in_sigmas;
  ForEachInstant(runs, [&](const RunInstant& instant) {
    for (int axis = 0; axis < 6; ++axis) {
      in_sigmas[axis].push_back(instant.error(axis) / std::sqrt(instant.cov(axis, axis)));
    }
  });
  std::array<SigmaShares, 6> shares;
  for (int axis = 0; axis < 6; ++axis) shares[axis] = SharesWithin(in_sigmas[axis]);
  return shares;
}

void ComputeRms(const std::vector<RunErrors>& runs, Consistency& result) {
  RmsPair horizontal, vertical, tilt, yaw;  // hold sums of squares first
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

std::optional<TiltSample> LargestTilt(const std::vector<TiltSample>& tilts) {
  const auto largest = std::ranges::max_element(tilts, {}, &TiltSample::sigmas);
  return largest == tilts.end() ? std::nullopt : std::optional(*largest);
}

void JudgeNis(const std::vector<RunErrors>& runs, Consistency& result) {
  std::vector<TimedValues> nis;
  for (const RunErrors& run : runs) {
    if (run.nis.empty()) continue;
    TimedValues& samples = nis.emplace_back();
    for (const NisSample& sample : run.nis) samples.push_back({sample.time_s, sample.nis});
  }
  if (nis.empty()) {
    result.notes.push_back("there is no NIS: no registration.csv holds a fused scan");
    return;
  }
  result.nis = MakeBandedSeries(nis, kNisDof);
  result.nis_whiteness = ComputeWhiteness(nis, std::nullopt);
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
  if (period_s > kLongTruthPeriod_s) {
    result.notes.push_back(fmt::format(
        "the truth has one pose every {:.2g} s: its interpolation adds an error of up to "
        "acceleration x {:.2g} s^2",
        period_s, period_s * period_s / 8));
  }
  if (runs.size() < 10) {
    result.notes.push_back(fmt::format(
        "{} runs are few, because errors of one run are correlated in time; use more seeds",
        runs.size()));
  }
}

}  // namespace

Consistency JudgeConsistency(const std::vector<RunErrors>& runs) {
  Consistency result;
  const std::vector<TimedValues> pose = NeesOfRuns<6>(runs, 0);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    result.runs.push_back(runs[i].name);
    result.run_pose_average_per_dof.push_back(Mean(pose[i]) / 6);
    result.run_largest_tilt.push_back(LargestTilt(runs[i].tilts));
  }
  result.pose = MakeBandedSeries(pose, 6);
  result.position = MakeBandedSeries(NeesOfRuns<3>(runs, 0), 3);
  result.rotation = MakeBandedSeries(NeesOfRuns<3>(runs, 3), 3);
  result.sigma_shares = ComputeSigmaShares(runs);
  ComputeRms(runs, result);
  JudgeNis(runs, result);
  NoteRuns(runs, result);
  return result;
}

}  // namespace lio
