// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/sensor_stream.hpp"

#include <gtest/gtest.h>

#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::ImuAt;
using test::Lines;
using test::OnlyImu;
using test::Sensor;
using test::SensorMessage;
using test::SensorMessages;
using test::Sensors;
using test::Silenced;
using test::StampAt;
using test::StreamRun;
using test::SweepFrom;
using Texts = std::vector<std::string>;

TEST(SensorStream, CleanLogGivesSamplesAndSweepsInOrderOfArrival) {
  StreamRun run;
  run.Feed(Sensors(0.0, 0.13));
  const Texts expected = {"imu 0.000", "imu 0.010",   "imu 0.020", "imu 0.030", "imu 0.040",
                          "imu 0.050", "imu 0.060",   "imu 0.070", "imu 0.080", "imu 0.090",
                          "imu 0.100", "sweep 0.000", "imu 0.110", "imu 0.120"};
  EXPECT_EQ(Lines(run.events), expected);
  EXPECT_EQ(run.counters.num_imu, 13);
  EXPECT_EQ(run.counters.num_chunks, 1);
  EXPECT_EQ(run.counters.num_scans, 1);
  EXPECT_TRUE(run.stream.has_imu());
}

TEST(SensorStream, SweepWaitsUntilInertialSamplesPassItsEnd) {
  StreamRun run;
  run.Feed({ImuAt(0.0), SweepFrom(0.0)});
  run.Feed(OnlyImu(0.01, 0.09));
  EXPECT_TRUE(run.SweepStarts().empty());
  run.Feed({ImuAt(0.09)});
  EXPECT_EQ(Lines(run.events).back(), "sweep 0.000");
}

TEST(SensorStream, OffsetOfTheLidarClockIsAddedToItsStamps) {
  StreamOptions options;
  options.lidar_clock_offset_s = -0.03;
  StreamRun run(options);
  run.Feed(Sensors(0.0, 0.31));
  EXPECT_EQ(run.SweepStarts().at(0), StampAt(0.07)) << "the one before it begins without samples";
}

TEST(SensorStream, DuplicateSampleIsCountedAndGivenOnce) {
  StreamRun run;
  run.Feed(OnlyImu(0.0, 0.1));
  run.Feed({ImuAt(0.09)});
  EXPECT_EQ(run.counters.num_imu_duplicate, 1);
  EXPECT_EQ(run.MeasuredStamps().size(), 10u);
}

TEST(SensorStream, SampleOfAGivenSweepIsLate) {
  StreamRun run;
  run.Feed(Sensors(0.0, 0.11));
  run.Feed({ImuAt(0.085)});
  EXPECT_EQ(run.counters.num_imu_late, 1);
  EXPECT_EQ(run.MeasuredStamps().size(), 11u);
  run.Feed({ImuAt(0.095)});
  EXPECT_EQ(run.counters.num_imu_late, 1) << "no sweep has used this time yet";
  EXPECT_EQ(run.MeasuredStamps().size(), 12u);
}

TEST(SensorStream, LidarGoesOnAloneWhenTheImuFallsSilent) {
  StreamRun run;
  run.Feed(Silenced(Sensors(0.0, 4.0), Sensor::kImu, 1.0, 4.0));
  EXPECT_FALSE(run.stream.has_imu());
  EXPECT_EQ(run.SweepStarts().back(), StampAt(3.8)) << "sweeps do not wait any more";
  const Texts lines = Lines(run.events);
  const auto absent = std::find(lines.begin(), lines.end(), "absent 1.090");
  ASSERT_NE(absent, lines.end());
  EXPECT_EQ(*std::next(absent), "sweep 1.000");
  run.Finish();
  EXPECT_EQ(run.SweepStarts().size(), 39u);
  for (const ImuReady& ready : run.Of<ImuReady>()) EXPECT_FALSE(ready.is_made_up);
}

TEST(SensorStream, LidarGoesOnAloneOnlyOnceTheSweepsBeforeAreMatched) {
  StreamRun run;
  run.Feed(Silenced(Sensors(0.0, 3.0), Sensor::kImu, 1.0, 3.0), false);
  EXPECT_TRUE(run.Of<ImuAbsent>().empty());
  run.Drain();
  EXPECT_EQ(run.Of<ImuAbsent>().size(), 1u);
}

TEST(SensorStream, ImuThatComesAgainAppears) {
  StreamRun run;
  run.Feed(Silenced(Sensors(0.0, 5.0), Sensor::kImu, 1.0, 3.0));
  EXPECT_EQ(run.Of<ImuAbsent>().size(), 1u);
  ASSERT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.Of<ImuAppeared>().front().first, StampAt(3.0));
  EXPECT_TRUE(run.stream.has_imu());
  EXPECT_EQ(run.SweepStarts().size(), 49u) << "no sweep is lost on either way";
}

TEST(SensorStream, ImuThatIsSwitchedOffIsOnlyCounted) {
  StreamOptions options;
  options.use_imu = false;
  StreamRun run(options);
  EXPECT_FALSE(run.stream.has_imu());
  run.Feed(Sensors(0.0, 0.21));
  EXPECT_EQ(Lines(run.events), (Texts{"sweep 0.000", "sweep 0.100"}));
  EXPECT_EQ(run.counters.num_imu, 21);
}

