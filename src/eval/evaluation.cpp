// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/evaluation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr double kSparseTruth_s = 0.25;
constexpr double kSameAxes_deg = 5.0;
constexpr double kMinHeading_m = 2.0;

double AngleDeg(const Quaternion& rotation) {
  return LogSo3(rotation).norm() * kDegPerRad;
}

AbsoluteErrors ComputeApe(const PosePairs& pairs, const Pose& T_truth_estimate) {
  std::vector<double> position, horizontal, vertical, rotation, rotation_without_offset;
  std::vector<Quaternion> rotation_errors;
  for (const PosePair& pair : pairs) {
    const Pose moved = T_truth_estimate * pair.estimate;
    const Vector3 error = moved.translation - pair.truth.translation;
    position.push_back(error.norm());
    horizontal.push_back(error.head<2>().norm());
    vertical.push_back(error.z());
    rotation_errors.push_back(pair.truth.rotation.conjugate() * moved.rotation);
    rotation.push_back(AngleDeg(rotation_errors.back()));
  }
  const Quaternion mean = MeanRotation(rotation_errors);
  for (const Quaternion& error : rotation_errors) {
    rotation_without_offset.push_back(AngleDeg(mean.conjugate() * error));
  }
  return {Summarise(position), Summarise(horizontal), Summarise(vertical), Summarise(rotation),
          Summarise(rotation_without_offset)};
}

ErrorStats ComputeTilt(const PosePairs& pairs) {
  std::vector<double> tilt_deg;
  for (const PosePair& pair : pairs) {
    const Vector3 truth_up = pair.truth.rotation.conjugate() * Vector3::UnitZ();
    const Vector3 estimate_up = pair.estimate.rotation.conjugate() * Vector3::UnitZ();
    const double sine = truth_up.cross(estimate_up).norm();
    tilt_deg.push_back(std::atan2(sine, truth_up.dot(estimate_up)) * kDegPerRad);
  }
  return Summarise(tilt_deg);
}

HeightDrift ComputeHeightDrift(const PosePairs& pairs, double path_length_m) {
  std::vector<double> errors;
  for (const PosePair& pair : pairs) {
    const Vector3 truth = pair.truth.translation - pairs.front().truth.translation;
    const Vector3 estimate = pair.estimate.translation - pairs.front().estimate.translation;
    errors.push_back(estimate.z() - truth.z());
  }
  HeightDrift height;
  height.end_m = errors.back();
  if (path_length_m > 0) height.end_percent = std::abs(height.end_m) / path_length_m * 100;
  const ErrorStats stats = Summarise(std::move(errors));
  height.rmse_m = stats.rmse;
  height.max_m = stats.max;
  return height;
}

EndErrors ComputeEnd(const PosePairs& pairs, double path_length_m) {
  const Pose truth = pairs.front().truth.Inverse() * pairs.back().truth;
  const Pose estimate = pairs.front().estimate.Inverse() * pairs.back().estimate;
  const Pose error = truth.Inverse() * estimate;
  EndErrors end;
  end.truth_gap_m = truth.translation.norm();
  end.estimate_gap_m = estimate.translation.norm();
  end.error_m = error.translation.norm();
  if (path_length_m > 0) end.error_percent = end.error_m / path_length_m * 100;
  end.rotation_error_deg = AngleDeg(error.rotation);
  return end;
}

// Returns the pairs with the estimate's body turned onto the truth's; the other figures are
// computed from them.
Association WithoutOffset(const Association& association, const RotationOffset& offset) {
  Association corrected = association;
  if (!offset.is_removed) return corrected;
  for (PosePair& pair : corrected.pairs) {
    pair.estimate.rotation = (pair.estimate.rotation * offset.rotation.conjugate()).normalized();
  }
  return corrected;
}

std::vector<RpeRow> ComputeRpe(const Association& association) {
  std::vector<RpeRow> rows = {{"1s", ComputeRpeOverTime(association, 1.0)}};
  for (const int length_m : {10, 50, 100}) {
    rows.push_back(
        {fmt::format("{}m", length_m), ComputeRpeOverDistance(association.pairs, length_m)});
  }
  return rows;
}

