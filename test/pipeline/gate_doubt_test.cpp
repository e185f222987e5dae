// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/gate_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/tracking_bench.hpp"
#include "verdict/known_rig.hpp"

namespace lio {
namespace {

using test::SecondsOf;

GateDoubt Doubt() {
  GateDoubt doubt;
  doubt.by << 0.1, 0.2, 0.0, 0.0, 0.0, 0.03;
  doubt.stamp = test::StampAt(10.1);
  doubt.last_fix = test::StampAt(10.0);
  return doubt;
}

TEST(GateDoubt, GrowsWithTheTimeSinceTheLastFixButNotForEver) {
  const GateDoubt doubt = Doubt();
  EXPECT_LT(doubt.At(test::StampAt(10.0)).norm(), 1e-9);
  EXPECT_LT((doubt.At(doubt.stamp) - doubt.by).norm(), 1e-6);
  EXPECT_LT((doubt.At(test::StampAt(10.2)) - 2.0 * doubt.by).norm(), 1e-6);
  EXPECT_LT(doubt.At(test::StampAt(11.0)).norm(), 2.5 * doubt.by.norm());
}

TEST(GateDoubt, WhatIsPublishedHoldsEitherPose) {
  const GateDoubt doubt = Doubt();
  WorldEstimate estimate;
  estimate.T_world_imu = {ExpSo3({0.1, 0.2, 1.0}), {3, 4, 5}};
  estimate.cov.setZero();
  AddGateDoubt(doubt, doubt.stamp, estimate);
  const Pose other = estimate.T_world_imu * ExpSe3(doubt.by);
  const Vector3 shift = other.translation - estimate.T_world_imu.translation;
  EXPECT_LT((estimate.cov.block<3, 3>(kPos, kPos) - shift * shift.transpose()).norm(), 2e-3);
  EXPECT_NEAR(estimate.cov(kRot + 2, kRot + 2), 0.03 * 0.03, 1e-9);
  EXPECT_LT((GateDoubtInMap(doubt, doubt.stamp) - doubt.by * doubt.by.transpose()).norm(), 1e-9);
}

struct GatedMatches : test::TrackingBench {
  static constexpr double kFrom_s = 4.0;

  GatedMatches() : TrackingBench(test::Straight(test::kSpeed_mps)) {
    while (sweep_start_s < kFrom_s) (void)Finish(bench.Matched(NextJob(), motion));
  }
  static Pose Turned() { return {ExpSo3({0, 0, 0.05}), Vector3::Zero()}; }
  // Returns where the next scan is believed to be, from where it is.
  Pose ErrorOfNext() {
    const MatchJob job = NextJob();
    const Pose truth = test::StateOf(motion, SecondsOf(job.sweep->middle())).T_world_imu;
    return truth.Inverse() * job.prior.T_map_imu;
  }
  // Returns what is published of a scan that is matched off by this.
  ScanOutput Take(const Pose& by) {
    MatchOutcome outcome = bench.Matched(NextJob(), motion);
    outcome.match.T_map_imu = outcome.match.T_map_imu * by;
    (void)Finish(outcome);
    return bench.Take<ScanOutput>().back();
  }
};

struct GatedMatchesOfAKnownRig : GatedMatches {
  GatedMatchesOfAKnownRig() { test::KnowTheRig(bench.examiner); }
};

TEST(GateDoubt, AScanThatIsGatedForItsTurnForetellsTheNextOne) {
  GatedMatchesOfAKnownRig drive;
  const ScanOutput output = drive.Take(GatedMatches::Turned());
  ASSERT_FALSE(output.scan.fused);
  EXPECT_GT(std::sqrt(output.filter->nav.pose_cov(5, 5)), 0.05);
  EXPECT_NEAR(LogSo3(drive.ErrorOfNext().rotation).z(), 0.1, 0.01);
}

TEST(GateDoubt, BeforeTheRigIsKnownItMayBeTheRigAndIsPublishedOnly) {
  GatedMatches drive;
  const ScanOutput output = drive.Take(GatedMatches::Turned());
  EXPECT_GT(std::sqrt(output.filter->nav.pose_cov(5, 5)), 0.05);
  EXPECT_NEAR(LogSo3(drive.ErrorOfNext().rotation).z(), 0.0, 0.01);
}

// The body moves along x, and the scan is off across it.
TEST(GateDoubt, AScanThatAForceMayHaveLedAwayForetellsTheNextOne) {
  GatedMatchesOfAKnownRig drive;
  const ScanOutput output = drive.Take({Quaternion::Identity(), {0, 0.12, 0}});
  ASSERT_FALSE(output.scan.fused);
  EXPECT_GT(std::sqrt(output.filter->nav.pose_cov(1, 1)), 0.12);
  EXPECT_NEAR(drive.ErrorOfNext().translation.y(), 0.24, 0.02);
}

TEST(GateDoubt, AScanThatIsFartherOffThanAnyForceLeadsForetellsNothing) {
  GatedMatchesOfAKnownRig drive;
  const ScanOutput output = drive.Take({Quaternion::Identity(), {0, 1, 0}});
  ASSERT_FALSE(output.scan.fused);
  EXPECT_LT(std::sqrt(output.filter->nav.pose_cov(5, 5)), 0.01);
  EXPECT_LT(drive.ErrorOfNext().translation.norm(), 0.1);
}

}  // namespace
}  // namespace lio
