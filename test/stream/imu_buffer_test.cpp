// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/imu_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lio/sensor/gap.hpp"
#include "support/motion.hpp"

namespace lio {
namespace {

using test::SecondsOf;
using test::StampAt;

constexpr double kRounding = 1e-12;
constexpr double kStandardGravity_mps2 = 9.80665;

ImuSample Reading(double t_s, const Vector3& w = Vector3::Zero(),
                  const Vector3& f = Vector3(0, 0, kStandardGravity_mps2)) {
  ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.w_imu_radps = w;
  sample.f_imu_mps2 = f;
  return sample;
}

struct Buffer {
  explicit Buffer(const ImuConvention& convention = {}) : imu(convention, counters) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  // Returns the samples that become ready with this one.
  std::vector<ImuReady> Add(const ImuSample& sample) {
    std::vector<ImuReady> ready;
    EXPECT_TRUE(imu.Add(sample, ready));
    return ready;
  }
  std::vector<ImuReady> FreezeUpTo(double t_s) {
    std::vector<ImuReady> ready;
    imu.FreezeUpTo(StampAt(t_s), ready);
    return ready;
  }
  void AddRest(double from_s, double to_s) {
    for (double t_s = from_s; t_s < to_s + 1e-6; t_s += 0.1) Add(Reading(t_s));
  }

