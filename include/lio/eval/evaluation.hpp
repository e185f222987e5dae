// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares an estimated trajectory with the truth and computes every figure of lio-eval.
// docs/evaluation.md defines each figure exactly.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/eval/alignment.hpp"
#include "lio/eval/association.hpp"
#include "lio/eval/relative_error.hpp"
#include "lio/eval/statistics.hpp"

namespace lio {

struct EvaluationOptions {
  AlignMode align = AlignMode::kSe3;
  std::optional<double> max_gap_s;  // empty: chosen from the data
};

// Holds the absolute pose errors after alignment. `vertical` and `horizontal` split `position`
// along the truth's z.
struct AbsoluteErrors {
  ErrorStats position_m;
  ErrorStats horizontal_m;
  ErrorStats vertical_m;
  ErrorStats rotation_deg;
  ErrorStats rotation_without_offset_deg;  // after removing the mean rotation between the bodies
};

// Holds the errors of the height above the first pair, along the z of each world: no alignment is
// used.
struct HeightDrift {
  double end_m = 0;  // estimate minus truth
  double end_percent = 0;
  double rmse_m = 0;
  double max_m = 0;
};

// Holds the error of the motion from the first pair to the last.
struct EndErrors {
  double truth_gap_m = 0;  // distance between first and last position
  double estimate_gap_m =
      0;                     // for a drive that returns to its start: the failure to close the loop
  double error_m = 0;        // error of the motion from first to last pose
  double error_percent = 0;  // relative to the path's length
  double rotation_error_deg = 0;
};

struct RpeRow {
  std::string span;  // "1s", "10m", ...
  std::optional<RelativeErrors> errors;
};

struct Evaluation {
  Association association;
  PathAlignment alignment;
  RotationOffset rotation_offset;
  double path_length_m = 0;
  double duration_s = 0;  // 0 when paired by index
  AbsoluteErrors ape;
  // This is the angle between the verticals of truth and estimate, both in body axes; no alignment
  // is used. Like the height, it needs stamped files: poses of KITTI files are in camera axes.
  std::optional<ErrorStats> tilt_deg;
  std::vector<RpeRow> rpe;
  StepErrors step;
  Drift drift;
  EndErrors end;
  std::optional<HeightDrift> height;
  std::vector<std::string> notes;  // caveats about the figures, one line each
};

// Throws std::runtime_error as Associate does.
[[nodiscard]] Evaluation Evaluate(const Trajectory& truth, const Trajectory& estimate,
                                  const EvaluationOptions& options);

// Holds one row per pair of `evaluation.association.pairs`, for pictures: the estimate's pose,
// moved by the alignment, against the truth.
struct ErrorSeries {
  std::vector<double> position_m;
  std::vector<double> rotation_deg;
};
[[nodiscard]] ErrorSeries ComputeErrorSeries(const Evaluation& evaluation);

}  // namespace lio
