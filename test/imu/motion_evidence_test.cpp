// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/motion_evidence.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr double kPosePeriod_s = 0.1;

// Returns exact poses and samples of a drive; the samples were taken `late_s` later.
MotionEvidence Exact(double to_s, double late_s = 0.0) {
  const test::Motion motion = test::WindingDrive(0.5);
  MotionEvidence evidence;
  evidence.BeginMap(StampAt(0.0));
  for (int k = 0; k * kPosePeriod_s <= to_s; ++k) {
    const double t_s = k * kPosePeriod_s;
    std::vector<ImuSample> samples =
        test::ExactSamples(motion, t_s - kPosePeriod_s + late_s, t_s + late_s, 0.01);
    evidence.AddPose({StampAt(t_s), motion(t_s)}, samples);
  }
  return evidence;
}

TEST(MotionEvidence, ExactMotionHasNoContradiction) {
  const MotionEvidence evidence = Exact(6.0);
  const auto bends = evidence.FindBends();
  EXPECT_EQ(evidence.steps().size(), 60u);
  EXPECT_EQ(bends.size(), 53u);  // 0.4 s at either end have none
  const Matrix3 same = Matrix3::Identity();
  EXPECT_LT(evidence.RateError_radps(evidence.RateScore(same, 1.0)), 1e-3);
  const double gravity_mps2 = test::kGravity.norm();
  const double score = MotionEvidence::ForceScore(bends, same, 1.0, gravity_mps2);
  EXPECT_LT(MotionEvidence::ForceError_mps2(bends, score), 0.01);
}

TEST(MotionEvidence, OtherReadingsContradictIt) {
  const MotionEvidence evidence = Exact(6.0);
  const auto bends = evidence.FindBends();
  const Matrix3 same = Matrix3::Identity();
  const Matrix3 z_down = Vector3(1, -1, -1).asDiagonal();
  EXPECT_GT(evidence.RateScore(z_down, 1.0), 300.0);
  EXPECT_GT(evidence.RateScore(same, 0.0), 300.0);
  EXPECT_GT(MotionEvidence::ForceScore(bends, same, 1.0, 0.0), 300.0);
  EXPECT_GT(MotionEvidence::ForceScore(bends, z_down, 1.0, 9.80665), 300.0);
}

TEST(MotionEvidence, ABiasIsNoContradiction) {
  MotionEvidence evidence;
  evidence.BeginMap(StampAt(0.0));
  for (int k = 0; k < 40; ++k) {
    const ImuSample sample{StampAt(k * kPosePeriod_s), Vector3(0.03, -0.02, 0.01),
                           Vector3(0, 0, 9.8)};
    evidence.AddPose({StampAt(k * kPosePeriod_s), Pose{}}, std::vector{sample, sample});
  }
  EXPECT_LT(evidence.RateScore(Matrix3::Identity(), 1.0), 3.0);
}

TEST(MotionEvidence, ASpikeIsNoRateInAnyUnit) {
  MotionEvidence evidence;
  evidence.BeginMap(StampAt(0.0));
  const std::vector<ImuSample> still(10);
  std::vector<ImuSample> spiked = still;
  spiked[7].w_imu_radps.z() = 1000.0;
  evidence.AddPose({StampAt(0.0), Pose{}}, still);
  evidence.AddPose({StampAt(kPosePeriod_s), Pose{}}, spiked);
  EXPECT_EQ(evidence.steps().back().w_sent, Vector3(Vector3::Zero()));
  for (ImuSample& sample : spiked) sample.w_imu_radps.z() = 120.0;  // deg/s
  evidence.AddPose({StampAt(2 * kPosePeriod_s), Pose{}}, spiked);
  EXPECT_DOUBLE_EQ(evidence.steps().back().w_sent.z(), 120.0);
}

TEST(MotionEvidence, ShiftingUndoesAClockThatIsOff) {
  const MotionEvidence late = Exact(6.0, 0.15);
  const Matrix3 same = Matrix3::Identity();
  const double as_is = late.RateScore(same, 1.0);
  EXPECT_LT(late.Shifted(-1.5).RateScore(same, 1.0), 0.1 * as_is);
  EXPECT_GT(late.Shifted(1.5).RateScore(same, 1.0), as_is);
}

TEST(MotionEvidence, AMapBegunAnewReplacesItsTime) {
  MotionEvidence evidence = Exact(3.0);
  evidence.BeginMap(StampAt(1.0));
  EXPECT_EQ(evidence.steps().size(), 10u);
  const ImuSample sample{StampAt(1.1), Vector3::Zero(), Vector3(0, 0, 9.8)};
  evidence.AddPose({StampAt(1.1), Pose{}}, std::vector{sample, sample});
  EXPECT_EQ(evidence.steps().size(), 10u) << "the first pose of a map ends no step";
}

TEST(MotionEvidence, GapsAreNotBridged) {
  MotionEvidence evidence = Exact(1.0);
  const ImuSample sample{StampAt(3.0), Vector3::Zero(), Vector3(0, 0, 9.8)};
  evidence.AddPose({StampAt(3.0), Pose{}}, std::vector{sample, sample});
  EXPECT_EQ(evidence.steps().size(), 10u);
}

TEST(MotionEvidence, KeepsTheLastTenSecondsAndKnowsMotion) {
  EXPECT_EQ(Exact(15.0).steps().size(), 100u);
  EXPECT_TRUE(Exact(4.0).HasMoved());
  EXPECT_FALSE(Exact(0.4).HasMoved());
}

}  // namespace
}  // namespace lio
