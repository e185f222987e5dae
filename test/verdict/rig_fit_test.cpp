// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/rig_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "verdict/rig_drive.hpp"

namespace lio::test {
namespace {

RigFitResult Fitted(const RigDrive& drive) {
  const MotionRecord record = RecordDrive(drive);
  RigFit fit(record, kAccelBiasStd_mps2);
  RigErrors start = fit.StartAt(fit.AlignTurns().rotation);
  start = fit.Solve(start, {}).errors;
  fit.SetNoiseFrom(start);
  return fit.Solve(start, {});
}

double StdOf(const RigFitResult& result, int at) {
  return std::sqrt(result.cov(at, at));
}

// Five standard deviations of every axis hold the truth, and are small enough to be of use.
void ExpectErrors(const RigFitResult& result, const Quaternion& rotation, double offset_s,
                  const Vector3& lever_m) {
  const Vector3 turn_off = LogSo3(rotation.conjugate() * result.errors.rotation);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(turn_off[i]), 5.0 * StdOf(result, kRigRotation + i)) << i;
    EXPECT_LT(std::abs(result.errors.lever_m[i] - lever_m[i]), 5.0 * StdOf(result, kRigLever + i))
        << i;
    EXPECT_LT(StdOf(result, kRigRotation + i), 0.005) << i;
    EXPECT_LT(StdOf(result, kRigLever + i), 0.02) << i;
  }
  EXPECT_LT(std::abs(result.errors.offset_s - offset_s), 5.0 * StdOf(result, kRigOffset));
  EXPECT_LT(StdOf(result, kRigOffset), 0.002);
}

TEST(RigFit, RightRigHasNoErrors) {
  const RigDrive drive{.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()};
  ExpectErrors(Fitted(drive), Quaternion::Identity(), 0.0, Vector3::Zero());
}

TEST(RigFit, FindsRotationLeverAndOffsetTogether) {
  RigDrive drive{.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()};
  const Quaternion error = ExpSo3(Vector3(0.03, -0.05, 0.08));
  drive.T_configured.rotation = error * drive.T_imu_lidar.rotation;
  drive.T_configured.translation += Vector3(0.2, 0.0, -0.1);
  drive.clock_offset_s = 0.004;
  // E t_true - t_configured, in the axes of the rig.
  const Vector3 lever = error * drive.T_imu_lidar.translation - drive.T_configured.translation;
  ExpectErrors(Fitted(drive), error, drive.clock_offset_s, lever);
}

TEST(RigFit, TellsAllOfAnOffsetThatTheStampsHaveBeenCorrectedBy) {
  RigDrive drive = RightDrive();
  drive.T_configured.translation += Vector3(0.1, 0.0, -0.1);
  drive.clock_offset_s = 0.025;
  drive.clock_correction_s = 0.022;
  const Vector3 lever = drive.T_imu_lidar.translation - drive.T_configured.translation;
  ExpectErrors(Fitted(drive), Quaternion::Identity(), drive.clock_offset_s, lever);
}

TEST(RigFit, FindsAQuarterTurn) {
  RigDrive drive{.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()};
  const Quaternion error = ExpSo3(Vector3(0.0, 0.0, M_PI / 2));
  drive.T_configured.rotation = error * drive.T_imu_lidar.rotation;
  const Vector3 lever = error * drive.T_imu_lidar.translation - drive.T_configured.translation;
  ExpectErrors(Fitted(drive), error, 0.0, lever);
}

TEST(RigFit, AlignedTurnsTellTheGyrosUnit) {
  const RigDrive drive{
      .T_imu_lidar = ExamplePose(), .T_configured = ExamplePose(), .gyro_unit = 0.5};
  const MotionRecord record = RecordDrive(drive);
  const RigFit::TurnAlignment turns = RigFit(record, kAccelBiasStd_mps2).AlignTurns();
  EXPECT_NEAR(turns.ratio, 2.0, 0.02);
  EXPECT_GT(turns.correlation, 0.99);
}

TEST(RigFit, FewStepsAreNotEnough) {
  const RigDrive drive{
      .T_imu_lidar = ExamplePose(), .T_configured = ExamplePose(), .duration_s = 3.0};
  const MotionRecord record = RecordDrive(drive);
  EXPECT_FALSE(RigFit(record, kAccelBiasStd_mps2).HasEnough());
}

TEST(RigFit, HeldErrorsStayAsTheyStart) {
  const RigDrive drive{.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()};
  const MotionRecord record = RecordDrive(drive);
  const RigFit fit(record, kAccelBiasStd_mps2);
  RigErrors start = fit.StartAt(Quaternion::Identity());
  start.lever_m = Vector3(0.5, 0, 0);
  const RigFitResult result = fit.Solve(start, {.rotation = true, .offset = false, .lever = false});
  EXPECT_EQ(result.errors.lever_m, start.lever_m);
  EXPECT_EQ(result.errors.offset_s, 0.0);
}

}  // namespace
}  // namespace lio::test
