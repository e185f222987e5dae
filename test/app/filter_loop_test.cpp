// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests what the filter thread tells the status; live_runner_test.cpp tests that it gives the
// estimate of a replay.
#include "app/filter_loop.hpp"

#include <gtest/gtest.h>

#include "app/live_fixture.hpp"
#include "lio/io/output_decoder.hpp"

namespace lio {
namespace {

class FilterLoopTest : public LiveRunnerTest {
 protected:
  // Plays the log to a runner, and keeps what came on LIO_STATUS and LIO_STATE.
  void PlayAndHear(const Options& options) {
    const Channels channels;
    bus_->Subscribe(channels.status, 1000, [this](ByteView data, std::int64_t) {
      EXPECT_EQ(DecodeStatusReport(data, statuses_.emplace_back()), DecodeStatus::kOk);
    });
    bus_->Subscribe(channels.state, 1000, [this](ByteView data, std::int64_t) {
      EXPECT_EQ(DecodeFilterState(data, states_.emplace_back()), DecodeStatus::kOk);
    });
    LiveRunner runner(*bus_, options, LiveOptions());
    Play(runner);
    runner.Stop();
    while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
    }
    ASSERT_GE(statuses_.size(), 2U);
    ASSERT_GT(states_.size(), 40U);
  }

  std::vector<StatusReport> statuses_;
  std::vector<FilterReport> states_;
};

TEST_F(FilterLoopTest, TheStatusHasTheClockOffsetThatTheFilterEstimates) {
  Options options = SceneOptions();
  options.rig.lidar.clock_offset_s = 0.001;
  PlayAndHear(options);
  const ClockOffsetStatus first = statuses_.front().clock_offset;
  EXPECT_EQ(first.offset_s, 0.001) << "as configured, before there is an estimate";
  EXPECT_EQ(first.std_s, 0.0);
  const ClockOffsetStatus last = statuses_.back().clock_offset;
  EXPECT_EQ(last.offset_s, states_.back().clock_offset_s);
  EXPECT_EQ(last.std_s, states_.back().clock_offset_std_s);
  EXPECT_GT(last.std_s, 0.0);
  EXPECT_LT(last.std_s, 0.02) << "the street has told something beyond what was assumed";
}

TEST_F(FilterLoopTest, AnOffsetThatIsNotEstimatedHasNoStandardDeviation) {
  Options options = SceneOptions();
  options.rig.lidar.clock_offset_s = 0.001;
  options.filter.estimate_clock_offset = false;
  PlayAndHear(options);
  for (const StatusReport& status : statuses_) {
    EXPECT_EQ(status.clock_offset.offset_s, 0.001);
    EXPECT_EQ(status.clock_offset.std_s, 0.0);
  }
}

}  // namespace
}  // namespace lio
