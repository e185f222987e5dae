// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/stream/sensor_stream.hpp"
#include "stream/stream_parameters.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using Step = ImuPreprocessor::Step;
using test::ImuAt;
using test::kRounding_s;
using test::LargestStep_s;
using test::Lines;
using test::SecondsOf;
using test::Sensor;
using test::SensorMessages;
using test::Sensors;
using test::Silenced;
using test::StampAt;
using test::Stepped;
using test::StreamRun;
using Texts = std::vector<std::string>;

// Both sensors are silent from 2.0 s on until 3.5 s.
SensorMessages GapOfBoth(double to_s) {
  return Silenced(Sensors(0.0, to_s), Sensor::kBoth, 2.0, 3.5);
}

std::size_t NumSegments(const StreamRun& run) {
  return run.Of<SegmentStarts>().size();
}

TEST(SensorStreamStep, GapOfMoreThanASecondStartsASegment) {
  StreamRun run;
  run.Feed(GapOfBoth(4.5));
  ASSERT_EQ(NumSegments(run), 1u);
  const SegmentStarts segment = run.Of<SegmentStarts>()[0];
  EXPECT_EQ(segment.step, Step::kGap);
  EXPECT_EQ(segment.first.stamp, StampAt(3.5));
  EXPECT_EQ(segment.last_imu, StampAt(1.99));
  const Texts lines = Lines(run.events);
  const auto at = std::find(lines.begin(), lines.end(), "segment 3.500");
  EXPECT_EQ(*(at - 1), "sweep 1.900");
  EXPECT_EQ(*(at + 1), "imu 3.500");
  EXPECT_EQ(run.stream.imu().samples().front().stamp, StampAt(3.5)) << "the buffer began anew";
}

TEST(SensorStreamStep, FirstSampleOfASegmentIsInSiUnitsAndTheAxesOfTheRig) {
  StreamOptions options;
  options.units = ImuUnits::kG;
  StreamRun run(options);
  run.Feed(GapOfBoth(4.5));
  const Vector3 sent = ImuAt(3.5).sample.f_imu_mps2;
  EXPECT_TRUE(run.Of<SegmentStarts>().at(0).first.f_imu_mps2.isApprox(9.80665 * sent, 1e-12));
}

TEST(SensorStreamStep, ClocksThatAreSetBackStartASegment) {
  for (const double step_s : {-0.503, -3.0}) {
    StreamRun run;
    run.Feed(Stepped(Sensors(0.0, 4.0), Sensor::kBoth, 2.0, step_s));
    ASSERT_EQ(NumSegments(run), 1u) << step_s;
    EXPECT_EQ(run.Of<SegmentStarts>()[0].step, Step::kSetBack);
    EXPECT_EQ(run.Of<SegmentStarts>()[0].first.stamp, StampAt(2.0 + step_s));
    EXPECT_TRUE(run.Of<Notice>().empty()) << step_s;
    EXPECT_EQ(run.SweepStarts().back(), StampAt(3.8 + step_s)) << "sweeps go on in the new time";
    EXPECT_EQ(run.counters.num_scans_late, 0) << step_s;
  }
}

TEST(SensorStreamStep, SegmentWaitsForIdleAndWhatComesMeanwhileWaitsBehind) {
  StreamRun run;
  run.Feed(GapOfBoth(4.5), false);
  EXPECT_EQ(Lines(run.events).back(), "sweep 1.900");
  EXPECT_EQ(NumSegments(run), 0u);
  run.Feed(Sensors(4.5, 4.7), false);
  EXPECT_EQ(Lines(run.events).back(), "sweep 1.900");
  const auto num_before = static_cast<std::ptrdiff_t>(run.events.size());
  run.Drain();
  const std::vector<StreamEvent> after(run.events.begin() + num_before, run.events.end());
  const Texts lines = Lines(after);
  EXPECT_EQ(lines.at(0), "segment 3.500");
  EXPECT_EQ(lines.at(1), "imu 3.500");
  EXPECT_EQ(SecondsOf(run.MeasuredStamps().back()), 4.69);
  EXPECT_LT(LargestStep_s(run.MeasuredStamps()), 1.52) << "nothing but the gap is missing";
}

