// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Clods look higher the flatter they are seen, which pitches a map, and between clipped hedges
// nothing tells how far along them the body is (docs/experiments/rough_ground.md).
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/simulated_run.hpp"

namespace lio::sim {
namespace {

TEST(RoughGround, TheClaimHoldsWhereNothingHoldsTheWay) {
  test::SimulatedLog log({"hedgerows", "vlp16", 30.0});
  test::RunningEstimator estimator(log.options);
  for (Message& message : log.messages) estimator.Take(std::move(message));
  const test::RunOutcome outcome = estimator.Finish(log.truth);
  const NavOutput& end = estimator.published().back();
  const double claimed_m = std::sqrt(end.pose_cov.block<3, 3>(0, 0).trace());
  EXPECT_GT(claimed_m, 1.0) << "nothing tells the place along the hedges";
  EXPECT_LT(outcome.end_error_m, 3.0 * claimed_m) << "was 30 m with 4 claimed";
  EXPECT_LT(outcome.end_error_m, 5.0);
}

}  // namespace
}  // namespace lio::sim
