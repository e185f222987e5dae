// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_findings.hpp"

#include <gtest/gtest.h>

#include "verdict/rig_drive.hpp"

namespace lio::test {
namespace {

RigFindings FindingsOf(const RigDrive& drive, const Motion& motion = Tumble()) {
  Rig rig;
  rig.T_imu_lidar = drive.T_configured;
  const MotionRecord record = RecordDrive(drive, motion);
  return FindRigErrors(record, rig, ConventionOf(ImuUnits::kSi));
}

TEST(RigFindings, RightRigIsCheckedAndNamesNothing) {
  const RigFindings findings = FindingsOf(RightDrive());
  EXPECT_TRUE(findings.is_checked);
  EXPECT_TRUE(findings.causes.empty());
}

TEST(RigFindings, BoundsHoldTheErrorsThatAreThere) {
  RigDrive drive = RightDrive();
  drive.T_configured.rotation = ExpSo3(Vector3(0.0, 0.0, 0.05)) * drive.T_configured.rotation;
  drive.T_configured.translation.x() += 0.2;
  for (const RigDrive& rig : {RightDrive(), drive}) {
    const bool is_right = rig.T_configured.translation.x() < 0.4;
    const auto bounds = FindingsOf(rig).bounds;
    ASSERT_TRUE(bounds);
    EXPECT_GT(bounds->rotation_rad.z(), is_right ? 0.0 : 0.05);
    EXPECT_LT(bounds->rotation_rad.z(), is_right ? 0.01 : 0.06);
    EXPECT_GT(bounds->lever_m.x(), is_right ? 0.0 : 0.2);
    EXPECT_LT(bounds->lever_m.x(), is_right ? 0.05 : 0.25);
    EXPECT_LT(bounds->lever_m.y(), 0.05);
    EXPECT_LT(bounds->offset_s, 0.002);
  }
}

TEST(RigFindings, RestIsNotChecked) {
  const RigFindings findings = FindingsOf(RightDrive(), WindingDrive(100.0));
  EXPECT_FALSE(findings.bounds);
  EXPECT_FALSE(findings.is_checked);
  EXPECT_TRUE(findings.causes.empty());
}

TEST(RigFindings, WrongRotationIsNamedAndItsFixKeepsTheTranslation) {
  RigDrive drive = RightDrive();
  drive.T_configured.rotation = ExpSo3(Vector3(0.0, 0.0, 0.09)) * drive.T_configured.rotation;
  drive.T_imu_lidar.translation.setZero();  // no lever arm tells of the rotation
  drive.T_configured.translation.setZero();
  const RigFindings findings = FindingsOf(drive);
  ASSERT_EQ(findings.causes.size(), 1U);
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kExtrinsicRotation);
  EXPECT_EQ(findings.causes[0].leaves, Trust::kNo);
  EXPECT_GT(findings.causes[0].sigma, 5.0);
  EXPECT_NE(findings.causes[0].fix.find("translation_m: [0.000, 0.000, 0.000]"), std::string::npos)
      << findings.causes[0].fix;
}

TEST(RigFindings, WrongLeverArmIsNamed) {
  RigDrive drive = RightDrive();
  drive.T_configured.translation.x() += 1.0;
  const RigFindings findings = FindingsOf(drive);
  ASSERT_EQ(findings.causes.size(), 1U);
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kLeverArm);
  EXPECT_EQ(findings.causes[0].leaves, Trust::kNo);
}

TEST(RigFindings, TheExtrinsicOfTheMotionIsGivenWhereTheRigsIsWrong) {
  EXPECT_FALSE(FindingsOf(RightDrive()).T_imu_lidar);
  RigDrive drive = RightDrive();
  drive.T_configured.translation.x() += 1.0;
  const RigFindings findings = FindingsOf(drive);
  ASSERT_TRUE(findings.T_imu_lidar);
  EXPECT_LT((findings.T_imu_lidar->translation - ExamplePose().translation).norm(), 0.02);
  EXPECT_EQ(findings.T_imu_lidar->rotation.coeffs(), ExamplePose().rotation.coeffs());
}

// An error within the tolerances is no fault of the rig, but an earlier look can be bettered.
TEST(RigFindings, SmallErrorsBetterAnEarlierLook) {
  RigDrive drive = RightDrive();
  drive.T_configured.translation.y() += 0.025;
  drive.position_std_m = 0.0005;
  const RigFindings findings = FindingsOf(drive);
  EXPECT_FALSE(findings.T_imu_lidar);
  ASSERT_TRUE(findings.T_imu_lidar_bettered);
  EXPECT_LT((findings.T_imu_lidar_bettered->translation - ExamplePose().translation).norm(), 0.01);
}

TEST(RigFindings, ClockOffsetThatIsFollowedLeavesDoubtAlone) {
  RigDrive drive = RightDrive();
  drive.clock_offset_s = 0.02;
  MotionRecord record = test::RecordDrive(drive);
  for (const auto& [followed_ms, leaves] : {std::pair{18, Trust::kDoubtful}, {10, Trust::kNo}}) {
    record.SetClockCorrection(Duration{1'000'000LL * followed_ms});
    Rig rig;
    rig.T_imu_lidar = drive.T_configured;
    const RigFindings findings = FindRigErrors(record, rig, {});
    ASSERT_FALSE(findings.causes.empty());
    EXPECT_EQ(findings.causes[0].kind, CauseKind::kClockOffset);
    EXPECT_EQ(findings.causes[0].leaves, leaves) << followed_ms;
  }
}

TEST(RigFindings, ClockOffsetIsNamedWithWhatToAdd) {
  RigDrive drive = RightDrive();
  drive.clock_offset_s = 0.02;
  const RigFindings findings = FindingsOf(drive);
  ASSERT_FALSE(findings.causes.empty());
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kClockOffset);
  EXPECT_EQ(findings.causes[0].leaves, Trust::kNo);
  const std::string key = "clock_offset_s: ";
  const std::string& fix = findings.causes[0].fix;
  EXPECT_NEAR(std::stod(fix.substr(fix.find(key) + key.size())), 0.02, 0.001);
}

TEST(RigFindings, InvertedExtrinsicIsNamedFirstWithItsInverse) {
  RigDrive drive = RightDrive();
  drive.T_configured = drive.T_imu_lidar.Inverse();
  const RigFindings findings = FindingsOf(drive);
  ASSERT_FALSE(findings.causes.empty());
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kExtrinsicInverted);
  EXPECT_EQ(findings.causes[0].fix, ExtrinsicYaml(drive.T_imu_lidar));
}

TEST(RigFindings, QuarterTurnNamesExtrinsicAndAxes) {
  RigDrive drive = RightDrive();
  drive.T_imu_lidar.translation.setZero();
  drive.T_configured = {ExpSo3(Vector3(0, 0, M_PI / 2)) * drive.T_imu_lidar.rotation,
                        Vector3::Zero()};
  const RigFindings findings = FindingsOf(drive);
  ASSERT_EQ(findings.causes.size(), 2U);
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kExtrinsicRotation);
  EXPECT_EQ(findings.causes[1].kind, CauseKind::kImuAxes);
  EXPECT_EQ(findings.causes[0].leaves, Trust::kNo);
}

TEST(RigFindings, RatesReadAsDegreesAreNamed) {
  RigDrive drive = RightDrive();
  drive.gyro_unit = M_PI / 180.0;
  const RigFindings findings = FindingsOf(drive);
  ASSERT_EQ(findings.causes.size(), 1U);
  EXPECT_EQ(findings.causes[0].kind, CauseKind::kImuUnits);
}

}  // namespace
}  // namespace lio::test
