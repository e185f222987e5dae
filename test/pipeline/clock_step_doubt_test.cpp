// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/clock_step_doubt.hpp"

#include <gtest/gtest.h>

#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::kImuStep_s;
using test::kSpeed_mps;
using test::StampAt;
using test::Straight;

// Stamps went forth from second 1 to second 3.
const ClockStep kStep{StampAt(1.0), StampAt(3.0)};

// The filter believes all stamps, so it has driven on meanwhile.
FilterHistory Driven() {
  const test::Motion drive = Straight(kSpeed_mps);
  HistoryOptions options;
  options.span_s = 10.0;
  const auto sample = [&](double t_s) { return test::ExactSample(drive, t_s); };
  FilterHistory history(options, test::TrueStart(drive, 0.0).estimate, sample(0.0));
  for (int i = 1; i * kImuStep_s < 3.5; ++i) {
    const double t_s = i * kImuStep_s;
    if (t_s <= 1.0 || t_s >= 3.0) (void)history.AddImu(sample(t_s));
  }
  return history;
}

SweepPtr SweepAt(double start_s) {
  auto sweep = std::make_shared<Sweep>();
  sweep->start = StampAt(start_s);
  sweep->end = StampAt(start_s + 0.1);
  return sweep;
}

ClockStepDoubt InDoubt() {
  ClockStepDoubt doubt;
  doubt.Begin(kStep);
  return doubt;
}

MatchOutcome LocatedAt(double start_s, bool is_clock_set) {
  MatchOutcome outcome;
  outcome.sweep = SweepAt(start_s);
  outcome.is_clock_set = is_clock_set;
  return outcome;
}

TEST(ClockStepDoubt, IsAboutTheSweepsAfterTheStepUntilItEnds) {
  ClockStepDoubt doubt;
  EXPECT_FALSE(doubt.IsAbout(*SweepAt(3.1)));
  EXPECT_FALSE(doubt.stamps());
  doubt.Begin(kStep);
  EXPECT_FALSE(doubt.IsAbout(*SweepAt(0.9)));
  EXPECT_TRUE(doubt.IsAbout(*SweepAt(3.1)));
  EXPECT_EQ(doubt.stamps()->after, kStep.after);
  doubt.End();
  EXPECT_FALSE(doubt.IsAbout(*SweepAt(3.1)));
}

TEST(ClockStepDoubt, WithoutTimeTheBodyHasMovedSinceTheStepAlone) {
  const FilterHistory history = Driven();
  const SweepPtr sweep = SweepAt(3.15);  // its middle is a fifth of a second after the step
  const Pose predicted = history.At(sweep->middle()).state.T_map_imu;
  EXPECT_NEAR(predicted.translation.x(), 3.2 * kSpeed_mps, 0.1);
  const auto pose = InDoubt().PoseIfSet(*sweep, predicted, StampAt(0.95), history);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->translation.x(), 1.2 * kSpeed_mps, 0.1);
}

TEST(ClockStepDoubt, ThePoseBeforeMayBeGiven) {
  const FilterHistory history = Driven();
  const SweepPtr sweep = SweepAt(3.15);
  ClockStepDoubt doubt;
  doubt.Begin(kStep, {Quaternion::Identity(), Vector3(-100, 0, 0)});
  const auto pose =
      doubt.PoseIfSet(*sweep, history.At(sweep->middle()).state.T_map_imu, {}, history);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->translation.x(), -100.0 + 0.2 * kSpeed_mps, 0.1);
}

TEST(ClockStepDoubt, ASweepThatWasLocatedSinceLeavesNoOtherPose) {
  const FilterHistory history = Driven();
  EXPECT_FALSE(InDoubt().PoseIfSet(*SweepAt(3.25), {}, StampAt(3.15), history));
  EXPECT_FALSE(InDoubt().PoseIfSet(*SweepAt(0.5), {}, {}, history)) << "it was before the step";
}

TEST(ClockStepDoubt, TheFirstSweepAfterTheStepSettlesIt) {
  for (const bool is_set : {true, false}) {
    ClockStepDoubt doubt = InDoubt();
    EXPECT_FALSE(doubt.Settle(LocatedAt(0.9, is_set)));
    EXPECT_TRUE(doubt.stamps());
    EXPECT_EQ(doubt.Settle(LocatedAt(3.1, is_set)).has_value(), is_set);
    EXPECT_FALSE(doubt.stamps());
    EXPECT_FALSE(doubt.Settle(LocatedAt(3.2, is_set)));
  }
}

}  // namespace
}  // namespace lio
