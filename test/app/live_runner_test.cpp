// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The daemon's threads over a bus in memory, on a log that lio-sim made for the tests.
#include "app/live_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lio/io/event_log.hpp"
#include "lio/io/options_yaml.hpp"
#include "support/replay_log.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

const std::filesystem::path kScene = LIO_SCENE_DIR;

Options SceneOptions() {
  LoadResult loaded = LoadOptions({kScene / "config.yaml"}, {"pipeline.max_queued_scans=50"});
  EXPECT_TRUE(loaded.faults.empty());
  return loaded.options;
}

class LiveRunnerTest : public ::testing::Test {
 protected:
  // Publishes the log up to `max_events`, as fast as that goes without overrunning anything: the
  // inertial samples run ahead of the matches by up to two scans.
  void Play(const LiveRunner& runner, std::int64_t max_events = INT64_MAX) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    std::int32_t num_scans = 0;
    for (std::int64_t i = 0; i < max_events && reader.Next(event); ++i) {
      ScanChunk chunk;
      if (event.channel == "LIO_SCAN" && DecodeChunk(event.data, chunk) == DecodeStatus::kOk) {
        num_scans = chunk.scan_seq;
      }
      while (runner.num_matches_done() + kMaxAhead < num_scans) std::this_thread::yield();
      bus_->Publish(event.channel, event.data);
      if (i % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  LiveOptions WithFiles(bool writes_map = false) const {
    LiveOptions live;
    live.out = out_;
    live.writes_map = writes_map;
    return live;
  }
  nlohmann::json Stats() { return nlohmann::json::parse(test::ReadText(out_ / "stats.json")); }
  std::string Live(const std::string& name) { return test::ReadText(out_ / name); }
  std::ptrdiff_t NumLines(const std::string& name) {
    const std::string text = Live(name);
    EXPECT_TRUE(text.empty() || text.back() == '\n');
    return std::count(text.begin(), text.end(), '\n');
  }

  static constexpr std::int64_t kMaxAhead =
      4;  // two closed scans, one growing, one not covered yet

  test::TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "live";
  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
};

TEST_F(LiveRunnerTest, ScanRateFilesAreReplaysByteForByte) {
  const Options options = SceneOptions();
  const Counters replayed = test::ReplayLog(kScene / "log.lcm", options, folder_.path() / "replay");
  LiveRunner runner(*bus_, options, WithFiles());
  Play(runner);
  runner.Stop();
  for (const char* name : {"trajectory.tum", "covariance.csv", "options.yaml"}) {
    EXPECT_TRUE(Live(name) == test::ReadText(folder_.path() / "replay" / name)) << name;
    EXPECT_FALSE(Live(name).empty()) << name;
  }
  EXPECT_EQ(Stats()["num_scans"], replayed.num_scans);
  EXPECT_EQ(Stats()["num_imu"], replayed.num_imu);
  EXPECT_EQ(Stats()["num_scans_dropped"], 0);
  EXPECT_EQ(Stats()["num_chunks_queue_dropped"], 0);
}

TEST_F(LiveRunnerTest, EveryChannelOfOursIsPublished) {
  std::map<std::string, int> num_messages;
  const Channels channels;
  for (const std::string& channel :
       {channels.odometry, channels.odometry_imu_rate, channels.state, channels.registration,
        channels.status, channels.cloud, channels.cloud_full}) {
    bus_->Subscribe(channel, 100'000,
                    [&, channel](ByteView, std::int64_t) { ++num_messages[channel]; });
  }
  LiveOptions full;
  full.publishes_full_cloud = true;
  LiveRunner runner(*bus_, SceneOptions(), full);
  Play(runner);
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  EXPECT_GT(num_messages[channels.odometry], 40);  // of 60 scans, the first second being the start
  EXPECT_EQ(num_messages[channels.state], num_messages[channels.odometry]);
  EXPECT_GE(num_messages[channels.registration], num_messages[channels.odometry]);
  EXPECT_GT(num_messages[channels.odometry_imu_rate], 400);
  EXPECT_GE(num_messages[channels.status], 2);
  EXPECT_GE(num_messages[channels.cloud], 8);
  EXPECT_GE(num_messages[channels.cloud_full], 8);
}

TEST_F(LiveRunnerTest, StoppingInTheMiddleLeavesCompleteFilesSoon) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles(true));
  Play(runner, 700);
  const auto begin = std::chrono::steady_clock::now();
  runner.Stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
  EXPECT_GT(NumLines("trajectory.tum"), 5);
  EXPECT_EQ(NumLines("covariance.csv"), NumLines("trajectory.tum") + 1);
  EXPECT_TRUE(std::filesystem::exists(out_ / "map.pcd"));
  EXPECT_EQ(Stats()["num_shutdowns_cut_short"], 0);
}

TEST_F(LiveRunnerTest, OverloadDropsWholeScansAndCountsThem) {
  LoadResult loaded = LoadOptions({kScene / "config.yaml"}, {"pipeline.max_queued_scans=1"});
  LiveRunner runner(*bus_, loaded.options, WithFiles());
  Play(runner, 500);  // past the start, where nothing is dropped
  EventLogReader reader(kScene / "log.lcm");
  LogEvent event;
  for (int i = 0; reader.Next(event); ++i) {
    if (i >= 500) bus_->Publish(event.channel, event.data);
  }
  runner.Stop();
  EXPECT_EQ(Stats()["num_imu_queue_dropped"], 0);
  EXPECT_EQ(Stats()["num_chunks_missing"], 0);
  EXPECT_GT(Stats()["num_scans_dropped"], 0);
  EXPECT_LT(Stats()["num_scans_dropped"], Stats()["num_scans"]);
}

TEST_F(LiveRunnerTest, WithoutInputItStopsAtOnceAndItsFilesAreThere) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles());
  runner.Stop();
  EXPECT_EQ(Stats()["num_scans"], 0);
  EXPECT_TRUE(Live("trajectory.tum").empty());
}

TEST_F(LiveRunnerTest, CommandsSwitchTheFullCloud) {
  int num_full = 0;
  bus_->Subscribe("LIO_CLOUD_FULL", 100'000, [&](ByteView, std::int64_t) { ++num_full; });
  LiveRunner runner(*bus_, SceneOptions(), LiveOptions());
  bus_->Publish("LIO_CMD", EncodeCommand({1, CommandAction::kCloudFullOn}));
  Play(runner);
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  EXPECT_GT(num_full, 0);
}

}  // namespace
}  // namespace lio