  Counters counters;
  ImuBuffer imu;
};

TEST(ImuBuffer, SampleComesOutInSiUnitsAndTheAxesOfTheRig) {
  ImuConvention convention;
  convention.is_in_g = true;
  convention.is_in_deg = true;
  convention.R_imu_sent << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  Buffer buffer(convention);
  const std::vector<ImuReady> ready =
      buffer.Add(Reading(0.0, Vector3(180.0, 0, 0), Vector3(0.5, 0, -1.0)));
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_FALSE(ready[0].is_made_up);
  EXPECT_EQ(ready[0].sample.stamp, StampAt(0.0));
  EXPECT_TRUE(ready[0].sample.w_imu_radps.isApprox(Vector3(0, std::numbers::pi, 0), kRounding));
  const Vector3 force = kStandardGravity_mps2 * Vector3(0, 0.5, 1.0);
  EXPECT_TRUE(ready[0].sample.f_imu_mps2.isApprox(force, kRounding));
  EXPECT_EQ(buffer.imu.samples().back().f_imu_mps2, ready[0].sample.f_imu_mps2);
  EXPECT_EQ(buffer.imu.sent().back().f_imu_mps2, Vector3(0.5, 0, -1.0)) << "kept as it was sent";
}

TEST(ImuBuffer, SecondSampleOfAStampIsRefused) {
  Buffer buffer;
  buffer.AddRest(0.0, 0.2);
  std::vector<ImuReady> ready;
  EXPECT_FALSE(buffer.imu.Add(Reading(0.1, Vector3(1, 0, 0)), ready));
  EXPECT_TRUE(ready.empty());
  EXPECT_EQ(buffer.imu.sent().size(), 3u);
  EXPECT_EQ(buffer.imu.samples().size(), 3u);
}

TEST(ImuBuffer, LateSampleIsPutInItsPlaceWithoutABridge) {
  Buffer buffer;
  buffer.Add(Reading(0.0));
  buffer.Add(Reading(0.1));
  const std::vector<ImuReady> ready = buffer.Add(Reading(0.05, Vector3(0.5, 0, 0)));
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_EQ(ready[0].sample.stamp, StampAt(0.05));
  EXPECT_EQ(buffer.imu.samples()[1].stamp, StampAt(0.05));
  EXPECT_EQ(buffer.imu.sent()[1].stamp, StampAt(0.05));
  EXPECT_EQ(buffer.imu.newest(), StampAt(0.1));
}

TEST(ImuBuffer, NoiseIsThatOfTheSecondBeforeAndDoesNotDependOnTheOrderOfArrival) {
  Buffer in_order;
  Buffer disordered;
  const auto reading = [](int i) {  // calm for a second, then shaken
    const double rate = i < 100 ? 0.0 : (i % 2 == 0 ? 0.1 : -0.1);
    return Reading(0.01 * i, Vector3(rate, 0, 0));
  };
  for (int i = 0; i < 220; ++i) in_order.Add(reading(i));
  for (int i = 0; i < 220; i += 2) {
    disordered.Add(reading(i + 1));
    disordered.Add(reading(i));
  }
  EXPECT_TRUE(in_order.imu.NoiseAt(StampAt(0.99)).gyro_psd.isZero(1e-12));
  const Vector3 shaken = in_order.imu.NoiseAt(StampAt(2.1)).gyro_psd;
  // The sixth difference of an alternating signal is 64 times its amplitude.
  EXPECT_NEAR(shaken.x(), 0.01 * 6.4 * 6.4 / 924.0, 1e-9);
  EXPECT_EQ(disordered.imu.NoiseAt(StampAt(2.1)).gyro_psd, shaken);
  EXPECT_TRUE(in_order.imu.NoiseAt(StampAt(-5.0)).gyro_psd.isZero());
}

TEST(ImuBuffer, SamplesOfASlowImuAreNotBridged) {
  Buffer buffer;
  buffer.Add(Reading(0.0));
  EXPECT_EQ(buffer.Add(Reading(0.149)).size(), 1u);
  EXPECT_EQ(buffer.Add(Reading(0.3)).size(), 3u);
}

TEST(ImuBuffer, GapBeginsAtItsVeryNanosecond) {
  Buffer buffer;
  ImuSample sample = Reading(0.0);
  buffer.Add(sample);
  sample.stamp = sample.stamp + kImuGap.bridged - Duration{1};
  EXPECT_EQ(buffer.Add(sample).size(), 1u);
  sample.stamp = sample.stamp + kImuGap.bridged;
  EXPECT_EQ(buffer.Add(sample).size(), 3u);
}

// The last sample tells nothing about a walker's steps, nor does what was 1.1 s before.
TEST(ImuBuffer, GapIsBridgedByTheMeanOfTheTimeBefore) {
  Buffer buffer;
  const auto stride = [](int i) { return Vector3(i % 2 == 0 ? 0.4 : -0.2, 0.01 * i, 0); };
  for (int i = 0; i < 9; ++i) buffer.Add(Reading(0.1 * i, Vector3::Zero(), Vector3(0, 50, 0)));
  for (int i = 9; i <= 20; ++i) buffer.Add(Reading(0.1 * i, stride(i), Vector3(i, 0, 9.8)));
  const std::vector<ImuReady> ready = buffer.Add(Reading(2.8, Vector3(0, 0, -5)));
  ASSERT_EQ(ready.size(), 3u);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_TRUE(ready[i].is_made_up);
    EXPECT_TRUE(ready[i].sample.w_imu_radps.isApprox(Vector3(0.1, 0.145, 0), kRounding));
    EXPECT_TRUE(ready[i].sample.f_imu_mps2.isApprox(Vector3(14.5, 0, 9.8), kRounding));
  }
  EXPECT_EQ(ready[0].sample.stamp, StampAt(2.001));
  EXPECT_EQ(ready[1].sample.stamp, StampAt(2.799));
  EXPECT_FALSE(ready[2].is_made_up);
  EXPECT_EQ(ready[2].sample.w_imu_radps, Vector3(0, 0, -5));
}

// The rate before is 1 or -1 rad/s about z, so its one-axis spread about the mean is 1 / sqrt(3).
TEST(ImuBuffer, AMadeUpSampleSaysHowFarTheMotionBeforeWasFromItsMean) {
  Buffer buffer;
  for (int i = 0; i < 40; ++i) {
    buffer.Add(Reading(0.1 * i, Vector3(0, 0, i % 2 == 0 ? 1 : -1), Vector3(0, 0, 9.8)));
  }
  const std::vector<ImuReady> ready = buffer.Add(Reading(4.6, Vector3::Zero()));
  ASSERT_GT(ready.size(), 2u);
  EXPECT_NEAR(ready[0].sample.made_up_w_std_radps, 1.0 / std::sqrt(3.0), 0.02);
  EXPECT_NEAR(ready[0].sample.made_up_f_std_mps2, 0.0, 1e-3);
  EXPECT_EQ(ready.back().sample.made_up_w_std_radps, 0.f) << "it was measured";
}

TEST(ImuBuffer, EachGapHasItsOwnMean) {
  Buffer buffer;
  buffer.AddRest(0.0, 1.0);
  buffer.Add(Reading(1.5));
  for (int i = 0; i < 20; ++i) buffer.Add(Reading(1.6 + 0.1 * i, Vector3(0.3, 0, 0)));
  const std::vector<ImuReady> ready = buffer.Add(Reading(4.0));
  ASSERT_GT(ready.size(), 2u);
  EXPECT_NEAR(ready[0].sample.w_imu_radps.x(), 0.3, kRounding);
}

TEST(ImuBuffer, SamplesThatASweepHasUsedAreFrozen) {
  Buffer buffer;
  buffer.AddRest(0.0, 1.0);
  EXPECT_FALSE(buffer.imu.IsFrozen(StampAt(0.0)));
  EXPECT_TRUE(buffer.FreezeUpTo(0.55).empty());
  EXPECT_TRUE(buffer.imu.IsFrozen(StampAt(0.55)));
  EXPECT_TRUE(buffer.imu.IsFrozen(buffer.imu.samples()[6].stamp)) << "the sweep's end lies before";
  EXPECT_FALSE(buffer.imu.IsFrozen(buffer.imu.samples()[6].stamp + Duration{1}));
}

TEST(ImuBuffer, SweepThatEndsAfterTheNewestSampleMakesOneUpThere) {
  Buffer buffer;
  buffer.Add(Reading(0.0, Vector3(0.1, 0, 0)));
  buffer.Add(Reading(0.1, Vector3(0.5, 0, 0)));
  const std::vector<ImuReady> ready = buffer.FreezeUpTo(0.12);
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_TRUE(ready[0].is_made_up);
  EXPECT_EQ(ready[0].sample.stamp, StampAt(0.12));
  EXPECT_NEAR(ready[0].sample.w_imu_radps.x(), 0.3, kRounding);
  EXPECT_TRUE(buffer.imu.IsFrozen(StampAt(0.12)));
  EXPECT_FALSE(buffer.imu.IsFrozen(StampAt(0.12) + Duration{1}));
  EXPECT_EQ(buffer.imu.newest(), StampAt(0.12));
}

// Made-up samples do not take part in the mean, however many sweeps the IMU is silent for.
TEST(ImuBuffer, MeanOfTheTimeBeforeHoldsThroughALongSilence) {
  Buffer buffer;
  buffer.Add(Reading(0.0, Vector3(0.1, 0, 0)));
  buffer.Add(Reading(0.1, Vector3(0.5, 0, 0)));
  for (int i = 2; i < 30; ++i) {
    const std::vector<ImuReady> ready = buffer.FreezeUpTo(0.1 * i);
    ASSERT_EQ(ready.size(), 1u);
    EXPECT_NEAR(ready[0].sample.w_imu_radps.x(), 0.3, kRounding);
  }
}

TEST(ImuBuffer, OtherConventionRereadsWhatIsInTheBuffer) {
  Buffer buffer;
  buffer.Add(Reading(0.0, Vector3(90.0, 0, 0), Vector3(0, 0, 1)));
  buffer.Add(Reading(0.1, Vector3(90.0, 0, 0), Vector3(0, 0, 1)));
  const ImuConvention convention = ConventionOf(ImuUnits::kGAndDeg);
  buffer.imu.SetConvention(convention);
  EXPECT_EQ(buffer.imu.convention(), convention);
  ASSERT_EQ(buffer.imu.samples().size(), 2u);
  for (const ImuSample& sample : buffer.imu.samples()) {
    EXPECT_NEAR(sample.w_imu_radps.x(), std::numbers::pi / 2, kRounding);
    EXPECT_NEAR(sample.f_imu_mps2.z(), kStandardGravity_mps2, kRounding);
  }
  EXPECT_EQ(buffer.imu.sent().front().f_imu_mps2.z(), 1.0);
  const ImuSample next = buffer.Add(Reading(0.2, Vector3::Zero(), Vector3(0, 0, 2)))[0].sample;
  EXPECT_NEAR(next.f_imu_mps2.z(), 2.0 * kStandardGravity_mps2, kRounding);
}

TEST(ImuBuffer, RateThatNoGyroReadsIsCountedAndNotUsed) {
  Buffer buffer;
  buffer.Add(Reading(0.0));
  EXPECT_TRUE(buffer.Add(Reading(0.1, Vector3(101.0, 0, 0))).empty());
  EXPECT_EQ(buffer.counters.num_imu_out_of_range, 1);
  EXPECT_EQ(buffer.imu.samples().size(), 1u);
  EXPECT_EQ(buffer.imu.sent().size(), 2u) << "another convention may make sense of it";
  EXPECT_EQ(buffer.imu.newest(), StampAt(0.1)) << "time has passed all the same";
}

TEST(ImuBuffer, OutOfRangeIsJudgedAnewUnderAnotherConvention) {
  Buffer buffer;
  buffer.Add(Reading(0.0));
  buffer.Add(Reading(0.1, Vector3(101.0, 0, 0)));
  buffer.imu.SetConvention(ConventionOf(ImuUnits::kDeg));
  EXPECT_EQ(buffer.counters.num_imu_out_of_range, 0);
  EXPECT_EQ(buffer.imu.samples().size(), 2u);
  buffer.imu.SetConvention(ConventionOf(ImuUnits::kSi));
  EXPECT_EQ(buffer.counters.num_imu_out_of_range, 1);
  EXPECT_EQ(buffer.imu.samples().size(), 1u);
}

TEST(ImuBuffer, BetweenIncludesBothEnds) {
  Buffer buffer;
  for (int i = 0; i < 5; ++i) buffer.Add(Reading(0.1 * i));
  const std::vector<ImuSample> between = buffer.imu.Between(StampAt(0.1), StampAt(0.3));
  ASSERT_EQ(between.size(), 3u);
  EXPECT_EQ(between.front().stamp, StampAt(0.1));
  EXPECT_EQ(between.back().stamp, StampAt(0.3));
  EXPECT_TRUE(buffer.imu.Between(StampAt(0.11), StampAt(0.19)).empty());
}

TEST(ImuBuffer, SamplesOlderThanTwentySecondsLeave) {
  Buffer buffer;
  for (int i = 0; i <= 200; ++i) buffer.Add(Reading(0.1 * i));
  EXPECT_EQ(SecondsOf(buffer.imu.sent().front().stamp), 0.0);
  buffer.Add(Reading(20.05));
  EXPECT_EQ(buffer.imu.sent().front().stamp, StampAt(0.1));
  EXPECT_EQ(buffer.imu.samples().front().stamp, StampAt(0.1));
}

TEST(ImuBuffer, OutOfRangeSamplesStayCountedWhenTheyHaveLeft) {
  Buffer buffer;
  buffer.Add(Reading(0.0, Vector3(101.0, 0, 0)));
  for (int i = 1; i <= 210; ++i) buffer.Add(Reading(0.1 * i));
  buffer.imu.SetConvention(ConventionOf(ImuUnits::kDeg));
  EXPECT_EQ(buffer.counters.num_imu_out_of_range, 1);
}

TEST(ImuBuffer, ClearedBufferIsEmptyAndFreeOfWhatWas) {
  Buffer buffer;
  buffer.AddRest(0.0, 1.0);
  buffer.FreezeUpTo(1.2);
  buffer.imu.Clear();
  EXPECT_EQ(buffer.imu.newest(), std::nullopt);
  EXPECT_TRUE(buffer.imu.sent().empty());
  EXPECT_TRUE(buffer.imu.samples().empty());
  EXPECT_FALSE(buffer.imu.IsFrozen(StampAt(0.5)));
  EXPECT_EQ(buffer.Add(Reading(9.0)).size(), 1u) << "nothing to bridge from";
}

TEST(ImuBuffer, SamplesThatHardlyAdvanceAreBoundedByTheirNumber) {
  Buffer buffer;
  constexpr int kMax = 1 << 17;
  for (int i = 0; i < kMax + 1000; ++i) (void)buffer.Add(Reading(1e-8 * i));
  EXPECT_EQ(buffer.imu.sent().size(), std::size_t{kMax});
  EXPECT_EQ(buffer.imu.samples().size(), std::size_t{kMax});
}

}  // namespace
}  // namespace lio
