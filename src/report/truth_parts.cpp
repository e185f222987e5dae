// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "truth_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "columns.hpp"
#include "lio/base/angle.hpp"
#include "lio/eval/report.hpp"
#include "lio/eval/run_errors.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

Json PathJson(const Evaluation& evaluation, Timestamp begin) {
  const Pose T_estimate_truth = evaluation.alignment.T_truth_estimate.Inverse();
  const PosePairs& pairs = evaluation.association.pairs;
  PlotColumns columns(begin);
  const std::size_t stride = RowStride(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); i += stride) {
    const Vector3 position = T_estimate_truth * pairs[i].truth.translation;
    columns.AddTime(pairs[i].stamp);
    columns.Add("x", position.x());
    columns.Add("y", position.y());
    columns.Add("z", position.z());
  }
  return columns.json();
}

// How the truth was laid into the run's frame: p_run = Rz(yaw_rad) * p_truth + shift_m.
Json JoinedJson(const Evaluation& level) {
  const Pose T_run_truth = level.alignment.T_truth_estimate.Inverse();
  const Vector3 x_axis = T_run_truth.rotation * Vector3::UnitX();
  const Vector3& shift = T_run_truth.translation;
  return {{"yaw_rad", std::atan2(x_axis.y(), x_axis.x())},
          {"shift_m", {shift.x(), shift.y(), shift.z()}}};
}

double Sigma(const Matrix6& cov, int i) {
  return std::sqrt(std::max(0.0, cov(i, i)));
}

// Gives estimate minus truth, in the level world; rotations in world axes, so that z is yaw.
Json ErrorsJson(const RunErrors& errors, Timestamp run_begin, Timestamp begin) {
  PlotColumns columns(begin);
  const std::size_t stride = RowStride(errors.instants.size());
  for (std::size_t i = 0; i < errors.instants.size(); i += stride) {
    const RunInstant& instant = errors.instants[i];
    columns.AddTime(run_begin + Duration::FromSeconds(instant.time_s));
    const std::array<const char*, 3> axes = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
      const std::string axis = axes[static_cast<std::size_t>(k)];
      columns.Add(axis, -instant.error(k));
      columns.Add(axis + "_std", Sigma(instant.cov_world, k));
      columns.Add("r" + axis, -kDegPerRad * instant.rotation_error_world(k));
      columns.Add("r" + axis + "_std", kDegPerRad * Sigma(instant.cov_world, 3 + k));
    }
  }
  return columns.json();
}

double HeadingGap(const RunFiles& run, std::size_t row, const Quaternion& R_estimate_truth) {
  Pose truth;
  const double max_gap_s = AutomaticMaxGap(MedianPeriod(run.truth));
  const StampedPose& estimate = run.estimate[row];
  if (InterpolateAt(run.truth, estimate.stamp, max_gap_s, truth) != LookUp::kFound) {
    return std::numbers::pi;
  }
  const Quaternion joined = LevelAlignment(truth, estimate.pose).rotation;
  return R_estimate_truth.angularDistance(joined);
}

void TurnTruth(const Quaternion& rotation, RunFiles& run) {
  for (StampedPose& row : run.truth) row.pose.rotation = row.pose.rotation * rotation;
}

// Errors are counted from the first row, where truth and estimate are joined. A run that began in
// other axes than it ended in (a wrong rig) would be joined there at a heading that its path does
// not have: such rows are left out, and the truth is given the body's axes of the run's middle.
// Returns the number of rows that are left out.
std::size_t LeaveOutForeignStart(const Quaternion& R_estimate_truth, RunFiles& run) {
  constexpr double kSameHeading_rad = 5.0 / kDegPerRad;
  if (HeadingGap(run, 0, R_estimate_truth) < kSameHeading_rad) return 0;
  const StampedPose& middle = run.estimate[run.estimate.size() / 2];
  Pose truth;
  const double max_gap_s = AutomaticMaxGap(MedianPeriod(run.truth));
  if (InterpolateAt(run.truth, middle.stamp, max_gap_s, truth) != LookUp::kFound) return 0;
  TurnTruth((R_estimate_truth * truth.rotation).conjugate() * middle.pose.rotation, run);
  std::size_t first = 0;
  while (HeadingGap(run, first, R_estimate_truth) >= kSameHeading_rad) {
    if (++first == run.estimate.size()) return 0;
  }
  const auto count = static_cast<std::ptrdiff_t>(first);
  run.estimate.erase(run.estimate.begin(), run.estimate.begin() + count);
  run.covariances.erase(run.covariances.begin(), run.covariances.begin() + count);
  return first;
}

RunFrame FrameOf(const std::filesystem::path& folder) {
  const bool is_level = std::filesystem::exists(folder / "covariance_level.csv");
  return is_level ? RunFrame::kLevel : RunFrame::kMap;
}

}  // namespace

Json TruthParts(const std::filesystem::path& folder, const std::filesystem::path& truth,
                Timestamp begin) {
  const RunFrame frame = FrameOf(folder);
  const auto file =
      folder / (frame == RunFrame::kLevel ? "trajectory_level.tum" : "trajectory.tum");
  Json parts = Json::object();
  try {
    const Trajectory estimate = ReadTrajectory(file);
    const Trajectory reference = ReadTrajectory(truth);
    const Evaluation figures = Evaluate(reference, estimate, {});
    parts["figures"] = EvaluationJson(figures, {truth.string(), file.string()});
    if (reference.format != TrajectoryFormat::kTum) return parts;
    const Evaluation level = Evaluate(reference, estimate, {AlignMode::kYaw, {}});
    parts["path"] = PathJson(level, begin);
    parts["joined"] = JoinedJson(level);
    RunFiles run = LoadRun(folder, std::filesystem::absolute(truth), frame);
    // The truth of another body is turned into the IMU's axes; where that body sits stays unknown.
    if (figures.rotation_offset.is_removed) TurnTruth(figures.rotation_offset.rotation, run);
    const Quaternion R_estimate_truth = level.alignment.T_truth_estimate.rotation.conjugate();
    if (const std::size_t num = LeaveOutForeignStart(R_estimate_truth, run); num > 0) {
      parts["remark"] = fmt::format(
          "The errors leave out the first {} poses, which have other axes than the later ones.",
          num);
    }
    parts["errors"] = ErrorsJson(ComputeRunErrors(run), run.estimate.front().stamp, begin);
  } catch (const std::runtime_error& error) {
    parts["note"] = error.what();
  }
  return parts;
}

}  // namespace lio
