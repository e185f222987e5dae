// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/rotation_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "calib/calibration_parameters.hpp"
#include "calib/rate_search.hpp"
#include "calib/turn_fit.hpp"
#include "lio/base/angle.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr TurnSelectionParameters kSelection = kCalibrationParameters.turns;
constexpr CalibrationAcceptance kAcceptance = kCalibrationParameters.acceptance;

// The turns between neighbouring sweeps; none across a missing sweep.
std::vector<SweepTurn> MakeTurns(std::span<const SweepRotation> sweeps) {
  std::vector<double> spans_s;
  for (std::size_t i = 1; i < sweeps.size(); ++i) {
    spans_s.push_back(SecondsBetween(sweeps[i - 1].stamp, sweeps[i].stamp));
  }
  std::vector<SweepTurn> turns;
  if (spans_s.empty()) return turns;
  std::vector<double> sorted = spans_s;
  std::sort(sorted.begin(), sorted.end());
  const double usual_s = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < spans_s.size(); ++i) {
    if (spans_s[i] <= 0 || spans_s[i] > kSelection.max_span_ratio * usual_s) continue;
    turns.push_back({i, sweeps[i].stamp, sweeps[i + 1].stamp,
                     sweeps[i].R_map_lidar.conjugate() * sweeps[i + 1].R_map_lidar});
  }
  return turns;
}

bool IsCovered(std::span<const ImuSample> samples, Timestamp from, Timestamp to) {
  auto at = FirstNotBefore(samples, from);
  if (at == samples.begin()) return false;
  for (; at != samples.end(); ++at) {
    if (at->stamp - std::prev(at)->stamp > kImuGap.unmeasured) return false;
    if (at->stamp >= to) return true;
  }
  return false;
}

// Returns the turns whose samples are there at the offset of the search and at all offsets near it.
std::vector<SweepTurn> Covered(std::span<const ImuSample> samples, std::vector<SweepTurn> turns,
                               double offset_s) {
  const Duration offset = Duration::FromSeconds(offset_s);
  const Duration margin = Duration::FromSeconds(kSelection.offset_margin_s);
  std::erase_if(turns, [&](const SweepTurn& turn) {
    return !IsCovered(samples, turn.from + offset - margin, turn.to + offset + margin);
  });
  return turns;
}

std::string SearchProblem(const RateMatch& match, const RotationCalibrationOptions& options) {
  if (match.num_turns < kAcceptance.min_turns) {
    return fmt::format(
        "only {} turns between sweeps are covered by inertial samples, {} are needed",
        match.num_turns, kAcceptance.min_turns);
  }
  if (match.gyro_rate_rms_radps < kAcceptance.min_rate_rms_radps) {
    return fmt::format(
        "too little motion: turn rates of {:.3f} rad/s rms, {:.2f} are needed; turn the sensors "
        "about all axes, by hand or on rough ground",
        match.gyro_rate_rms_radps, kAcceptance.min_rate_rms_radps);
  }
  if (match.correlation < kAcceptance.min_correlation) {
    return fmt::format(
        "turn rates of lidar and gyro do not agree at any offset within {:.2f} s (correlation "
        "{:.2f}): "
        "are the clocks further apart, the gyro's rates not in rad/s, or did lidar-only odometry "
        "lose its way?",
        options.max_offset_s, match.correlation);
  }
  if (std::abs(match.offset_s) > options.max_offset_s - kAcceptance.limit_margin_s) {
    return fmt::format("the best offset is at the limit of the search ({:.2f} s): allow more",
                       options.max_offset_s);
  }
  if (match.second_axis_ratio < kAcceptance.min_second_axis_ratio) {
    return "too little motion: all turns are about one axis, which leaves the rotation about it "
           "open; "
           "turn the sensors about two axes at least";
  }
  return {};
}

std::string FitProblem(const RotationCalibration& found,
                       const RotationCalibrationOptions& options) {
  if (!(found.offset_std_s <= options.max_offset_std_s)) {
    return fmt::format(
        "too little motion: the offset stays unsure by {:.2f} ms; turn the sensors to and fro "
        "faster",
        1e3 * found.offset_std_s);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(found.rotation_cov);
  const double std_rad = std::sqrt(solver.eigenvalues()(2));
  if (!(std_rad <= options.max_rotation_std_rad)) {
    const Vector3 axis = solver.eigenvectors().col(2);
    return fmt::format(
        "too little motion: the rotation about the lidar's axis ({:.2f} {:.2f} {:.2f}) stays "
        "unsure "
        "by {:.2f} deg; turn the sensors about others",
        axis.x(), axis.y(), axis.z(), std_rad * kDegPerRad);
  }
  return {};
}

}  // namespace

RotationCalibrationResult CalibrateRotation(std::span<const ImuSample> samples,
                                            std::span<const SweepRotation> sweeps,
                                            const RotationCalibrationOptions& options) {
  RotationCalibrationResult result;
  const std::vector<SweepTurn> all = MakeTurns(sweeps);
  std::vector<LidarTurn> turns;
  turns.reserve(all.size());
  for (const SweepTurn& turn : all) turns.push_back({turn.from, turn.to, LogSo3(turn.R_from_to)});
  const RateMatch match = RateSearch(samples, turns).Run(options.max_offset_s);
  result.why_not = SearchProblem(match, options);
  if (!result.why_not.empty()) return result;

  RotationCalibration found;
  found.offset_s = match.offset_s;
  found.R_imu_lidar = Quaternion(match.R_imu_lidar).normalized();
  found.gyro_bias_radps = match.gyro_bias_radps;
  found.correlation = match.correlation;
  found.turn_rate_rms_radps = match.gyro_rate_rms_radps;
  const std::vector<SweepTurn> covered = Covered(samples, all, match.offset_s);
  if (static_cast<int>(covered.size()) < kAcceptance.min_turns ||
      !FitTurns(samples, covered, found)) {
    result.why_not =
        "the turns do not determine offset and rotation: drive or walk with more turns";
    return result;
  }
  result.why_not = FitProblem(found, options);
  result.found = found;
  return result;
}

}  // namespace lio