TEST(SensorStreamStep, SweepsThatWaitAtAStepAreGivenBeforeTheSegment) {
  StreamRun run;
  run.stream.SetBegin(StampAt(0.0));
  run.Feed(Silenced(GapOfBoth(4.5), Sensor::kImu, 1.95, 2.0));
  const Texts lines = Lines(run.events);
  const auto at = std::find(lines.begin(), lines.end(), "segment 3.500");
  ASSERT_NE(at, lines.end());
  EXPECT_EQ(Texts(at - 2, at), (Texts{"made up 1.990", "sweep 1.900"}));
  EXPECT_EQ(run.counters.num_scans_without_imu, 1);
}

TEST(SensorStreamStep, SweepsThatWaitAtAStepAreDroppedWhileNothingHasBegun) {
  StreamRun run;
  run.Feed(Silenced(GapOfBoth(4.5), Sensor::kImu, 1.95, 2.0));
  const std::vector<Timestamp> starts = run.SweepStarts();
  EXPECT_EQ(std::count(starts.begin(), starts.end(), StampAt(1.9)), 0);
  EXPECT_EQ(run.counters.num_scans_without_imu, 1);
}

TEST(SensorStreamStep, StampsOfBothThatGoForthByLessThanASecondAreAmbiguous) {
  for (const double step_s : {0.25, 0.4, 0.95}) {
    StreamRun run;
    run.Feed(Stepped(Sensors(0.0, 4.0), Sensor::kBoth, 2.0, step_s));
    ASSERT_EQ(run.Of<AmbiguousClockStep>().size(), 1u) << step_s;
    EXPECT_EQ(run.Of<AmbiguousClockStep>()[0].stamps.before, StampAt(1.99));
    EXPECT_EQ(run.Of<AmbiguousClockStep>()[0].stamps.after, StampAt(2.0 + step_s));
    EXPECT_EQ(NumSegments(run), 0u);
    EXPECT_TRUE(run.Of<Notice>().empty());
    EXPECT_EQ(run.MeasuredStamps().back(), StampAt(3.99 + step_s));
  }
}

TEST(SensorStreamStep, AmbiguousStepComesBeforeTheSamplesAfterIt) {
  StreamRun run;
  run.Feed(Stepped(Sensors(0.0, 4.0), Sensor::kBoth, 2.0, 0.4));
  const Texts lines = Lines(run.events);
  const auto at = std::find(lines.begin(), lines.end(), "ambiguous 1.990 to 2.400");
  ASSERT_NE(at, lines.end());
  EXPECT_EQ(Texts(at + 1, at + 4), (Texts{"made up 1.991", "made up 2.399", "imu 2.400"}));
}

TEST(SensorStreamStep, HoleDuringWhichTheLidarWentOnIsNotAmbiguous) {
  for (const double hole_s : {0.25, 0.4, 0.95}) {
    StreamRun run;
    run.Feed(Silenced(Sensors(0.0, 4.0), Sensor::kImu, 2.0, 2.0 + hole_s));
    EXPECT_TRUE(run.Of<AmbiguousClockStep>().empty()) << hole_s;
    EXPECT_EQ(NumSegments(run), 0u) << hole_s;
    EXPECT_TRUE(run.Of<Notice>().empty()) << hole_s;
    EXPECT_EQ(run.counters.num_imu_gaps, 1);
    EXPECT_EQ(run.SweepStarts().size(), 39u) << hole_s;
  }
}

TEST(SensorStreamStep, ClocksThatAreSetForthByWhatTheyWereSetBackAreSetRight) {
  StreamRun run;
  const SensorMessages back = Stepped(Sensors(0.0, 6.0), Sensor::kBoth, 2.0, -3.0);
  run.Feed(Stepped(back, Sensor::kBoth, 4.0, 3.0));
  ASSERT_EQ(NumSegments(run), 2u);
  EXPECT_EQ(run.Of<SegmentStarts>()[1].step, Step::kSetRight);
  EXPECT_EQ(run.SweepStarts().back(), StampAt(5.8));
}

// A pause as long as the clocks are behind: the lidar, which went on, tells that time passed.
TEST(SensorStreamStep, PauseOfTheImuAloneDoesNotSetClocksRight) {
  StreamRun run;
  const SensorMessages back = Stepped(Sensors(0.0, 9.0), Sensor::kBoth, 2.0, -3.0);
  run.Feed(Silenced(back, Sensor::kImu, 4.0, 7.0));
  EXPECT_EQ(NumSegments(run), 1u);
  EXPECT_EQ(run.Of<ImuAbsent>().size(), 1u);
  EXPECT_EQ(run.Of<ImuAppeared>().size(), 1u);
  EXPECT_EQ(run.counters.num_clock_jumps, 1);
}