void NoteAssociation(const Association& association, std::vector<std::string>& notes) {
  if (association.num_missing_frames > 0) {
    notes.push_back(
        fmt::format("{} frames are missing from the estimate", association.num_missing_frames));
  }
  if (association.method == AssociationMethod::kByIndex) {
    notes.push_back("KITTI files have no stamps: row i is compared with row i" +
                    std::string(association.num_missing_frames > 0
                                    ? ", which is wrong from the first missing frame on"
                                    : ""));
  }
  if (association.method == AssociationMethod::kByIndex && association.num_outside > 0) {
    notes.push_back(
        fmt::format("the last {} rows of the estimate have no truth", association.num_outside));
  }
  if (association.truth_period_s > kSparseTruth_s &&
      association.estimate_period_s > kSparseTruth_s) {
    notes.push_back(fmt::format("both files are sparse ({:.2g} s): interpolation adds an error",
                                association.truth_period_s));
  }
}

// Returns the angle between the directions of travel as the two bodies see them, from start to end.
// It is the only evidence of a rotation offset when the path determines no alignment.
double HeadingOffsetDeg(const PosePairs& pairs) {
  const Pose truth = pairs.front().truth.Inverse() * pairs.back().truth;
  const Pose estimate = pairs.front().estimate.Inverse() * pairs.back().estimate;
  const Vector3 &a = truth.translation, &b = estimate.translation;
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegPerRad;
}

void NoteStraightPath(const Evaluation& result, std::vector<std::string>& notes) {
  notes.push_back(
      "the path is straight or at rest: the alignment takes the angles that the path leaves open "
      "from the attitudes, and a constant rotation offset cannot be found");
  const double heading_deg = HeadingOffsetDeg(result.association.pairs);
  if (result.end.truth_gap_m < kMinHeading_m || heading_deg < kSameAxes_deg) return;
  notes.push_back(fmt::format(
      "the two bodies see their direction of travel {:.1f} deg apart: their axes differ by at "
      "least as much",
      heading_deg));
}

void NoteFrames(const Evaluation& result, const PathAlignment& se3,
                std::vector<std::string>& notes) {
  if (se3.used_attitude) NoteStraightPath(result, notes);
  const RotationOffset& offset = result.rotation_offset;
  if (offset.is_detected) {
    notes.push_back("there is a constant rotation offset between the two body frames, " +
                    offset.name +
                    (offset.is_removed ? "; it is removed from step, RPE, drift, end and tilt, "
                                         "but not from the rotation APE"
                                       : "; it is left in every figure"));
  }
  const double world_deg = AngleDeg(se3.T_truth_estimate.rotation);
  const bool is_significant = world_deg > kSameAxes_deg + 4 * se3.rotation_uncertainty_deg;
  if (result.alignment.mode == AlignMode::kNone && is_significant) {
    notes.push_back(
        fmt::format("the two worlds are turned by {:.1f} deg against each other and "
                    "--align none keeps them so",
                    world_deg));
  }
}

}  // namespace

Evaluation Evaluate(const Trajectory& truth, const Trajectory& estimate,
                    const EvaluationOptions& options) {
  Evaluation result;
  result.association = Associate(truth, estimate, options.max_gap_s);
  const PosePairs& pairs = result.association.pairs;
  const PathAlignment se3 = Align(pairs, AlignMode::kSe3);
  result.alignment = Align(pairs, options.align);
  result.rotation_offset = FindRotationOffset(pairs, se3);
  const bool has_stamps = result.association.method != AssociationMethod::kByIndex;
  result.path_length_m = PathLengths(pairs).back();
  result.duration_s = has_stamps ? SecondsBetween(pairs.front().stamp, pairs.back().stamp) : 0.0;

  result.ape = ComputeApe(pairs, result.alignment.T_truth_estimate);
  const Association corrected = WithoutOffset(result.association, result.rotation_offset);
  result.rpe = ComputeRpe(corrected);
  result.step = ComputeStepErrors(corrected);
  result.drift = ComputeDrift(corrected);
  result.end = ComputeEnd(corrected.pairs, result.path_length_m);
  if (has_stamps) {
    result.tilt_deg = ComputeTilt(corrected.pairs);
    result.height = ComputeHeightDrift(pairs, result.path_length_m);
  }
  NoteAssociation(result.association, result.notes);
  NoteFrames(result, se3, result.notes);
  return result;
}

ErrorSeries ComputeErrorSeries(const Evaluation& evaluation) {
  ErrorSeries series;
  for (const PosePair& pair : evaluation.association.pairs) {
    const Pose moved = evaluation.alignment.T_truth_estimate * pair.estimate;
    series.position_m.push_back((moved.translation - pair.truth.translation).norm());
    series.rotation_deg.push_back(AngleDeg(pair.truth.rotation.conjugate() * moved.rotation));
  }
  return series;
}

}  // namespace lio
