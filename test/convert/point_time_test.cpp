// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/point_time.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::int64_t kEpochNs = 1'556'268'000'250'000'000;
constexpr double kSweep = 0.1;

// Describes sweeps that begin every 100 ms; the stamp is that of the start or of the end, and
// clouds arrive `latency` after their end.
struct StampedSweeps {
  double unit_s = 1.0;
  double first_s = 0.0;  // raw time of the first point, relative to the stamp or to an epoch
  bool stamp_is_end = false;
  double latency_s = 0.008;
  double clock_offset_s = 0.0;  // recorder's clock minus the sensor's
  bool absolute = false;        // raw times are instants of the sensor's clock
};

std::vector<CloudObservation> Observe(const StampedSweeps& recording) {
  std::vector<CloudObservation> clouds;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(0.0, 0.003);
  for (int k = 0; k < 20; ++k) {
    const Timestamp start{kEpochNs + k * 100'000'000};
    const Timestamp end = start + Duration::FromSeconds(kSweep);
    CloudObservation cloud;
    cloud.stamp = recording.stamp_is_end ? end : start;
    cloud.received = end + Duration::FromSeconds(recording.latency_s + jitter(random) +
                                                 recording.clock_offset_s);
    const double first = recording.absolute
                             ? 1e-9 * static_cast<double>(start.ns) + recording.first_s
                             : recording.first_s;
    cloud.raw_first = first / recording.unit_s;
    cloud.raw_last = (first + kSweep) / recording.unit_s;
    clouds.push_back(cloud);
  }
  return clouds;
}

PointTimeRule Detect(const StampedSweeps& recording, const PointTimeWishes& wishes = {},
                     std::optional<double> imu_delay_s = {}) {
  const auto rule = DetectPointTime(Observe(recording), wishes, imu_delay_s);
  EXPECT_TRUE(rule);
  return rule.value_or(PointTimeRule{});
}

// Returns the instants of first and last point of a cloud stamped at kEpochNs, relative to that
// stamp [s].
std::pair<double, double> Ends(const PointTimeRule& rule, double raw_first, double raw_last) {
  const Timestamp stamp{kEpochNs};
  const auto instants = PointInstants(rule, stamp, {raw_first, raw_last});
  EXPECT_TRUE(instants);
  if (!instants) return {};
  return {1e-9 * static_cast<double>((*instants)[0] - stamp.ns),
          1e-9 * static_cast<double>((*instants)[1] - stamp.ns)};
}

TEST(PointTime, UnitIsTheOneThatMakesASweep) {
  for (const TimeUnit unit : {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                              TimeUnit::kNanoseconds}) {
    const PointTimeRule rule = Detect({.unit_s = SecondsPer(unit)});
    EXPECT_EQ(rule.unit, unit);
    EXPECT_NEAR(rule.sweep_s, kSweep, 1e-9);
    const auto [first, last] = Ends(rule, 0.0, kSweep / SecondsPer(unit));
    EXPECT_NEAR(first, 0.0, 1e-9);
    EXPECT_NEAR(last, kSweep, 1e-9);
  }
}

TEST(PointTime, SpansThatAreNoSweepAreRefused) {
  auto clouds = Observe({});
  for (auto& cloud : clouds) cloud.raw_last = cloud.raw_first + 0.0007;  // 0.7 ms or 0.7 us or ...
  EXPECT_THROW((void)DetectPointTime(clouds, {}, {}), InputError);
  EXPECT_THROW((void)DetectPointTime(Observe({}), {.unit = TimeUnit::kMicroseconds}, {}),
               InputError);
}

TEST(PointTime, ConstantTimesAreNone) {
  auto clouds = Observe({});
  for (auto& cloud : clouds) cloud.raw_last = cloud.raw_first = 0.0;
  EXPECT_FALSE(DetectPointTime(clouds, {}, {}));
  EXPECT_FALSE(DetectPointTime({}, {}, {}));
}

TEST(PointTime, LateCloudsHaveTheirSweepsStartAsStamp) {
  const PointTimeRule rule = Detect({.stamp_is_end = false});
  EXPECT_EQ(rule.stamp, StampMeaning::kSweepStart);
  EXPECT_EQ(rule.anchor, TimeAnchor::kStamp);
}

TEST(PointTime, EarlyCloudsHaveTheirSweepsEndAsStamp) {
  const PointTimeRule rule = Detect({.stamp_is_end = true});
  EXPECT_EQ(rule.stamp, StampMeaning::kSweepEnd);
  const auto [first, last] = Ends(rule, 0.0, kSweep);
  EXPECT_NEAR(first, -kSweep, 1e-9);
  EXPECT_NEAR(last, 0.0, 1e-9);
}

