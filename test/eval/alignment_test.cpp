// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/alignment.hpp"

#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

using test::kWorldMove;

const Pose kTurn{ExpSo3({0, 0, 2.0}), {10, -20, 30}};

PosePairs Pairs(const Trajectory& truth, const Trajectory& estimate) {
  return Associate(truth, estimate).pairs;
}

void ExpectNear(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_LT((a.translation - b.translation).norm(), tolerance);
  EXPECT_LT(a.rotation.angularDistance(b.rotation), tolerance);
}

TEST(Align, Se3RecoversAKnownMotion) {
  const Trajectory truth = test::Helix(300);
  const Trajectory estimate =
      test::Map(truth, [](const Pose& p) { return kWorldMove.Inverse() * p; });
  const PathAlignment alignment = Align(Pairs(truth, estimate), AlignMode::kSe3);
  ExpectNear(alignment.T_truth_estimate, kWorldMove, 1e-9);
  EXPECT_FALSE(alignment.used_attitude);
  EXPECT_NEAR(alignment.rotation_uncertainty_deg, 0, 1e-6);
}

TEST(Align, Se3NeverMirrors) {
  const Trajectory truth = test::Helix(300);
  Trajectory estimate = truth;
  for (StampedPose& row : estimate.poses) row.pose.translation.x() *= -1;
  const PathAlignment alignment = Align(Pairs(truth, estimate), AlignMode::kSe3);
  EXPECT_NEAR(alignment.T_truth_estimate.rotation.toRotationMatrix().determinant(), 1, 1e-9);
}

TEST(Align, YawTurnsAboutZOnly) {
  const Trajectory truth = test::Helix(300);
  const Trajectory turned = test::Map(truth, [](const Pose& p) { return kTurn.Inverse() * p; });
  ExpectNear(Align(Pairs(truth, turned), AlignMode::kYaw).T_truth_estimate, kTurn, 1e-9);
  const Trajectory tilted =
      test::Map(truth, [](const Pose& p) { return kWorldMove.Inverse() * p; });
  const Pose pose = Align(Pairs(truth, tilted), AlignMode::kYaw).T_truth_estimate;
  EXPECT_NEAR((pose.rotation * Vector3::UnitZ()).z(), 1, 1e-12);
}

TEST(Align, NoneLeavesTheEstimateWhereItIs) {
  const Trajectory truth = test::Helix(10);
  ExpectNear(Align(Pairs(truth, truth), AlignMode::kNone).T_truth_estimate, Pose::Identity(),
             1e-15);
}

TEST(Align, AStraightPathTakesItsRollFromAttitudes) {
  const Trajectory truth = test::Straight(100, 0.5);
  const Trajectory estimate =
      test::Map(truth, [](const Pose& p) { return kWorldMove.Inverse() * p; });
  const PathAlignment alignment = Align(Pairs(truth, estimate), AlignMode::kSe3);
  EXPECT_TRUE(alignment.used_attitude);
  ExpectNear(alignment.T_truth_estimate, kWorldMove, 1e-9);
}

TEST(Align, AParkedVehicleIsAlignedByAttitude) {
  const Trajectory truth = test::MakeTrajectory(50, [](int) { return Pose::Identity(); });
  const Trajectory estimate = test::Map(truth, [](const Pose& p) { return kTurn.Inverse() * p; });
  for (const AlignMode mode : {AlignMode::kSe3, AlignMode::kYaw}) {
    const PathAlignment alignment = Align(Pairs(truth, estimate), mode);
    EXPECT_TRUE(alignment.used_attitude);
    ExpectNear(alignment.T_truth_estimate, kTurn, 1e-9);
  }
}

TEST(MeanRotation, OfSymmetricPairsIsTheMiddle) {
  const Quaternion middle = ExpSo3({0.4, 0.1, -2.0});
  const Quaternion mean = MeanRotation({middle * ExpSo3({0.2, 0, 0}), middle * ExpSo3({-0.2, 0, 0}),
                                        Quaternion(-(middle * ExpSo3({0, 0.1, 0})).coeffs()),
                                        middle * ExpSo3({0, -0.1, 0})});
  EXPECT_LT(mean.angularDistance(middle), 1e-12);
}

}  // namespace
}  // namespace lio
