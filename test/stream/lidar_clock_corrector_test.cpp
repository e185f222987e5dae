// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/lidar_clock_corrector.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::SecondsOf;
using test::StampAt;

constexpr double kPeriod_s = 0.1;
constexpr double kLag_s = 0.03;  // delay of a chunk behind the sample that came last

// Chunks each 0.1 s, and what comes out.
class ChunkFeed {
 public:
  // A chunk that came at `came_s` by the IMU's clock, whose stamp is off by `off_s`.
  void Add(double came_s, double off_s = 0.0) {
    LidarClockCorrector::Arrival arrival;
    arrival.chunk.stamp = StampAt(came_s - kLag_s + off_s);
    Take(corrector.Add(std::move(arrival), StampAt(came_s)));
    if (const auto step = corrector.TakeStep()) steps.push_back(*step);
  }
  void AddAll(double from_s, double to_s, double off_s = 0.0) {
    for (int i = 0; from_s + i * kPeriod_s < to_s - 1e-9; ++i) Add(from_s + i * kPeriod_s, off_s);
  }
  void Take(const std::vector<LidarClockCorrector::Arrival>& arrivals) {
    for (const LidarClockCorrector::Arrival& arrival : arrivals) {
      stamps_s.push_back(SecondsOf(arrival.chunk.stamp));
    }
  }
  double LargestStep_s() const {
    double largest = 0.0;
    for (std::size_t i = 1; i < stamps_s.size(); ++i) {
      largest = std::max(largest, std::abs(stamps_s[i] - stamps_s[i - 1]));
    }
    return largest;
  }

  LidarClockCorrector corrector;
  std::vector<double> stamps_s;
  std::vector<LidarClockCorrector::Step> steps;
};

TEST(LidarClockCorrector, AStepIsTakenOutOfAllStampsBehindIt) {
  for (const double step_s : {-3600.0, -1.5, -0.2, 0.2, 1.5, 3600.0}) {
    ChunkFeed feed;
    feed.AddAll(1.0, 3.0);
    feed.AddAll(3.0, 5.0, step_s);
    EXPECT_EQ(feed.stamps_s.size(), 40U) << step_s;
    EXPECT_NEAR(feed.LargestStep_s(), kPeriod_s, 1e-6) << step_s;
    ASSERT_EQ(feed.steps.size(), 1U) << step_s;
    EXPECT_NEAR(feed.steps[0].by.Seconds(), step_s, 1e-6);
    EXPECT_NEAR(feed.steps[0].shift.Seconds(), -step_s, 1e-6);
    EXPECT_NEAR(SecondsOf(feed.steps[0].stamp), 3.0 - kLag_s, 1e-6);
  }
}

TEST(LidarClockCorrector, AStepBackLeavesNoShift) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  feed.AddAll(3.0, 4.0, -0.2);
  feed.AddAll(4.0, 6.0, 0.003);
  ASSERT_EQ(feed.steps.size(), 2U);
  EXPECT_EQ(feed.steps[1].shift, Duration{});
  EXPECT_NEAR(feed.stamps_s.back(), 5.9 - kLag_s + 0.003, 1e-6);
}

TEST(LidarClockCorrector, NothingIsHeldWhileTheClockIsSteady) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0, 0.09);
  feed.AddAll(3.0, 5.0, 0.0);  // less than a step
  EXPECT_EQ(feed.stamps_s.size(), 40U);
  EXPECT_TRUE(feed.steps.empty());
}

TEST(LidarClockCorrector, AWildStampGoesOnAsItCame) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  feed.Add(3.0, 40.0);
  feed.AddAll(3.1, 4.0);
  EXPECT_TRUE(feed.steps.empty());
  ASSERT_EQ(feed.stamps_s.size(), 30U);
  EXPECT_NEAR(feed.stamps_s[20], 43.0 - kLag_s, 1e-6);
  EXPECT_NEAR(feed.stamps_s[21], 3.1 - kLag_s, 1e-6);
}

// They come half a second late from one on, each with the stamp that is right.
TEST(LidarClockCorrector, MessagesThatComeLateAreNoStep) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  feed.AddAll(3.5, 5.0, -0.5);
  EXPECT_TRUE(feed.steps.empty());
  EXPECT_NEAR(feed.LargestStep_s(), kPeriod_s, 1e-6);
}

TEST(LidarClockCorrector, ABurstAfterADelayIsNoStep) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  for (const double late_s : {0.4, 0.3, 0.2, 0.1, 0.0}) feed.Add(3.4, -late_s);
  feed.AddAll(3.5, 5.0);
  EXPECT_TRUE(feed.steps.empty());
  EXPECT_NEAR(feed.LargestStep_s(), kPeriod_s, 1e-6);
}

TEST(LidarClockCorrector, ClocksThatBeginToAgreeWereSetRight) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0, -1.5);
  feed.AddAll(3.0, 5.0);
  EXPECT_TRUE(feed.steps.empty());
  EXPECT_NEAR(feed.stamps_s.back(), 4.9 - kLag_s, 1e-6);
}

TEST(LidarClockCorrector, ReleasedChunksGoOnAsTheyCame) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  feed.AddAll(3.0, 3.2, 1.5);
  EXPECT_EQ(feed.corrector.num_held(), 2U);
  feed.Take(feed.corrector.Release());
  EXPECT_EQ(feed.corrector.num_held(), 0U);
  EXPECT_NEAR(feed.stamps_s.back(), 4.6 - kLag_s, 1e-6);
  EXPECT_EQ(feed.corrector.newest(), StampAt(4.6 - kLag_s));
}

// No inertial sample comes any more, by which a step could be confirmed.
TEST(LidarClockCorrector, HeldChunksAreBounded) {
  for (const double stride_s : {0.0, 0.1}) {
    ChunkFeed feed;
    feed.AddAll(1.0, 3.0);
    feed.Add(3.0, 1.5);
    for (int i = 1; i < 1000; ++i) {
      LidarClockCorrector::Arrival arrival;
      arrival.chunk.stamp = StampAt(4.5 + i * stride_s);
      feed.Take(feed.corrector.Add(std::move(arrival), StampAt(3.0)));
      EXPECT_LE(feed.corrector.num_held(), 257U);
    }
    EXPECT_GT(feed.stamps_s.size(), 500U);
    EXPECT_TRUE(feed.steps.empty());
  }
}

TEST(LidarClockCorrector, PointsOfHeldChunksAreBounded) {
  ChunkFeed feed;
  feed.AddAll(1.0, 3.0);
  feed.Add(3.0, 1.5);
  constexpr std::size_t kPoints = 400'000;  // the most that a message can hold
  for (int i = 1; i < 100; ++i) {
    LidarClockCorrector::Arrival arrival;
    arrival.chunk.stamp = StampAt(4.5);
    arrival.chunk.points.resize(kPoints);
    feed.Take(feed.corrector.Add(std::move(arrival), StampAt(3.0)));
    EXPECT_LE(feed.corrector.num_held() * kPoints, std::size_t{3 << 20});
  }
  EXPECT_GT(feed.stamps_s.size(), 90U);
}

}  // namespace
}  // namespace lio