TEST(PointTime, AMissingEndOfASweepDoesNotMoveItsStart) {
  const PointTimeRule rule = Detect({.stamp_is_end = true});
  const auto [first, last] = Ends(rule, 0.0, kSweep - 0.02);
  EXPECT_NEAR(first, -kSweep, 1e-9);
  EXPECT_NEAR(last, -0.02, 1e-9);
}

TEST(PointTime, NegativeTimesCountBackFromTheSweepsEnd) {
  const PointTimeRule rule = Detect({.first_s = -kSweep, .stamp_is_end = true});
  EXPECT_EQ(rule.stamp, StampMeaning::kSweepEnd);
  const auto [first, last] = Ends(rule, -kSweep, 0.0);
  EXPECT_NEAR(first, -kSweep, 1e-9);
  EXPECT_NEAR(last, 0.0, 1e-9);
}

TEST(PointTime, AbsoluteTimesOfTheStampsClockAreUsedAsTheyAre) {
  for (const bool stamp_is_end : {false, true}) {
    const PointTimeRule rule = Detect({.stamp_is_end = stamp_is_end, .absolute = true});
    EXPECT_EQ(rule.anchor, TimeAnchor::kEpoch);
    EXPECT_EQ(rule.stamp, stamp_is_end ? StampMeaning::kSweepEnd : StampMeaning::kSweepStart);
    const double raw = 1e-9 * static_cast<double>(kEpochNs);
    const auto [first, last] = Ends(rule, raw - kSweep, raw);
    EXPECT_NEAR(first, -kSweep, 5e-7);  // a double of epoch seconds has 0.24 us
    EXPECT_NEAR(last, 0.0, 5e-7);
  }
}

TEST(PointTime, AbsoluteTimesOfAnotherClockAreAnchoredToTheStamp) {
  const PointTimeRule rule = Detect({.first_s = -1.5e9, .absolute = true});  // e.g. since boot
  EXPECT_TRUE(rule.counts_from_epoch);
  EXPECT_EQ(rule.anchor, TimeAnchor::kFirstPoint);
  EXPECT_EQ(rule.stamp, StampMeaning::kSweepStart);
  const auto [first, last] = Ends(rule, 5000.0, 5000.0 + kSweep);
  EXPECT_NEAR(first, 0.0, 1e-9);
  EXPECT_NEAR(last, kSweep, 1e-9);
}

TEST(PointTime, AWishedStampOverrides) {
  const auto end = Detect({}, {.stamp = StampMeaning::kSweepEnd});
  EXPECT_NEAR(Ends(end, 0.0, kSweep).second, 0.0, 1e-9);
  const auto start = Detect({.stamp_is_end = true}, {.stamp = StampMeaning::kSweepStart});
  EXPECT_NEAR(Ends(start, 0.0, kSweep).first, 0.0, 1e-9);
  const auto absolute =
      Detect({.stamp_is_end = true, .absolute = true}, {.stamp = StampMeaning::kSweepStart});
  const double raw = 1e-9 * static_cast<double>(kEpochNs);
  EXPECT_NEAR(Ends(absolute, raw, raw + kSweep).first, 0.0, 5e-7);
  EXPECT_EQ(end.stamp_reason, "given by --stamp");
}

TEST(PointTime, AnotherClocksOffsetIsTakenFromTheImu) {
  const StampedSweeps offset{.stamp_is_end = true, .clock_offset_s = 37.0};
  EXPECT_EQ(Detect(offset, {}, 37.002).stamp, StampMeaning::kSweepEnd);
  EXPECT_EQ(Detect({.clock_offset_s = 37.0}, {}, 37.002).stamp, StampMeaning::kSweepStart);
  EXPECT_TRUE(Detect(offset).stamp_reason.starts_with("assumed"));
}

TEST(PointTime, ReceiveTimesCopiedFromStampsTellNothing) {
  auto clouds = Observe({});
  for (auto& cloud : clouds) cloud.received = cloud.stamp;
  const auto judged = JudgeStamp(clouds, kSweep, {});
  EXPECT_EQ(judged.meaning, StampMeaning::kSweepStart);
  EXPECT_TRUE(judged.reason.starts_with("assumed"));
}

TEST(PointTime, ImpossibleTimesOfOneCloudAreRefused) {
  const PointTimeRule rule = Detect({});
  const Timestamp stamp{kEpochNs};
  EXPECT_FALSE(PointInstants(rule, stamp, {0.0, 0.6}));
  EXPECT_FALSE(PointInstants(rule, stamp, {1e18, 1e18 + 0.1}));
  EXPECT_FALSE(PointInstants(rule, stamp, {-1e300, 1e300}));
  EXPECT_TRUE(PointInstants(rule, stamp, {}));
}

}  // namespace
}  // namespace lio
