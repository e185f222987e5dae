// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A rig whose extrinsic is wrong, while tracking.
#include <gtest/gtest.h>

#include "pipeline/tracking_bench.hpp"
#include "verdict/rig_drive.hpp"

namespace lio {
namespace {

using test::ExamplePose;
using test::SecondsOf;

Options OptionsMountedAt(const Pose& T_imu_lidar) {
  Options options;
  options.rig.T_imu_lidar = T_imu_lidar;
  return options;
}

// Matching finds the lidar, the extrinsic in use makes a body of that.
struct WrongRig : test::TrackingBench {
  explicit WrongRig(const Pose& T_configured)
      : TrackingBench(test::Tumble(), OptionsMountedAt(T_configured)) {}

  std::optional<Transition> MatchLidar() {
    MatchOutcome outcome = bench.Matched(NextJob(), motion);
    outcome.match.T_map_imu = motion(SecondsOf(outcome.sweep->middle())) * ExamplePose() *
                              bench.extrinsic().T_imu_lidar().Inverse();
    return Finish(outcome);
  }
};

TEST(TrackingExtrinsic, AWrongOneIsCorrectedAndTheMatchesFitAgain) {
  Pose T_configured = ExamplePose();
  T_configured.rotation = ExpSo3(Vector3(0.0, 0.05, 0.05)) * T_configured.rotation;
  WrongRig rig(T_configured);
  for (int i = 0; i < 450; ++i) ASSERT_FALSE(rig.MatchLidar());
  const Pose off = rig.bench.extrinsic().T_imu_lidar().Inverse() * ExamplePose();
  EXPECT_LT(LogSo3(off.rotation).norm(), 0.002);
  EXPECT_LT(off.translation.norm(), 0.02);
  EXPECT_EQ(rig.bench.examiner.trust(), Trust::kDoubtful);
}

TEST(TrackingExtrinsic, ACorrectionIsToldOnceAndReported) {
  Pose T_configured = ExamplePose();
  T_configured.translation.x() += 0.5;
  WrongRig rig(T_configured);
  int num_told = 0;
  for (int i = 0; i < 300; ++i) {
    ASSERT_FALSE(rig.MatchLidar());
    for (const Notice& notice : rig.bench.Take<Notice>()) {
      num_told += notice.text.starts_with("the extrinsic is corrected from here on") ? 1 : 0;
    }
  }
  EXPECT_EQ(num_told, 1);
  ASSERT_FALSE(rig.MatchLidar());
  const ScanOutput last = rig.bench.Take<ScanOutput>().at(0);
  EXPECT_TRUE(last.scan.fused);
  EXPECT_LT(last.scan.nis, 20.0);
  ASSERT_TRUE(last.filter);
  EXPECT_EQ(last.filter->T_imu_lidar.translation, rig.bench.extrinsic().T_imu_lidar().translation);
}

TEST(TrackingExtrinsic, ARightOneIsNotTouched) {
  WrongRig rig(ExamplePose());
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(rig.MatchLidar());
  EXPECT_EQ(rig.bench.extrinsic().T_imu_lidar().translation, ExamplePose().translation);
  EXPECT_EQ(rig.bench.examiner.trust(), Trust::kYes);
}

}  // namespace
}  // namespace lio
