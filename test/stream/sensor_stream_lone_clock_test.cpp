// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// An IMU with a clock of its own, which steps while the lidar's goes on.
#include <gtest/gtest.h>

#include "lio/stream/sensor_stream.hpp"
#include "support/stream_feed.hpp"

namespace lio {
namespace {

using test::kRounding_s;
using test::LargestStep_s;
using test::SecondsOf;
using test::Sensor;
using test::SensorMessages;
using test::Sensors;
using test::Silenced;
using test::Stepped;
using test::StreamRun;

TEST(SensorStreamLoneClock, ImuClockThatStepsAloneIsShifted) {
  for (const double step_s : {-3.0, -0.503, 0.4, 1.5, 3.0}) {
    StreamRun run;
    run.Feed(Stepped(Sensors(0.0, 4.0), Sensor::kImu, 2.0, step_s));
    const std::vector<Timestamp> stamps = run.MeasuredStamps();
    EXPECT_EQ(stamps.size(), 400u) << step_s;
    EXPECT_NEAR(LargestStep_s(stamps), 0.01, kRounding_s) << step_s;
    EXPECT_NEAR(SecondsOf(stamps.back()), 3.99, kRounding_s) << step_s;
    EXPECT_EQ(run.SweepStarts().size(), 39u) << "every sweep is covered, step " << step_s;
    EXPECT_EQ(run.Of<SegmentStarts>().size(), 0u) << step_s;
    EXPECT_TRUE(run.Of<AmbiguousClockStep>().empty()) << step_s;
    ASSERT_EQ(run.Of<Notice>().size(), 1u) << step_s;
    EXPECT_EQ(run.Of<Notice>()[0].severity, Notice::Severity::kWarning);
    EXPECT_NE(run.Of<Notice>()[0].text.find("clock stepped by"), std::string::npos);
  }
}

TEST(SensorStreamLoneClock, StepsOfTheImuClockAloneAddUp) {
  StreamRun run;
  const SensorMessages once = Stepped(Sensors(0.0, 6.0), Sensor::kImu, 2.0, -3.0);
  run.Feed(Stepped(once, Sensor::kImu, 4.0, -5.0));
  EXPECT_NEAR(LargestStep_s(run.MeasuredStamps()), 0.01, kRounding_s);
  ASSERT_EQ(run.Of<Notice>().size(), 2u);
  EXPECT_NE(run.Of<Notice>()[1].text.find("shifted by 8.000 s"), std::string::npos)
      << run.Of<Notice>()[1].text;
}

TEST(SensorStreamLoneClock, LidarClockThatStepsAloneIsShifted) {
  for (const double step_s : {-3600.0, -1.5, -0.2, 0.2, 1.5, 3600.0}) {
    StreamRun run;
    run.Feed(Stepped(Sensors(0.0, 6.0), Sensor::kLidar, 2.0, step_s));
    run.Finish();
    EXPECT_EQ(run.SweepStarts().size(), 59u) << step_s;
    EXPECT_NEAR(LargestStep_s(run.SweepStarts()), 0.1, 0.011) << step_s;
    EXPECT_EQ(run.Of<SegmentStarts>().size(), 0u) << step_s;
    EXPECT_EQ(run.counters.num_clock_jumps, 1) << step_s;
    ASSERT_EQ(run.Of<Notice>().size(), 1u) << step_s;
    EXPECT_NE(run.Of<Notice>()[0].text.find("the lidar's clock stepped by"), std::string::npos);
  }
}

TEST(SensorStreamLoneClock, ChunksThatAreHeldAtARejectionAreAccountedFor) {
  StreamRun run;
  run.Feed(Stepped(Sensors(0.0, 3.25), Sensor::kLidar, 3.0, 1.5));
  const std::int64_t waiting = run.stream.ledgers().chunks.num_waiting;
  EXPECT_GT(waiting, 0);
  run.stream.Reject();
  EXPECT_EQ(run.stream.ledgers().chunks.num_waiting, 0);
  EXPECT_EQ(run.stream.ledgers().chunks.Unaccounted(), 0);
}

// Samples are missing around the step: only the lidar knows for how long.
TEST(SensorStreamLoneClock, ImuClockThatStepsAloneInAPauseIsSetByTheLidar) {
  constexpr double kTolerance_s = 0.03;  // the sweeps' steady delay
  StreamRun run;
  const SensorMessages paused = Silenced(Sensors(0.0, 4.0), Sensor::kImu, 2.0, 2.5);
  run.Feed(Stepped(paused, Sensor::kImu, 2.5, -3.0));
  EXPECT_EQ(run.Of<SegmentStarts>().size(), 0u);
  EXPECT_NEAR(LargestStep_s(run.MeasuredStamps()), 0.51, kTolerance_s);
  EXPECT_NEAR(SecondsOf(run.MeasuredStamps().back()), 3.99, kTolerance_s);
}

// The lidar went on in the hole, so the hole was none of the clock's doing, and a step back of the
// same length does not undo it.
TEST(SensorStreamLoneClock, StepBackAsLongAsAHoleBeforeIsShiftedAllTheSame) {
  StreamRun run;
  const SensorMessages hole = Silenced(Sensors(0.0, 5.0), Sensor::kImu, 2.0, 2.4);
  run.Feed(Stepped(hole, Sensor::kImu, 3.5, -0.4));
  EXPECT_EQ(run.Of<Notice>().size(), 1u);
  EXPECT_NEAR(SecondsOf(run.MeasuredStamps().back()), 4.99, kRounding_s);
  EXPECT_EQ(run.SweepStarts().size(), 49u);
}

// While the lidar is silent nobody can tell that the clock went forth; when it comes back, the
// stamps are right without a shift.
TEST(SensorStreamLoneClock, StepBackThatUndoesAnUnseenStepIsNotShifted) {
  StreamRun run;
  SensorMessages messages = Silenced(Sensors(0.0, 7.0), Sensor::kLidar, 2.0, 3.2);
  messages = Stepped(messages, Sensor::kImu, 2.0, 0.4);
  run.Feed(Stepped(messages, Sensor::kImu, 4.5, -0.4));
  EXPECT_EQ(run.Of<AmbiguousClockStep>().size(), 1u);
  EXPECT_EQ(run.Of<SegmentStarts>().size(), 0u);
  EXPECT_NEAR(SecondsOf(run.MeasuredStamps().back()), 6.99, kRounding_s);
}

}  // namespace
}  // namespace lio
