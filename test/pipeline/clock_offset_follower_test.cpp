// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/clock_offset_follower.hpp"

#include <gtest/gtest.h>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

using test::StampFromZero;

constexpr double kWalkScan_s = 0.1;
constexpr double kImuRate_hz = 100.0;
constexpr double kGyroDensity = 5e-4;
constexpr double kOffset_s = 0.02;  // the lidar's clock is behind the IMU's
constexpr int kEnoughOfWalk = 150;  // scans of a walk

Options OptionsOfClock(bool estimates, double configured_s = 0.0) {
  Options options;
  options.rig.imu.gyro_noise_density = kGyroDensity;
  options.rig.lidar.clock_offset_s = configured_s;
  options.filter.estimate_clock_offset = estimates;
  return options;
}

// A sensor in a walker's hands, whose scans are matched without errors.
class Walk {
 public:
  explicit Walk(double offset_s = kOffset_s) : offset_s_(offset_s) {}

  // Feeds the next scan; `unmatched`: its match is of no use.
  std::optional<std::string> AddScan(ClockOffsetFollower& follower,
                                     MatchStatus status = MatchStatus::kConverged,
                                     unsigned degenerate_mask = 0) {
    const double start_s = 1.0 + kWalkScan_s * num_scans_++ - offset_s_;
    Sweep sweep;
    sweep.start = StampFromZero(start_s);
    sweep.end = StampFromZero(start_s + kWalkScan_s);
    sweep.MoveBy(follower.correction());
    FeedImuUpTo(SecondsBetween(Timestamp{}, sweep.end) + 0.02);
    MatchOutcome outcome;
    outcome.sweep = std::make_shared<Sweep>(sweep);
    outcome.match.status = status;
    outcome.match.degenerate_mask = degenerate_mask;
    outcome.match.cov = 1e-8 * Matrix6::Identity();
    const double seen_s = start_s + 0.5 * kWalkScan_s + offset_s_;
    outcome.match.T_map_imu = motion_.At(seen_s).T_world_imu;
    return follower.AddScan(outcome, history_, kGyroDensity);
  }

  int NumAnnounced(ClockOffsetFollower& follower, int num_scans) {
    int num = 0;
    for (int k = 0; k < num_scans; ++k) num += AddScan(follower).has_value() ? 1 : 0;
    return num;
  }

 private:
  void FeedImuUpTo(double to_s) {
    for (; num_samples_ / kImuRate_hz < to_s; ++num_samples_)
      (void)history_.AddImu(SampleOf(num_samples_));
  }
  ImuSample SampleOf(int i) {
    const double t_s = i / kImuRate_hz;
    return test::ReadImu(motion_, t_s, t_s, kImuRate_hz, {}, random_).at(0);
  }
  Estimate Start() const {
    Estimate estimate;
    const test::MotionPoint point = motion_.At(0.0);
    estimate.state.T_world_imu = estimate.state.T_map_imu = point.T_world_imu;
    estimate.state.v_world_imu = point.v_world;
    return estimate;
  }

  double offset_s_;
  test::SmoothMotion motion_ = test::WalkMotion();
  std::mt19937_64 random_{5};
  int num_scans_ = 0;
  int num_samples_ = 1;
  FilterHistory history_{HistoryOptions{}, Start(), SampleOf(0)};
};

TEST(ClockOffsetFollower, DoesNothingWhenSwitchedOff) {
  const Options options = OptionsOfClock(false, 0.03);
  ClockOffsetFollower follower(options);
  Walk walk;
  EXPECT_EQ(walk.NumAnnounced(follower, 30), 0);
  EXPECT_EQ(follower.correction(), Duration{});
  EXPECT_FALSE(follower.is_running());
  EXPECT_EQ(follower.total_s(), 0.03);
  EXPECT_EQ(follower.std_s(), 0.0);
  follower.Restart();
  EXPECT_FALSE(follower.is_running());
}

TEST(ClockOffsetFollower, DoesNotRunWithoutAnImu) {
  Options options = OptionsOfClock(true);
  EXPECT_TRUE(ClockOffsetFollower(options).is_running());
  options.pipeline.use_imu = false;
  EXPECT_FALSE(ClockOffsetFollower(options).is_running());
}

TEST(ClockOffsetFollower, MovesNoSweepWhileNothingIsKnown) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  EXPECT_EQ(follower.correction(), Duration{});
}

// Tolerance: what ten scans a second of a walk tell, see the test of ClockOffset.
TEST(ClockOffsetFollower, MovesSweepsByTheOffsetOnceThatIsKnown) {
  for (const double offset_s : {kOffset_s, -kOffset_s}) {
    const Options options = OptionsOfClock(true);
    ClockOffsetFollower follower(options);
    Walk walk(offset_s);
    walk.NumAnnounced(follower, kEnoughOfWalk);
    EXPECT_NEAR(follower.correction().Seconds(), offset_s, 1e-3);
  }
}

TEST(ClockOffsetFollower, WhatIsConfiguredComesOnTop) {
  const Options options = OptionsOfClock(true, 0.1);
  ClockOffsetFollower follower(options);
  EXPECT_EQ(follower.total_s(), 0.1);
  Walk walk;
  walk.NumAnnounced(follower, kEnoughOfWalk);
  EXPECT_NEAR(follower.total_s(), 0.1 + kOffset_s, 1e-3);
}

