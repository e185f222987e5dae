// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/imu_preprocessor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;
using Step = ImuPreprocessor::Step;

constexpr double kStep_s = 0.01;

ImuSample Still(double t_s) {
  ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.f_imu_mps2 = -test::kGravity;
  return sample;
}

// Returns the sample at `t_s`, stamped by a clock that is wrong.
ImuSample Moving(double t_s, double clock_error_s = 0.0) {
  ImuSample sample = Still(t_s + clock_error_s);
  sample.w_imu_radps = Vector3(std::sin(3.0 * t_s), std::cos(5.0 * t_s), 0.1 * t_s);
  return sample;
}

// Adds samples from `from_s` on; returns how many were accepted.
int Feed(ImuPreprocessor& intake, double from_s, int num, bool* jumped = nullptr) {
  int num_accepted = 0;
  for (int i = 0; i < num; ++i) {
    const ImuPreprocessor::Result result = intake.Add(Still(from_s + i * kStep_s));
    num_accepted += static_cast<int>(result.accepted.size());
    if (jumped != nullptr) *jumped = *jumped || result.step != Step::kNone;
  }
  return num_accepted;
}

TEST(ImuPreprocessor, OrdinarySamplesPassAtOnce) {
  Counters counters;
  ImuPreprocessor intake(counters);
  bool jumped = false;
  EXPECT_EQ(Feed(intake, 0.0, 100, &jumped), 100);
  EXPECT_FALSE(jumped);
  EXPECT_EQ(counters.num_imu, 100);
  EXPECT_EQ(counters.num_imu_gaps, 0);
}

TEST(ImuPreprocessor, NonFiniteSamplesAreDroppedAndCounted) {
  Counters counters;
  ImuPreprocessor intake(counters);
  Feed(intake, 0.0, 5);
  ImuSample bad = Still(0.05);
  bad.w_imu_radps.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  bad = Still(0.05);
  bad.f_imu_mps2.z() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  EXPECT_EQ(counters.num_imu_nonfinite, 2);
  EXPECT_EQ(counters.num_imu, 7);
}

TEST(ImuPreprocessor, ReadingsBeyondAnySensorAreDroppedAndCounted) {
  Counters counters;
  ImuPreprocessor intake(counters);
  ImuSample bad = Still(0.0);
  bad.w_imu_radps.x() = 1e3;
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  bad = Still(0.0);
  bad.f_imu_mps2.x() = 1e6;
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  EXPECT_EQ(counters.num_imu_out_of_range, 2);
}

