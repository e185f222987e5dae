// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes an evaluation for the tests of reports.
#pragma once

#include "eval/paths.hpp"
#include "lio/eval/report.hpp"

namespace lio::test {

inline const ReportedFiles kFiles{"truth.tum", "estimate.tum"};

// The estimate is one per cent too long.
inline Evaluation ExampleEvaluation(bool is_kitti) {
  Trajectory truth = Helix(600);
  Trajectory estimate = Map(truth, [](const Pose& p) {
    return Pose{p.rotation, 1.01 * p.translation};
  });
  if (is_kitti) truth = AsKitti(truth), estimate = AsKitti(estimate);
  return Evaluate(truth, estimate, {});
}

// Makes statistics in which every figure is different.
inline ErrorStats StatsFrom(double first) {
  return {7, first, first + 0.1, first + 0.2, first + 0.3};
}

}  // namespace lio::test