TEST(SensorStream, FlushClosesEverythingAndEndsLast) {
  StreamRun run;
  SensorMessage half = SweepFrom(0.1);
  half.chunk->chunk_count = 2;
  run.Feed(Sensors(0.0, 0.13));
  run.Feed({half});
  run.Feed({ImuAt(0.5)});  // held: its stamp may be wrong
  EXPECT_FALSE(run.stream.is_flushed());
  const auto num_before = static_cast<std::ptrdiff_t>(run.events.size());
  run.Finish();
  EXPECT_TRUE(run.stream.is_flushed());
  const std::vector<StreamEvent> at_end(run.events.begin() + num_before, run.events.end());
  const Texts expected = {"made up 0.121", "made up 0.499", "imu 0.500", "sweep 0.100", "ended"};
  EXPECT_EQ(Lines(at_end), expected);
  EXPECT_FALSE(run.stream.Next(0).has_value());
}

TEST(SensorStream, RejectedStreamCountsMessagesAndDropsThem) {
  StreamRun run;
  for (const SensorMessage& message : Sensors(0.0, 0.21)) run.Add(message);
  run.stream.Reject();
  for (const SensorMessage& message : Sensors(0.21, 0.52)) run.Add(message);
  run.Drain();
  EXPECT_TRUE(run.events.empty());
  EXPECT_EQ(run.counters.num_imu, 52);
  EXPECT_EQ(run.counters.num_chunks, 4);
  EXPECT_TRUE(run.stream.is_flushed()) << "nothing is to be waited for";
  run.Finish();
  EXPECT_TRUE(run.events.empty());
}

TEST(SensorStream, RejectDropsEventsThatWereNotTaken) {
  StreamRun run;
  run.Feed(OnlyImu(0.0, 0.1));
  run.Add(ImuAt(0.27));
  ASSERT_TRUE(run.stream.Next(0).has_value()) << "the first of two samples across the gap";
  run.stream.Reject();
  EXPECT_FALSE(run.stream.Next(0).has_value());
}

TEST(SensorStream, SecondLidarIsRefusedCountedAndNamedOnce) {
  StreamRun run;
  SensorMessages messages;
  for (const SensorMessage& message : Sensors(0.0, 1.0)) {
    messages.push_back(message);
    if (!message.chunk) continue;
    messages.push_back(message);
    messages.back().chunk->sensor_id = 3;
  }
  run.Feed(messages);
  EXPECT_EQ(run.SweepStarts().size(), 9u);
  EXPECT_EQ(run.counters.num_chunks_foreign, 9);
  ASSERT_EQ(run.Of<Notice>().size(), 1u);
  EXPECT_NE(run.Of<Notice>().front().text.find("sensor_id 3 is refused"), std::string::npos);
}

TEST(SensorStream, SecondImuIsRefusedCountedAndNamedOnce) {
  StreamRun run;
  SensorMessages messages;
  std::int32_t seq = 0;
  for (SensorMessage message : Sensors(0.0, 1.0)) {
    message.sample.seq = ++seq;
    messages.push_back(message);
    if (message.chunk) continue;
    message.sample.seq += 5000;
    message.sample.stamp = message.sample.stamp + Duration{2'000'000};
    messages.push_back(message);
  }
  run.Feed(messages);
  EXPECT_GT(run.counters.num_imu_foreign, 90);
  EXPECT_EQ(run.counters.num_imu, 200);
  ASSERT_EQ(run.Of<Notice>().size(), 1u);
  EXPECT_NE(run.Of<Notice>().front().text.find("two senders"), std::string::npos);
}

TEST(SensorStream, SaturatedGyroIsMarkedCountedAndToldOnce) {
  StreamRun run;
  for (int i = 0; i < 30; ++i) {
    SensorMessage message = ImuAt(0.01 * i);
    message.sample.w_imu_radps.z() = i < 10 ? 0.1 * i : 8.7;  // at the end of its range
    run.Feed({message});
  }
  EXPECT_FALSE(run.Of<ImuReady>().front().sample.is_rate_saturated);
  EXPECT_TRUE(run.Of<ImuReady>().back().sample.is_rate_saturated);
  EXPECT_GT(run.counters.num_imu_clipped, 10);
  ASSERT_EQ(run.Of<Notice>().size(), 1u);
  EXPECT_NE(run.Of<Notice>()[0].text.find("gyro is saturated"), std::string::npos);
  EXPECT_EQ(run.Of<Notice>()[0].severity, Notice::Severity::kWarning);
}

// 200 deg/s is a turn; 200 rad/s is no gyro's.
TEST(SensorStream, RangeOfTheGyroIsJudgedInTheUnitsThatTheOptionAllows) {
  for (const ImuUnits units : {ImuUnits::kAutomatic, ImuUnits::kDeg, ImuUnits::kSi}) {
    StreamOptions options;
    options.units = units;
    StreamRun run(options);
    SensorMessage message = ImuAt(0.0);
    message.sample.w_imu_radps.z() = 200.0;
    if (units == ImuUnits::kAutomatic) run.stream.SetConvention(ConventionOf(ImuUnits::kDeg));
    run.Feed({message});
    const bool is_usable = units != ImuUnits::kSi;
    EXPECT_EQ(run.counters.num_imu_out_of_range, is_usable ? 0 : 1);
    EXPECT_EQ(run.Of<ImuReady>().size(), is_usable ? 1u : 0u);
  }
}

}  // namespace
}  // namespace lio