TEST(ImuPreprocessor, DroppedSampleDoesNotMoveTheClock) {
  Counters counters;
  ImuPreprocessor intake(counters);
  ImuSample bad = Still(500.0);
  bad.w_imu_radps.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  EXPECT_EQ(Feed(intake, 0.0, 3), 3);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

TEST(ImuPreprocessor, OutOfOrderSamplesPass) {
  Counters counters;
  ImuPreprocessor intake(counters);
  Feed(intake, 0.0, 5);
  Feed(intake, 0.06, 5);
  const ImuPreprocessor::Result late = intake.Add(Still(0.05));
  ASSERT_EQ(late.accepted.size(), 1u);
  EXPECT_EQ(late.step, Step::kNone);
  EXPECT_EQ(counters.num_imu_gaps, 0);
}

TEST(ImuPreprocessor, HoleIsToldAndLosesNoSample) {
  Counters counters;
  ImuPreprocessor intake(counters);
  bool jumped = false;
  Feed(intake, 0.0, 10);
  EXPECT_EQ(Feed(intake, 0.18, 10, &jumped), 10);
  EXPECT_FALSE(jumped);
  EXPECT_EQ(Feed(intake, 0.69, 4, &jumped), 0);
  EXPECT_FALSE(jumped);
  const ImuPreprocessor::Result fifth = intake.Add(Still(0.73));
  EXPECT_EQ(fifth.step, Step::kHole);
  EXPECT_EQ(fifth.accepted.size(), 5u);
  EXPECT_EQ(fifth.before, StampAt(0.27));
  EXPECT_NEAR(fifth.clock_step_s, 0.41, 0.005);
}

TEST(ImuPreprocessor, OneWrongStampIsDroppedAndTheStreamGoesOn) {
  for (const double wrong_s : {-1000.0, 1000.0}) {
    Counters counters;
    ImuPreprocessor intake(counters);
    bool jumped = false;
    Feed(intake, 0.0, 10);
    EXPECT_TRUE(intake.Add(Still(wrong_s)).accepted.empty());
    EXPECT_EQ(Feed(intake, 0.1, 10, &jumped), 10);
    EXPECT_FALSE(jumped);
    EXPECT_EQ(counters.num_imu_out_of_range, 1) << wrong_s;
    EXPECT_EQ(counters.num_clock_jumps + counters.num_imu_gaps, 0) << wrong_s;
  }
}

TEST(ImuPreprocessor, LongGapBeginsANewSegmentOnceConfirmedAndLosesNoSample) {
  Counters counters;
  ImuPreprocessor intake(counters);
  bool jumped = false;
  Feed(intake, 0.0, 10);
  EXPECT_EQ(Feed(intake, 5.0, 20, &jumped), 20);
  EXPECT_TRUE(jumped);
  EXPECT_EQ(counters.num_imu_gaps, 1);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

TEST(ImuPreprocessor, ClockSetBackBeginsANewSegmentAndIsCounted) {
  Counters counters;
  ImuPreprocessor intake(counters);
  bool jumped = false;
  Feed(intake, 100.0, 10);
  EXPECT_EQ(Feed(intake, 0.0, 20, &jumped), 20);
  EXPECT_TRUE(jumped);
  EXPECT_EQ(counters.num_clock_jumps, 1);
}

TEST(ImuPreprocessor, WildStampsNeverBecomeASegment) {
  Counters counters;
  ImuPreprocessor intake(counters);
  Feed(intake, 0.0, 10);
  for (int i = 1; i <= 20; ++i) {
    EXPECT_TRUE(intake.Add(Still(i % 2 == 0 ? 100.0 * i : -100.0 * i)).accepted.empty());
  }
  EXPECT_EQ(Feed(intake, 0.1, 5), 5);
  EXPECT_EQ(counters.num_imu_out_of_range, 20);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

// The clock is set back and right again, and no sample is lost.
std::vector<Step> StepsOf(double clock_error_s, double rate_Hz, Counters& counters) {
  ImuPreprocessor intake(counters);
  std::vector<Step> steps;
  std::size_t num_accepted = 0;
  for (int i = 0; i < 6 * rate_Hz; ++i) {
    const double t_s = i / rate_Hz;
    const bool is_wrong = t_s > 2.0 && t_s < 4.0;
    const ImuPreprocessor::Result result = intake.Add(Moving(t_s, is_wrong ? clock_error_s : 0.0));
    num_accepted += result.accepted.size();
    if (result.step != Step::kNone) steps.push_back(result.step);
  }
  EXPECT_EQ(static_cast<std::int64_t>(num_accepted), counters.num_imu);
  return steps;
}

TEST(ImuPreprocessor, ClockSetBackByLessThanASecondAndRightAgainBeginsNewSegments) {
  for (const double error_s : {-0.15, -0.3, -0.5, -0.5037, -0.9, -1.7}) {
    for (const double rate_Hz : {50.0, 100.0, 400.0}) {
      Counters counters;
      const std::vector<Step> expected{Step::kSetBack, Step::kSetRight};
      EXPECT_EQ(StepsOf(error_s, rate_Hz, counters), expected) << error_s << " s at " << rate_Hz;
      EXPECT_EQ(counters.num_clock_jumps, 2);
      EXPECT_EQ(counters.num_imu_out_of_range, 0);
    }
  }
}

TEST(ImuPreprocessor, BlockThatComesLateIsNoStepOfTheClock) {
  Counters counters;
  ImuPreprocessor intake(counters);
  int num_accepted = 0;
  const auto feed = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      const ImuPreprocessor::Result result = intake.Add(Moving(i * kStep_s));
      EXPECT_TRUE(result.step == Step::kNone || result.step == Step::kHole) << i;
      num_accepted += static_cast<int>(result.accepted.size());
    }
  };
  feed(0, 60);
  feed(80, 110);
  feed(60, 80);
  feed(110, 130);
  EXPECT_EQ(num_accepted, 130);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

TEST(ImuPreprocessor, SamplesInRandomOrderPass) {
  std::mt19937_64 random(3);
  for (const double max_delay_s : {0.05, 0.3, 0.9}) {
    std::uniform_real_distribution<double> delay_s(0.0, max_delay_s);
    std::vector<std::pair<double, ImuSample>> arrivals;
    arrivals.reserve(1000);
    for (int i = 0; i < 1000; ++i) {
      arrivals.emplace_back(i * kStep_s + delay_s(random), Moving(i * kStep_s));
    }
    std::sort(arrivals.begin(), arrivals.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Counters counters;
    ImuPreprocessor intake(counters);
    std::size_t num_accepted = 0;
    for (const auto& [at_s, sample] : arrivals) {
      const ImuPreprocessor::Result result = intake.Add(sample);
      EXPECT_TRUE(result.step == Step::kNone || result.step == Step::kHole);
      num_accepted += result.accepted.size();
    }
    EXPECT_EQ(num_accepted, 1000u) << max_delay_s;
  }
}

// Samples come in bursts of three, 0.3 s apart.
TEST(ImuPreprocessor, StreamThatIsMostlyHolesPasses) {
  Counters counters;
  ImuPreprocessor intake(counters);
  int num_accepted = 0;
  for (int burst = 0; burst < 20; ++burst) num_accepted += Feed(intake, 0.3 * burst, 3);
  num_accepted += Feed(intake, 6.0, 20);
  EXPECT_EQ(num_accepted, 80);
  EXPECT_EQ(counters.num_imu_gaps, 20);
}

// Some networks send packets twice.
TEST(ImuPreprocessor, RepeatsAreNoStepOfTheClock) {
  Counters counters;
  ImuPreprocessor intake(counters);
  std::size_t num_accepted = 0;
  for (int i = 0; i < 300; ++i) {
    for (const int at : {i, std::max(0, i - 10)}) {
      const ImuPreprocessor::Result result = intake.Add(Moving(at * kStep_s));
      EXPECT_EQ(result.step, Step::kNone);
      num_accepted += result.accepted.size();
    }
  }
  EXPECT_EQ(num_accepted, 600u);  // the buffer of samples drops repeats, not this class
}

}  // namespace
}  // namespace lio
