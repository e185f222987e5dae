// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/coarse_tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

SweepPtr EmptySweepFrom(double start_s) {
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(start_s);
  sweep->end = StampAt(start_s + 0.1);
  return sweep;
}

std::vector<ImuSample> Forces(const Vector3& f) {
  std::vector<ImuSample> samples(10);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].stamp = StampAt(0.01 * static_cast<double>(i));
    samples[i].f_imu_mps2 = f;
  }
  return samples;
}

// A lidar that leans by an angle about the imu's x axis.
Rig Leaning(double angle_rad) {
  Rig rig;
  rig.T_imu_lidar = Pose{ExpSo3(Vector3(angle_rad, 0, 0)), Vector3(0, 0, 0.3)};
  return rig;
}

ConstantVelocityTracker TrackerFrom(double start_s) {
  TrackerOptions options;
  options.seed.v_imu_mps = Vector3(10.0, 0, 0);
  return {StampAt(start_s), options};
}

TEST(TrackStart, IsTheMiddleOfTheSweepWhereNoMotionIsKnown) {
  MotionSeed seed;
  EXPECT_EQ(TrackStart(*EmptySweepFrom(1.0), seed), StampAt(1.05));
  seed.v_imu_mps = Vector3(10.0, 0, 0);
  EXPECT_EQ(TrackStart(*EmptySweepFrom(1.0), seed), StampAt(1.05));
}

TEST(TrackStart, IsTheStartOfTheSweepWithAKnownMotion) {
  MotionSeed seed;
  seed.motion = NavState{};
  EXPECT_EQ(TrackStart(*EmptySweepFrom(1.0), seed), StampAt(1.0));
}

TEST(MeanUp, IsAlongTheMeanForceInAnyUnit) {
  const Vector3 up = Vector3(0.1, -0.2, 1.0).normalized();
  EXPECT_LT((MeanUp(Forces(9.8 * up), {}) - up).norm(), 1e-12);
  EXPECT_LT((MeanUp(Forces(up), {}) - up).norm(), 1e-12) << "in g";
}

TEST(MeanUp, FollowsForcesOfEitherSign) {
  EXPECT_LT((MeanUp(Forces(Vector3(0, 0, -9.8)), {}) + Vector3::UnitZ()).norm(), 1e-12);
}

TEST(MeanUp, IsTheLidarsAxisWithoutSamples) {
  EXPECT_LT((MeanUp({}, Leaning(0.3)) - ExpSo3(Vector3(0.3, 0, 0)) * Vector3::UnitZ()).norm(),
            1e-12);
  EXPECT_LT((MeanUp({}, {}) - Vector3::UnitZ()).norm(), 1e-12) << "where the rig says nothing";
}

TEST(MeanUp, IsTheLidarsAxisWhereForcesPointElsewhere) {
  const Vector3 axis = ExpSo3(Vector3(0.3, 0, 0)) * Vector3::UnitZ();
  EXPECT_LT((MeanUp(Forces(Vector3(2.0, 0, 0)), Leaning(0.3)) - axis).norm(), 1e-12);
}

// 0.7 is the cosine of 45.6 deg.
TEST(MeanUp, BelievesForcesThatLeanBy45DegreesAtMost) {
  const auto leans_by = [](double angle_rad) {
    return Vector3(0, -std::sin(angle_rad), std::cos(angle_rad));
  };
  EXPECT_LT((MeanUp(Forces(leans_by(0.78)), {}) - leans_by(0.78)).norm(), 1e-12);
  EXPECT_LT((MeanUp(Forces(leans_by(0.81)), {}) - Vector3::UnitZ()).norm(), 1e-12);
}

TEST(FollowClockBack, LeavesATrackThatTheSweepFollows) {
  ConstantVelocityTracker tracker = TrackerFrom(1.0);
  std::optional<Timestamp> last_located = StampAt(0.95);
  FollowClockBack(*EmptySweepFrom(1.0), tracker, last_located);
  EXPECT_EQ(tracker.history().head().stamp, StampAt(1.0));
  EXPECT_EQ(last_located, StampAt(0.95));
}

TEST(FollowClockBack, GoesOnAtTheSweepWhereStampsWentBack) {
  for (const double start_s : {0.5, 1.9}) {  // the second one ends at the newest event
    ConstantVelocityTracker tracker = TrackerFrom(2.0);
    std::optional<Timestamp> last_located = StampAt(1.95);
    FollowClockBack(*EmptySweepFrom(start_s), tracker, last_located);
    EXPECT_EQ(tracker.history().head().stamp, StampAt(start_s));
    EXPECT_EQ(last_located, StampAt(start_s));
  }
}

TEST(MakeCoarseJob, PredictsByTheVelocityOfTheTrack) {
  ConstantVelocityTracker tracker = TrackerFrom(1.0);
  tracker.AdvanceTo(StampAt(1.3));
  const MatchJob job = MakeCoarseJob(EmptySweepFrom(1.2), tracker, StampAt(1.05), Vector3::UnitZ());
  EXPECT_NEAR(job.prior.T_map_imu.translation.x(), 2.5, 1e-6);
  EXPECT_NEAR(job.prior.since_last_fix_s, 0.2, 1e-9);
}

TEST(MakeCoarseJob, RefinesTheDeskewAndHoldsDegenerateDirections) {
  ConstantVelocityTracker tracker = TrackerFrom(1.0);
  const Vector3 up_map = Vector3(0.1, 0, 1).normalized();
  const MatchJob job = MakeCoarseJob(EmptySweepFrom(0.95), tracker, std::nullopt, up_map);
  EXPECT_TRUE(job.refines_deskew);
  ASSERT_TRUE(std::holds_alternative<Track>(job.task));
  EXPECT_TRUE(std::get<Track>(job.task).holds_degenerate);
  EXPECT_EQ(job.prior.up_map, up_map);
}

}  // namespace
}  // namespace lio
