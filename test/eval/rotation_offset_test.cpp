// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "eval/paths.hpp"
#include "lio/eval/alignment.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// The estimate's body is turned by `turn` relative to the truth's: R_estimate = R_truth turn.
RotationOffset OffsetOf(const Quaternion& turn, double noise_rad = 0) {
  const Pose world{ExpSo3({0.3, -0.5, 2.0}), {10, -20, 30}};
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, noise_rad);
  const Trajectory truth = test::Helix(300);
  const Trajectory estimate = test::Map(truth, [&](const Pose& p) {
    Pose moved = world * p;
    const Vector3 wobble =
        noise_rad > 0 ? Vector3{noise(random), noise(random), noise(random)} : Vector3(0, 0, 0);
    moved.rotation = moved.rotation * ExpSo3(wobble) * turn;
    return moved;
  });
  const PosePairs pairs = Associate(truth, estimate).pairs;
  return FindRotationOffset(pairs, Align(pairs, AlignMode::kSe3));
}

Quaternion CameraInVehicle() {
  Matrix3 axes;  // camera axes x (right), y (down), z (forward), in vehicle axes x forward, y left,
                 // z up
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Quaternion(axes);
}

TEST(RotationOffset, CameraAgainstVehicleAxesIsNamed) {
  const RotationOffset offset = OffsetOf(CameraInVehicle());
  EXPECT_TRUE(offset.is_detected);
  EXPECT_TRUE(offset.is_removed);
  EXPECT_NEAR(offset.angle_deg, 120, 1e-6);
  EXPECT_THAT(offset.name,
              AllOf(StartsWith("120.0 deg about ("), HasSubstr("the estimate is in camera axes")));
  EXPECT_THAT(OffsetOf(CameraInVehicle().conjugate()).name,
              HasSubstr("the truth is in camera axes"));
}

TEST(RotationOffset, RotationMapsTheEstimatesAxesToTheTruths) {
  const Quaternion turn = ExpSo3({0.2, -0.4, 1.0});
  EXPECT_LT(OffsetOf(turn).rotation.angularDistance(turn), 1e-9);
}

TEST(RotationOffset, TurnsAboutAnAxisAreNamed) {
  EXPECT_THAT(OffsetOf(ExpSo3({0, 0, 90 * test::kDeg})).name,
              AllOf(StartsWith("90.0 deg about z"), HasSubstr("T_imu_lidar")));
  EXPECT_THAT(OffsetOf(ExpSo3({0, 0, -90 * test::kDeg})).name, StartsWith("90.0 deg about -z"));
  EXPECT_THAT(OffsetOf(ExpSo3({180 * test::kDeg, 0, 0})).name,
              AllOf(StartsWith("180.0 deg about x"), HasSubstr("upside down")));
  EXPECT_THAT(OffsetOf(ExpSo3({0, 10 * test::kDeg, 0})).name, "10.0 deg about y");
}

TEST(RotationOffset, SmallOffsetIsNamedButNotRemoved) {
  const RotationOffset offset = OffsetOf(ExpSo3({0, 0, 2 * test::kDeg}), 0.1 * test::kDeg);
  EXPECT_TRUE(offset.is_detected);
  EXPECT_FALSE(offset.is_removed);
}

TEST(RotationOffset, NoiseIsNoOffset) {
  const RotationOffset offset = OffsetOf(Quaternion::Identity(), 3 * test::kDeg);
  EXPECT_FALSE(offset.is_detected);
  EXPECT_EQ(offset.name, "");
  EXPECT_NEAR(offset.scatter_deg, 3 * std::sqrt(3.0), 0.5);
}

TEST(RotationOffset, APathThatHardlyFixesTheAlignmentTellsNothing) {
  // The path is 30 m long and 0.3 m wide and has 0.2 m of lateral position error: the alignment's
  // roll about the path is off by some ten degrees, which is no offset of the bodies.
  const Trajectory truth = test::MakeTrajectory(300, [](int i) {
    return Pose{Quaternion::Identity(), {0.1 * i, 0.4 * std::sin(0.02 * i), 0}};
  });
  Trajectory estimate = truth;
  for (int i = 0; i < 300; ++i) {
    estimate.poses[i].pose.translation.z() += 0.2 * std::sin(0.015 * i);
  }
  const PosePairs pairs = Associate(truth, estimate).pairs;
  EXPECT_FALSE(FindRotationOffset(pairs, Align(pairs, AlignMode::kSe3)).is_detected);
}

}  // namespace
}  // namespace lio
