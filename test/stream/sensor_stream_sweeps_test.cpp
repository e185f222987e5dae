// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which sweeps the stream gives out, and when.
#include <gtest/gtest.h>

#include "lio/stream/sensor_stream.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::ImuAt;
using test::Lines;
using test::OnlyImu;
using test::OnlyLidar;
using test::Sensor;
using test::SensorMessage;
using test::Sensors;
using test::Silenced;
using test::StampAt;
using test::StreamRun;
using test::SweepFrom;
using Texts = std::vector<std::string>;

TEST(SensorStreamSweeps, SweepThatMissesAChunkIsClosed50MsAfterItsEnd) {
  StreamRun run;
  SensorMessage half = SweepFrom(0.0);
  half.chunk->chunk_count = 2;
  run.Feed(OnlyImu(0.0, 0.1));
  run.Feed({half});
  run.Feed(OnlyImu(0.1, 0.15));
  EXPECT_TRUE(run.SweepStarts().empty()) << "the other chunk may still come";
  run.Feed({ImuAt(0.15)});
  ASSERT_EQ(run.Of<SweepReady>().size(), 1u);
  EXPECT_EQ(run.Of<SweepReady>()[0].sweep->num_missing_chunks, 1);
}

// Half a sweep, whose points were taken from `taken_s` on, by a clock that is `behind_s` behind.
SensorMessage HalfSweepFrom(double taken_s, int number, double behind_s) {
  SensorMessage half = SweepFrom(taken_s);
  ScanChunk& chunk = *half.chunk;
  chunk.stamp = chunk.stamp - Duration::FromSeconds(behind_s);
  chunk.scan_seq = number / 2;
  chunk.chunk_index = static_cast<std::int16_t>(number % 2);
  chunk.chunk_count = 2;
  chunk.points.back().t_offset_ns = 40'000'000;
  return half;
}

TEST(SensorStreamSweeps, ALidarWhoseClockIsBehindLosesNoChunk) {
  StreamRun run;
  for (int i = 0; i < 40; ++i) {
    const double begin_s = 0.05 * i;
    run.Feed(OnlyImu(begin_s, begin_s + 0.05));
    run.Feed({HalfSweepFrom(begin_s, i, 0.1)});
  }
  EXPECT_EQ(run.counters.num_chunks_late, 0);
  EXPECT_EQ(run.counters.num_chunks_missing, 0);
  EXPECT_EQ(run.SweepStarts().size(), 19u) << "all but that before the first sample";
}

TEST(SensorStreamSweeps, AChunkThatALateLidarLostIsWaitedForByItsOwnTime) {
  StreamRun run;
  for (int i = 0; i < 20; ++i) {
    run.Feed(OnlyImu(0.05 * i, 0.05 * i + 0.05));
    if (i < 19) run.Feed({HalfSweepFrom(0.05 * i, i, 0.1)});
  }
  run.Feed(OnlyImu(1.0, 1.04));
  EXPECT_EQ(run.counters.num_chunks_missing, 0);
  run.Feed(OnlyImu(1.04, 1.06));
  EXPECT_EQ(run.counters.num_chunks_missing, 1);
}

TEST(SensorStreamSweeps, WithoutImuStampsOfTheLidarCloseASweep) {
  StreamOptions options;
  options.use_imu = false;
  StreamRun run(options);
  SensorMessage half = SweepFrom(0.0);
  half.chunk->chunk_count = 2;
  run.Feed({half});
  EXPECT_TRUE(run.events.empty());
  run.Feed({SweepFrom(0.15)});
  EXPECT_EQ(Lines(run.events), (Texts{"sweep 0.000"}));
}

TEST(SensorStreamSweeps, SweepsBeforeTheFirstSampleAreCountedAndNotGiven) {
  StreamRun run;
  run.Feed(Silenced(Sensors(0.0, 1.0), Sensor::kImu, 0.0, 0.51));
  EXPECT_EQ(run.SweepStarts().at(0), StampAt(0.5)) << "10 ms before: the first sample holds there";
  EXPECT_EQ(run.counters.num_scans_without_imu, 5);
}

TEST(SensorStreamSweeps, SweepThatBegins30MsBeforeTheFirstSampleIsNotGiven) {
  StreamRun run;
  run.Feed(Silenced(Sensors(0.0, 1.0), Sensor::kImu, 0.0, 0.53));
  EXPECT_EQ(run.SweepStarts().at(0), StampAt(0.6));
  EXPECT_EQ(run.counters.num_scans_without_imu, 6);
}

TEST(SensorStreamSweeps, SweepsBeforeTheEstimatorsBeginAreNotGiven) {
  StreamRun run;
  run.stream.SetBegin(StampAt(0.3));
  run.Feed(Sensors(0.0, 0.6));
  EXPECT_EQ(run.SweepStarts().at(0), StampAt(0.3));
  EXPECT_EQ(run.counters.num_scans_without_imu, 3);
}

TEST(SensorStreamSweeps, SensorsOfDifferentClocksAreTold) {
  for (const double apart_s : {-100.0, 100.0}) {
    StreamRun run;
    run.Feed(Stepped(Sensors(0.0, 1.0), Sensor::kLidar, 0.0, apart_s));
    ASSERT_FALSE(run.Of<Notice>().empty()) << apart_s;
    const std::string expected = apart_s > 0.0 ? " s after" : " s before";
    EXPECT_NE(run.Of<Notice>()[0].text.find(expected), std::string::npos)
        << run.Of<Notice>()[0].text;
    EXPECT_TRUE(run.SweepStarts().empty());
  }
}

TEST(SensorStreamSweeps, LogWithoutImuGoesOnWithTheLidarAlone) {
  StreamRun run;
  run.Feed(OnlyLidar(0.0, 2.2));
  EXPECT_TRUE(run.events.empty());
  run.Feed({SweepFrom(2.1)});
  const Texts lines = Lines(run.events);
  ASSERT_EQ(lines.size(), 23u) << "2.1 s of sweeps have waited for an IMU";
  EXPECT_EQ(lines[0], "absent 0.090");
  EXPECT_EQ(lines[1], "sweep 0.000");
  EXPECT_EQ(lines[22], "sweep 2.100");
  EXPECT_FALSE(run.stream.has_imu());
  run.Feed({SweepFrom(2.2)});
  EXPECT_EQ(Lines(run.events).back(), "sweep 2.200");
}

TEST(SensorStreamSweeps, ShortLogWithoutImuGivesItsSweepsAtTheEnd) {
  StreamRun run;
  run.Feed(OnlyLidar(0.0, 0.3));
  EXPECT_TRUE(run.events.empty());
  run.Finish();
  const Texts expected = {"absent 0.090", "sweep 0.000", "sweep 0.100", "ended"};
  EXPECT_EQ(Lines(run.events), expected);
}

TEST(SensorStreamSweeps, FlushGivesTheSweepThatSamplesDoNotCover) {
  StreamRun run;
  SensorMessage half = SweepFrom(0.1);
  half.chunk->chunk_count = 2;
  run.Feed(Sensors(0.0, 0.15));
  run.Feed({half});
  run.Finish();
  const Texts lines = Lines(run.events);
  const Texts last(lines.end() - 3, lines.end());
  EXPECT_EQ(last, (Texts{"made up 0.190", "sweep 0.100", "ended"}));
}

}  // namespace
}  // namespace lio