TEST(ClockOffsetFollower, AnnouncesTheOffsetOnceWhenItIsKnownToAMillisecond) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  Walk walk;
  std::optional<std::string> text;
  for (int k = 0; k < kEnoughOfWalk && !text; ++k) {
    EXPECT_GT(follower.std_s(), 1e-3);
    text = walk.AddScan(follower);
  }
  ASSERT_TRUE(text);
  EXPECT_LE(follower.std_s(), 1e-3);
  EXPECT_NE(text->find("ms behind the IMU's"), std::string::npos) << *text;
  EXPECT_NE(text->find("rig.lidar.clock_offset_s: 0.0"), std::string::npos) << *text;
  EXPECT_EQ(walk.NumAnnounced(follower, kEnoughOfWalk), 0);
}

TEST(ClockOffsetFollower, ALidarThatIsAheadIsAnnouncedAsSuch) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  Walk walk(-kOffset_s);
  std::optional<std::string> text;
  for (int k = 0; k < kEnoughOfWalk && !text; ++k) text = walk.AddScan(follower);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("ms ahead of the IMU's"), std::string::npos) << *text;
  EXPECT_NE(text->find("rig.lidar.clock_offset_s: -0.0"), std::string::npos) << *text;
}

TEST(ClockOffsetFollower, ScansThatAreNotMatchedInAllDirectionsTellNothing) {
  const Options options = OptionsOfClock(true);
  for (const bool is_degenerate : {false, true}) {
    ClockOffsetFollower follower(options);
    const double std_s = follower.std_s();
    Walk walk;
    for (int k = 0; k < 60; ++k) {
      if (is_degenerate) {
        (void)walk.AddScan(follower, MatchStatus::kDegenerate, 0b1);
      } else {
        (void)walk.AddScan(follower, MatchStatus::kDiverged);
      }
    }
    EXPECT_EQ(follower.std_s(), std_s);
    EXPECT_EQ(follower.total_s(), 0.0);
  }
}

TEST(ClockOffsetFollower, TheTurnAcrossALostScanIsNotMeasured) {
  const Options options = OptionsOfClock(true);
  for (const bool is_told : {false, true}) {  // told of it, or by a match of no use
    ClockOffsetFollower follower(options);
    const double std_s = follower.std_s();
    Walk walk;
    for (int k = 0; k < 30; ++k) {
      (void)walk.AddScan(follower);
      if (is_told) {
        follower.Interrupt();
      } else {
        (void)walk.AddScan(follower, MatchStatus::kDiverged);
      }
    }
    EXPECT_EQ(follower.std_s(), std_s);
  }
}

TEST(ClockOffsetFollower, ARestartKnowsNothingAnyMore) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  const double std_s = follower.std_s();
  Walk walk;
  walk.NumAnnounced(follower, kEnoughOfWalk);
  follower.Restart();
  EXPECT_EQ(follower.std_s(), std_s);
  EXPECT_EQ(follower.total_s(), 0.0);
  EXPECT_EQ(follower.correction(), Duration{});
}

TEST(ClockOffsetFollower, StoppedItLeavesSweepsAlone) {
  const Options options = OptionsOfClock(true, 0.1);
  ClockOffsetFollower follower(options);
  Walk walk;
  walk.NumAnnounced(follower, kEnoughOfWalk);
  follower.Stop();
  EXPECT_EQ(follower.correction(), Duration{});
  EXPECT_FALSE(follower.is_running());
  EXPECT_EQ(follower.total_s(), 0.1);
  EXPECT_EQ(follower.std_s(), 0.0);
}

// An IMU that fell silent may come back with another clock.
TEST(ClockOffsetFollower, TheBeginIsThatBeforeTheFirstSilence) {
  const Options options = OptionsOfClock(true, 0.1);
  ClockOffsetFollower follower(options);
  EXPECT_EQ(follower.AtFirstScan().mean[0], 0.0);
  Walk().NumAnnounced(follower, kEnoughOfWalk);
  EXPECT_NEAR(follower.AtFirstScan().mean[0], kOffset_s, 2e-3);
  follower.Stop();
  follower.Resume();
  Walk(-kOffset_s).NumAnnounced(follower, kEnoughOfWalk);
  EXPECT_NEAR(follower.total_s(), 0.1 - kOffset_s, 2e-3);
  EXPECT_NEAR(follower.AtFirstScan().mean[0], kOffset_s, 2e-3);
}

TEST(ClockOffsetFollower, AnImuThatComesLateShowsTheFirstScanToo) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  follower.Stop();
  follower.Resume();
  Walk().NumAnnounced(follower, kEnoughOfWalk);
  EXPECT_NEAR(follower.AtFirstScan().mean[0], kOffset_s, 2e-3);
  follower.Restart();
  EXPECT_EQ(follower.AtFirstScan().mean[0], 0.0) << "it was found with wrong rates";
}

TEST(ClockOffsetFollower, ABeliefIsWhereItBegins) {
  ClockBelief belief;
  belief.mean[0] = 0.01;
  const Options options = OptionsOfClock(true);
  EXPECT_EQ(ClockOffsetFollower(options, belief).total_s(), 0.01);
  EXPECT_EQ(ClockOffsetFollower(OptionsOfClock(false), belief).total_s(), 0.0);
}

TEST(ClockOffsetFollower, AfterARestartTheOffsetIsAnnouncedAgain) {
  const Options options = OptionsOfClock(true);
  ClockOffsetFollower follower(options);
  EXPECT_EQ(Walk().NumAnnounced(follower, kEnoughOfWalk), 1);
  follower.Restart();
  EXPECT_EQ(Walk().NumAnnounced(follower, kEnoughOfWalk), 1);
}

}  // namespace
}  // namespace lio
