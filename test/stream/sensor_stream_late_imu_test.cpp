// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// An IMU that comes up after the lidar has begun alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/stream/sensor_stream.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::ImuAt;
using test::Lines;
using test::Sensor;
using test::SensorMessage;
using test::SensorMessages;
using test::Sensors;
using test::Silenced;
using test::StampAt;
using test::Stepped;
using test::StreamRun;
using Texts = std::vector<std::string>;

// The IMU sends from `from_s` on.
SensorMessages LateImu(double from_s, double to_s) {
  return Silenced(Sensors(0.0, to_s), Sensor::kImu, 0.0, from_s);
}

// Feeds the messages that arrive before the IMU's sample of `until_s`.
void FeedBefore(StreamRun& run, const SensorMessages& messages, double until_s) {
  for (const SensorMessage& message : messages) {
    if (!message.chunk && message.taken_s > until_s - 1e-6) return;
    run.Feed({message});
  }
}

TEST(SensorStreamLateImu, AppearsOnceItsSamplesSpanHalfASecond) {
  StreamRun run;
  FeedBefore(run, LateImu(4.0, 5.0), 4.5);
  EXPECT_TRUE(run.Of<ImuAppeared>().empty());
  EXPECT_FALSE(run.stream.has_imu());
  run.Feed({ImuAt(4.5)});
  ASSERT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.Of<ImuAppeared>()[0].first, StampAt(4.0));
  EXPECT_TRUE(run.stream.has_imu());
}

TEST(SensorStreamLateImu, ItsFirstSamplesFollowAndSweepsGoOn) {
  StreamRun run;
  run.Feed(LateImu(4.0, 5.0));
  const Texts lines = Lines(run.events);
  EXPECT_EQ(lines.at(0), "absent 0.090");
  const auto at = std::find(lines.begin(), lines.end(), "appeared 4.000");
  ASSERT_NE(at, lines.end());
  EXPECT_EQ(*(at + 1), "imu 4.000");
  EXPECT_EQ(run.MeasuredStamps().size(), 100u);
  EXPECT_EQ(run.SweepStarts().size(), 49u) << "none is given twice or lost";
  EXPECT_TRUE(run.Of<SegmentStarts>().empty());
}

TEST(SensorStreamLateImu, WaitsForIdle) {
  StreamRun run;
  run.Feed(LateImu(4.0, 5.0), false);
  EXPECT_TRUE(run.Of<ImuAppeared>().empty());
  EXPECT_EQ(run.SweepStarts().back(), StampAt(4.3)) << "what comes meanwhile waits behind";
  run.Drain();
  EXPECT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.SweepStarts().back(), StampAt(4.8));
}

TEST(SensorStreamLateImu, StraySampleIsNoImu) {
  StreamRun run;
  SensorMessages messages = LateImu(6.0, 7.0);
  const auto at = std::find_if(messages.begin(), messages.end(),
                               [](const SensorMessage& message) { return message.taken_s > 2.95; });
  messages.insert(at, ImuAt(3.0));
  FeedBefore(run, messages, 6.5);
  EXPECT_TRUE(run.Of<ImuAppeared>().empty());
  run.Feed({ImuAt(6.5)});
  ASSERT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.Of<ImuAppeared>()[0].first, StampAt(6.0));
}

TEST(SensorStreamLateImu, RepeatedSamplesOfItAreLate) {
  StreamRun run;
  SensorMessages messages = LateImu(4.0, 5.0);
  const auto at = std::find_if(messages.begin(), messages.end(), [](const SensorMessage& message) {
    return !message.chunk && message.taken_s > 4.2;
  });
  messages.insert(at, *at);
  run.Feed(messages);
  EXPECT_EQ(run.counters.num_imu_late, 1);
  EXPECT_EQ(run.MeasuredStamps().size(), 100u);
}

TEST(SensorStreamLateImu, ImuByAnotherClockIsToldAndNotUsed) {
  StreamRun run;
  run.Feed(Stepped(LateImu(4.0, 6.0), Sensor::kImu, 0.0, 100.0));
  EXPECT_TRUE(run.Of<ImuAppeared>().empty());
  EXPECT_FALSE(run.stream.has_imu());
  EXPECT_EQ(run.counters.num_imu_late, 200);
  ASSERT_FALSE(run.Of<Notice>().empty());
  EXPECT_NE(run.Of<Notice>()[0].text.find("before the inertial samples"), std::string::npos)
      << run.Of<Notice>()[0].text;
  EXPECT_EQ(run.SweepStarts().size(), 59u);
}

// Sweeps from 4.2 to 4.4 s are stamped wrong: what the IMU sent up to then cannot be trusted.
TEST(SensorStreamLateImu, SamplesBeforeATimeOfDifferentClocksDoNotCount) {
  StreamRun run;
  const SensorMessages apart = Stepped(LateImu(4.0, 6.0), Sensor::kLidar, 4.2, 100.0);
  run.Feed(Stepped(apart, Sensor::kLidar, 4.4, -100.0));
  ASSERT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.Of<ImuAppeared>()[0].first, StampAt(4.51)) << "after the next sweep has come";
}

}  // namespace
}  // namespace lio
