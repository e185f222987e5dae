// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_findings.hpp"

#include <gmock/gmock.h>

#include "verdict/rig_drive.hpp"

namespace lio::test {
namespace {

using ::testing::HasSubstr;

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

// 4 deg of yaw and 1 m are wrong.
RigFindings FindingsWhereKnownTo(double std_m, double std_deg) {
  RigDrive drive = RightDrive();
  drive.T_configured.rotation = ExpSo3(Vector3(0.0, 0.0, 0.07)) * drive.T_configured.rotation;
  drive.T_configured.translation.x() += 1.0;
  Rig rig;
  rig.T_imu_lidar = drive.T_configured;
  rig.T_imu_lidar->std_m = std_m;
  rig.T_imu_lidar->std_deg = std_deg;
  return FindRigErrors(RecordDrive(drive), rig, ConventionOf(ImuUnits::kSi));
}

TEST(RigFindings, AnExactPartIsNamedAndNotCorrected) {
  const RigFindings of_lever = FindingsWhereKnownTo(0.03, 0.0);
  ASSERT_TRUE(of_lever.T_imu_lidar);
  EXPECT_NEAR(of_lever.T_imu_lidar->rotation.angularDistance(ExamplePose().rotation), 0.07, 1e-6);
  EXPECT_LT(of_lever.T_imu_lidar->translation.x(), ExamplePose().translation.x() + 0.5);
  const RigFindings of_rotation = FindingsWhereKnownTo(0.0, 1.0);
  ASSERT_TRUE(of_rotation.T_imu_lidar);
  EXPECT_NEAR(of_rotation.T_imu_lidar->translation.x(), ExamplePose().translation.x() + 1.0, 1e-9);
  EXPECT_LT(of_rotation.T_imu_lidar->rotation.angularDistance(ExamplePose().rotation), 0.01);
  const RigFindings exact = FindingsWhereKnownTo(0.0, 0.0);
  EXPECT_FALSE(exact.T_imu_lidar);
  EXPECT_FALSE(exact.T_imu_lidar_bettered);
  EXPECT_EQ(exact.causes.size(), 2U);
}

TEST(RigFindings, ARoughExtrinsicThatIsCorrectedLeavesDoubtAlone) {
  const RigFindings of_exact = FindingsWhereKnownTo(0.03, 1.0);
  ASSERT_FALSE(of_exact.causes.empty());
  for (const Cause& cause : of_exact.causes) EXPECT_EQ(cause.leaves, Trust::kNo);
  const RigFindings of_rough = FindingsWhereKnownTo(1.0, 5.0);
  ASSERT_FALSE(of_rough.causes.empty());
  for (const Cause& cause : of_rough.causes) EXPECT_EQ(cause.leaves, Trust::kDoubtful);
}

// x of the messages is read as the rig's y, and the rig's translation is (1, 2, 3) in its own axes.
std::string FixOfTurnedMessages(bool is_lever_found) {
  RigDrive drive = RightDrive();
  drive.T_configured.translation = drive.T_imu_lidar.translation = Vector3(1.0, 2.0, 3.0);
  Rig rig;
  rig.T_imu_lidar = drive.T_configured;
  ImuConvention convention;
  convention.R_imu_sent << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const RigFindings findings = FindRigErrors(RecordDrive(drive), rig, convention, is_lever_found);
  EXPECT_FALSE(findings.causes.empty());
  return findings.causes.empty() ? "" : findings.causes[0].fix;
}

TEST(RigFindings, AFoundLeverIsTurnedIntoTheAxesOfTheMessages) {
  EXPECT_THAT(FixOfTurnedMessages(false), HasSubstr("translation_m: [1.000, 2.000, 3.000]"));
  EXPECT_THAT(FixOfTurnedMessages(true), HasSubstr("translation_m: [2.000, -1.000, 3.000]"));
}

TEST(RigFindings, ClockOffsetThatIsFollowedLeavesDoubtAlone) {
  RigDrive drive = RightDrive();
  drive.clock_offset_s = 0.02;
  for (const auto& [followed_ms, leaves] : {std::pair{18, Trust::kDoubtful}, {10, Trust::kNo}}) {
    drive.clock_correction_s = 1e-3 * followed_ms;
    const MotionRecord record = test::RecordDrive(drive);
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
