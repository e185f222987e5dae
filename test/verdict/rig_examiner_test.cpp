// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/rig_examiner.hpp"

#include <gtest/gtest.h>

#include "verdict/rig_drive.hpp"

namespace lio::test {
namespace {

Counters CleanRun() {
  Counters counters;
  counters.num_imu = 4000;
  counters.num_scans = 400;
  return counters;
}

// Poses for every sweep up to `posed_s` of 40 s, each known to `position_std_m` in each axis.
void AddRows(double posed_s, RigExaminer& examiner, double position_std_m = 0.0) {
  const Motion motion = WindingDrive(0.0);
  for (int i = 0; i <= 400; ++i) {
    const double t_s = 0.1 * i;
    for (int k = 0; k < 10; ++k) examiner.tally().AddImu(StampAt(t_s + 0.01 * k));
    examiner.tally().AddSweep(StampAt(t_s));
    if (t_s > posed_s) continue;
    PoseRow row;
    row.stamp = StampAt(t_s);
    row.is_located = true;
    row.T_map_imu = motion(t_s);
    row.position_cov = position_std_m * position_std_m * Matrix3::Identity();
    examiner.tally().AddRow(row);
  }
}

Rig ExampleRig() {
  Rig rig;
  rig.T_imu_lidar = ExamplePose();
  return rig;
}

TEST(RigExaminer, SoundRunIsTrusted) {
  const Rig rig = ExampleRig();
  RigExaminer examiner(rig, true);
  AddRows(40.0, examiner);
  const Verdict verdict = examiner.Judge(CleanRun());
  EXPECT_EQ(verdict.trust, Trust::kYes);
  EXPECT_NEAR(verdict.coverage, 1.0, 1e-6);
  EXPECT_TRUE(verdict.causes.empty());
}

TEST(RigExaminer, RunWithoutAPoseIsNotTrusted) {
  const Rig rig = ExampleRig();
  EXPECT_EQ(RigExaminer(rig, true).Judge(CleanRun()).trust, Trust::kNo);
}

TEST(RigExaminer, CoverageLimitsTrust) {
  const Rig rig = ExampleRig();
  for (const auto& [posed_s, trust] : {std::pair(30.0, Trust::kDoubtful), {8.0, Trust::kNo}}) {
    RigExaminer examiner(rig, true);
    AddRows(posed_s, examiner);
    EXPECT_EQ(examiner.Judge(CleanRun()).trust, trust) << posed_s;
  }
}

TEST(RigExaminer, VagueClaimLimitsTrust) {
  for (const auto& [std_m, trust] : {std::pair(0.1, Trust::kYes), {100.0, Trust::kDoubtful}}) {
    RigExaminer examiner(ExampleRig(), true);
    AddRows(40.0, examiner, std_m);
    EXPECT_EQ(examiner.Judge(CleanRun()).trust, trust) << std_m;
  }
}

TEST(RigExaminer, ContradictionIsTheFirstCause) {
  const Rig rig = ExampleRig();
  RigExaminer examiner(rig, true);
  AddRows(40.0, examiner);
  examiner.Contradict({{CauseKind::kImuUnits, Trust::kNo, 0.0, "in g", "units: auto"}});
  const Verdict verdict = examiner.Judge(CleanRun());
  EXPECT_EQ(verdict.trust, Trust::kNo);
  ASSERT_EQ(verdict.causes.size(), 1U);
  EXPECT_EQ(verdict.causes[0].kind, CauseKind::kImuUnits);
}

TEST(RigExaminer, BoundsOfTheRigAreThoseOfTheLastLook) {
  RigExaminer examiner(ExampleRig(), true);
  examiner.record() = RecordDrive({.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()});
  EXPECT_FALSE(examiner.Look(StampAt(0.0)));
  EXPECT_FALSE(examiner.bounds());
  EXPECT_TRUE(examiner.Look(StampAt(40.0)));
  ASSERT_TRUE(examiner.bounds());
  EXPECT_LT(examiner.bounds()->lever_m.norm(), 0.1);
  examiner.SetConvention(ConventionOf(ImuUnits::kSi));
  EXPECT_FALSE(examiner.bounds());
}

Rig WrongRig() {
  Rig rig = ExampleRig();
  rig.T_imu_lidar->translation.x() += 1.0;
  return rig;
}

// A drive with that rig.
RigExaminer ExaminerOfWrongRig() {
  const Rig rig = WrongRig();
  RigExaminer examiner(rig, true);
  examiner.record() = RecordDrive({.T_imu_lidar = ExamplePose(), .T_configured = *rig.T_imu_lidar});
  AddRows(40.0, examiner);
  return examiner;
}

TEST(RigExaminer, WrongRigIsToldOnceAndDistrusted) {
  RigExaminer examiner = ExaminerOfWrongRig();
  int num_told = 0;
  for (int t_s = 0; t_s < 100; ++t_s) {
    const auto findings = examiner.Look(StampAt(t_s));
    if (!findings) continue;
    if (const auto news = examiner.News(*findings)) {
      ++num_told;
      EXPECT_NE(news->find("lever_arm"), std::string::npos) << *news;
    }
  }
  EXPECT_EQ(num_told, 1);
  EXPECT_EQ(examiner.trust(), Trust::kNo);
  EXPECT_EQ(examiner.Judge(CleanRun()).trust, Trust::kNo);
}

TEST(RigExaminer, LooksAfterTheSameDriveWhenTheClockWasSetBack) {
  RigExaminer examiner = ExaminerOfWrongRig();
  EXPECT_FALSE(examiner.Look(StampAt(3600.0)));
  EXPECT_FALSE(examiner.Look(StampAt(3600.0 + 0.5 * kRigExaminer.first_look_s)));
  EXPECT_FALSE(examiner.Look(StampAt(0.0)));
  EXPECT_TRUE(examiner.Look(StampAt(0.5 * kRigExaminer.first_look_s)));
}

TEST(RigExaminer, CauseThatWasToldStaysInTheVerdict) {
  RigExaminer examiner = ExaminerOfWrongRig();
  std::optional<std::string> news;
  for (int t_s = 0; t_s < 100 && !news; ++t_s) {
    if (const auto findings = examiner.Look(StampAt(t_s))) news = examiner.News(*findings);
  }
  ASSERT_TRUE(news);
  examiner.record().Clear();
  const Verdict verdict = examiner.Judge(CleanRun());
  EXPECT_EQ(verdict.trust, Trust::kNo);
  ASSERT_FALSE(verdict.causes.empty());
  EXPECT_EQ(verdict.causes.front().kind, CauseKind::kLeverArm);
}

TEST(RigExaminer, AnExtrinsicThatIsCorrectedLeavesDoubtAndItsFix) {
  RigExaminer examiner = ExaminerOfWrongRig();
  EXPECT_FALSE(examiner.Look(StampAt(0.0)));
  const auto findings = examiner.Look(StampAt(50.0));
  ASSERT_TRUE(findings && findings->T_imu_lidar);
  examiner.SetExtrinsic(*findings, *findings->T_imu_lidar,
                        *WrongRig().T_imu_lidar * findings->T_imu_lidar->Inverse());
  EXPECT_EQ(examiner.trust(), Trust::kDoubtful);
  const Verdict verdict = examiner.Judge(CleanRun());
  EXPECT_EQ(verdict.trust, Trust::kDoubtful);
  ASSERT_EQ(verdict.causes.size(), 1U);
  EXPECT_EQ(verdict.causes[0].kind, CauseKind::kLeverArm);
  EXPECT_EQ(verdict.causes[0].fix, ExtrinsicYaml(*findings->T_imu_lidar));
  EXPECT_TRUE(examiner.record().steps().empty()) << "sweeps were deskewed wrongly";
}

TEST(RigExaminer, OtherConventionForgetsTheMotion) {
  RigExaminer examiner = ExaminerOfWrongRig();
  examiner.SetConvention(ConventionOf(ImuUnits::kDeg));
  EXPECT_EQ(examiner.Judge(CleanRun()).trust, Trust::kYes);
}

}  // namespace
}  // namespace lio::test
