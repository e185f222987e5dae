// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How far an estimated trajectory is from the truth: every figure of lio-eval. What each of them
// means exactly: docs/evaluation.md.
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
  std::optional<double> max_gap_s;  // empty: from the data
};

// Absolute pose error after alignment. `vertical` and `horizontal` split `position` along the
// truth's z.
struct AbsoluteErrors {
  ErrorStats position_m;
  ErrorStats horizontal_m;
  ErrorStats vertical_m;
  ErrorStats rotation_deg;
  ErrorStats rotation_without_offset_deg;  // with the mean rotation between the bodies taken out
};

// Height against the height at the first pair, in both worlds' own z: no alignment.
struct HeightDrift {
  double end_m = 0;  // estimate minus truth
  double end_percent = 0;
  double rmse_m = 0;
  double max_m = 0;
};

// From the first pair to the last.
struct EndErrors {
  double truth_gap_m = 0;     // distance between first and last position
  double estimate_gap_m = 0;  // of a drive that returns to its start: what a loop fails to close by
  double error_m = 0;         // of the motion from first to last pose
  double error_percent = 0;   // of the path
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
  double duration_s = 0;  // 0 by index
  AbsoluteErrors ape;
  // Angle between the vertical as truth and estimate have it, in the body; no alignment. Like
  // height, only with stamped files: those of KITTI are in camera axes.
  std::optional<ErrorStats> tilt_deg;
  std::vector<RpeRow> rpe;
  StepErrors step;
  Drift drift;
  EndErrors end;
  std::optional<HeightDrift> height;
  std::vector<std::string> notes;  // what a reader of the figures must know, one line each
};

// Throws std::runtime_error as Associate does.
Evaluation Evaluate(const Trajectory& truth, const Trajectory& estimate,
                    const EvaluationOptions& options);

// Per pair of `evaluation.association.pairs`, for pictures: the estimate's pose moved by the
// alignment against the truth.
struct ErrorSeries {
  std::vector<double> position_m;
  std::vector<double> rotation_deg;
};
ErrorSeries ComputeErrorSeries(const Evaluation& evaluation);

}  // namespace lio