TEST(SensorStreamStep, SweepThatTheGapCutsShortIsClosedBeforeTheSegment) {
  StreamRun run;
  run.stream.SetBegin(StampAt(0.0));
  SensorMessages messages = GapOfBoth(4.5);
  for (test::SensorMessage& message : messages) {
    if (message.chunk && message.chunk->stamp == StampAt(1.9)) message.chunk->chunk_count = 2;
  }
  run.Feed(messages);
  const Texts lines = Lines(run.events);
  const auto at = std::find(lines.begin(), lines.end(), "segment 3.500");
  ASSERT_NE(at, lines.end());
  EXPECT_EQ(*(at - 1), "sweep 1.900");
}

TEST(SensorStreamStep, StepWithoutLidarIsNotWaitedFor) {
  const SensorMessages imu = Silenced(Sensors(0.0, 4.0), Sensor::kLidar, 0.0, 4.0);
  StreamRun run;
  for (const test::SensorMessage& message : Stepped(imu, Sensor::kImu, 2.0, -3.0)) {
    if (message.taken_s < 2.045) run.Feed({message});  // five samples tell of the step
  }
  EXPECT_EQ(NumSegments(run), 1u);
}

TEST(SensorStreamStep, LidarThatFallsSilentAtAStepIsWaitedForOneSecond) {
  const SensorMessages messages =
      Stepped(Silenced(Sensors(0.0, 4.0), Sensor::kLidar, 2.0, 4.0), Sensor::kImu, 2.0, -3.0);
  StreamRun run;
  for (const test::SensorMessage& message : messages) {
    run.Feed({message});
    EXPECT_TRUE(NumSegments(run) == 0u || message.taken_s > 3.0) << message.taken_s;
  }
  EXPECT_EQ(NumSegments(run), 1u);
  EXPECT_NEAR(SecondsOf(run.MeasuredStamps().back()), 0.99, kRounding_s);
}

// The stamps of the chunks that come at the step tell nothing, and they are as large as can be.
TEST(SensorStreamStep, TheWaitForTheLidarIsBoundedByPoints) {
  StreamRun run;
  run.Feed(Stepped(Sensors(0.0, 2.08), Sensor::kBoth, 2.0, -3.0));
  ASSERT_EQ(NumSegments(run), 0u);
  std::size_t num_points = 0;
  while (NumSegments(run) == 0 && num_points < 2 * kStream.max_judged_points) {
    test::SensorMessage wild = test::SweepFrom(500.0);
    wild.chunk->points.assign(400'000, {});
    num_points += wild.chunk->points.size();
    run.Feed({wild});
  }
  EXPECT_EQ(NumSegments(run), 1u);
  EXPECT_LT(num_points, kStream.max_judged_points + 800'000);
}

TEST(SensorStreamStep, FlushEndsTheWaitForTheLidar) {
  StreamRun run;
  run.Feed(Stepped(Sensors(0.0, 2.08), Sensor::kBoth, 2.0, -3.0));
  EXPECT_EQ(NumSegments(run), 0u);
  run.Finish();
  EXPECT_EQ(NumSegments(run), 1u);
  EXPECT_EQ(Lines(run.events).back(), "ended");
  EXPECT_EQ(run.MeasuredStamps().back(), StampAt(-0.93));
}

TEST(SensorStreamStep, RejectEndsTheWaitForIdle) {
  StreamRun run;
  run.Feed(GapOfBoth(4.5), false);
  run.stream.Reject();
  run.Drain();
  EXPECT_EQ(NumSegments(run), 0u);
}

TEST(SensorStreamStep, OnlySoManyMessagesWaitForIdleAndTheRestIsCounted) {
  StreamRun run;
  run.Feed(GapOfBoth(3.5));
  run.Feed(Silenced(Sensors(3.5, 4.5), Sensor::kLidar, 0.0, 10.0), false);
  ASSERT_EQ(NumSegments(run), 0u) << "the step must wait for idle";
  const std::int64_t num_before = run.counters.num_imu;
  constexpr std::size_t kTooMany = 100;
  const std::size_t num_sent = kStream.max_waiting_messages + kTooMany;
  for (std::size_t i = 0; i < num_sent; ++i) {
    run.Add(ImuAt(4.5 + 0.01 * static_cast<double>(i)));
  }
  EXPECT_GE(run.counters.num_imu_late, static_cast<std::int64_t>(kTooMany));
  EXPECT_EQ(run.counters.num_imu - num_before, run.counters.num_imu_late);
  run.Drain();
  EXPECT_EQ(NumSegments(run), 1u);
}

}  // namespace
}  // namespace lio
