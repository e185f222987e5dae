// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the way into the initial map, while tracking.
#include <gtest/gtest.h>

#include "pipeline/tracking.hpp"
#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::AfterOneSecond;
using test::StdOf;

const Pose kInInitialMap{ExpSo3(Vector3(0, 0, 1.5)), Vector3(100, 20, 5)};

FoundPlace Place() {
  FoundPlace place{kInInitialMap};
  place.cov.diagonal() << Vector3::Constant(1e-4), Vector3::Constant(1e-6);
  return place;
}

TEST(TrackingPlace, ThePathGoesOnInTheInitialMap) {
  AfterOneSecond b;
  const SweepPtr sweep = b.FeedSweep();
  const MatchJob before = b.mode.MakeJob(sweep);
  ASSERT_FALSE(b.Finish(b.bench.Matched(before, b.motion)));
  b.mode.EnterMap(Place(), *sweep);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kInfo));
  const MatchJob job = b.NextJob();
  const Pose expected =
      kInInitialMap * b.bench.T_map_world() * b.motion(test::SecondsOf(job.sweep->middle()));
  EXPECT_LT((job.prior.T_map_imu.translation - expected.translation).norm(), 0.1);
  EXPECT_LT(LogSo3(expected.rotation.conjugate() * job.prior.T_map_imu.rotation).norm(), 0.02);
  EXPECT_LT(StdOf(job), 0.5);
}

TEST(TrackingPlace, ScansOfALockedMapDoNotGrowIt) {
  AfterOneSecond b;
  b.bench.place = PlaceKnowledge(true, true);
  b.bench.place.SetFound();
  ASSERT_FALSE(b.Match(5));
  EXPECT_FALSE(b.insert.T_map_imu);
  b.bench.place = PlaceKnowledge(true, false);
  b.bench.place.SetFound();
  ASSERT_FALSE(b.Match());
  EXPECT_TRUE(b.insert.T_map_imu);
}

}  // namespace
}  // namespace lio
