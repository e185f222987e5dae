// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests what the filter thread tells the status; live_runner_test.cpp tests that it gives the
// estimate of a replay.
#include "app/filter_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/live_fixture.hpp"
#include "lio/io/output_account.hpp"
#include "lio/io/output_decoder.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FilterLoopTest : public LiveRunnerTest {
 protected:
  // Plays the log to a runner, and keeps what came on LIO_STATUS and LIO_STATE.
  void PlayAndHear(const Options& options) {
    const Channels channels;
    for (const std::string& channel :
         {channels.imu, channels.scan, channels.registration, channels.status}) {
      bus_->Subscribe(channel, 100'000, [this, channel](ByteView data, std::int64_t) {
        account_.Add(channel, data);
      });
    }
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
  OutputAccount account_{Channels()};  // hears the whole run, as a recorder does
};

TEST_F(FilterLoopTest, TheAccountOfEveryStatusCloses) {
  PlayAndHear(SceneOptions());
  for (const StatusReport& status : statuses_) {
    for (const AccountPage& page : status.account) {
      EXPECT_EQ(page.Unaccounted(), 0) << page.name << " of message " << status.seq;
      for (const AccountEntry& entry : page.entries) EXPECT_GE(entry.count, 0) << entry.name;
    }
  }
  for (const AccountPage& page : statuses_.back().account) {
    EXPECT_GT(page.num_received(), 0) << page.name;
  }
}

TEST_F(FilterLoopTest, ARecordingClosesUntilANumberIsFalse) {
  PlayAndHear(SceneOptions());
  EXPECT_THAT(account_.Text(), HasSubstr("messages: "));
  EXPECT_THAT(account_.Text(), HasSubstr("rows: "));
  EXPECT_THAT(account_.Text(), Not(HasSubstr("does not close"))) << account_.Text();
  StatusReport falsified = statuses_.back();
  falsified.account[1].entries.front().count -= 3;
  account_.Add(Channels().status, EncodeStatus(falsified, "1.0.0"));
  EXPECT_THAT(account_.Text(), HasSubstr("does not close by -3: they have two fates"));
}

TEST_F(FilterLoopTest, TheFirstStatusAloneHasTheOptions) {
  PlayAndHear(SceneOptions());
  EXPECT_EQ(statuses_.front().options, PrintOptions(SceneOptions()));
  for (std::size_t i = 1; i < statuses_.size(); ++i) EXPECT_EQ(statuses_[i].options, "");
}

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
