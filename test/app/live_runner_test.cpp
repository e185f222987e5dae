// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the daemon's threads over a bus in memory, on a log that lio-sim made for the tests.
#include "app/live_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "lio/io/event_log.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/odometry_t.hpp"
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

// Delivers nothing while it is held, so that messages pile up however slowly they are published.
class HoldableBus final : public Bus {
 public:
  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    bus_->Subscribe(channel, queue_capacity, std::move(handler));
  }
  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    if (!is_held_) return bus_->Receive(timeout);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ReceiveResult::kTimeout;
  }
  bool Publish(const std::string& channel, ByteView data) override {
    return bus_->Publish(channel, data);
  }
  std::int64_t num_oversized() const override { return bus_->num_oversized(); }
  std::int64_t num_handler_faults() const override { return bus_->num_handler_faults(); }
  void Hold(bool hold) { is_held_ = hold; }

 private:
  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
  std::atomic<bool> is_held_ = false;
};

class LiveRunnerTest : public ::testing::Test {
 protected:
  LiveRunnerTest() {
    bus_->Subscribe(kEndMark, 10, [this](ByteView, std::int64_t) { has_delivered_all_ = true; });
  }

  // Waits a minute, so that only what never happens fails on a busy machine.
  template <typename Condition>
  static void WaitUntil(Condition&& condition, const char* what) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "waited in vain until " << what;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }

  // Publishes the log up to `max_events`, as fast as possible without overrunning anything: the IMU
  // samples are ahead of the matches by up to two scans. `may_go_on` is told how many scans have
  // begun, and may hold the log up. Returns when the runner has been given everything.
  void Play(
      const LiveRunner& runner, std::int64_t max_events = INT64_MAX,
      const std::function<bool(std::int32_t)>& may_go_on = [](std::int32_t) { return true; }) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    std::int32_t num_scans = 0;
    for (std::int64_t i = 0; i < max_events && reader.Next(event); ++i) {
      ScanChunk chunk;
      if (event.channel == "LIO_SCAN" && DecodeChunk(event.data, chunk) == DecodeStatus::kOk) {
        num_scans = chunk.scan_seq;
      }
      WaitUntil([&] { return runner.num_matches_done() + kMaxAhead >= num_scans; },
                "scans are matched");
      WaitUntil([&] { return may_go_on(num_scans); }, "what came out allows the next scan");
      if (HasFatalFailure()) return;
      bus_->Publish(event.channel, event.data);
    }
    bus_->Publish(kEndMark, Bytes{0});
    WaitUntil([this] { return has_delivered_all_.load(); }, "all messages are delivered");
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

  // There are two closed scans, one that grows and one that is not covered yet.
  static constexpr std::int64_t kMaxAhead = 4;
  static constexpr const char* kEndMark = "TEST_END";

  std::atomic<bool> has_delivered_all_ = false;
  test::TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "live";
  std::unique_ptr<HoldableBus> bus_ = std::make_unique<HoldableBus>();
};

TEST_F(LiveRunnerTest, ScanRateFilesAreReplaysByteForByte) {
  const Options options = SceneOptions();
  const test::Replayed replayed =
      test::ReplayLog(kScene / "log.lcm", options, folder_.path() / "replay");
  LiveRunner runner(*bus_, options, WithFiles());
  Play(runner);
  // Stop gives the remaining work half a second, which may be too little on a busy machine.
  WaitUntil([&] { return runner.num_matches_done() >= replayed.num_matches; }, "all are matched");
  runner.Stop();
  for (const char* name : {"trajectory.tum", "trajectory_world.tum", "covariance.csv",
                           "covariance_world.csv", "options.yaml"}) {
    EXPECT_TRUE(Live(name) == test::ReadText(folder_.path() / "replay" / name)) << name;
    EXPECT_FALSE(Live(name).empty()) << name;
  }
  EXPECT_EQ(Stats()["num_scans"], replayed.counters.num_scans);
  EXPECT_EQ(Stats()["num_imu"], replayed.counters.num_imu);
  EXPECT_EQ(Stats()["num_scans_dropped"], 0);
  EXPECT_EQ(Stats()["num_chunks_queue_dropped"], 0);
}

// A newer cloud replaces one that still waits to be sent. The log is therefore held up while the
// last full cloud is too many scans old, so that enough of them are sent however slow the machine
// is.
TEST_F(LiveRunnerTest, EveryChannelOfOursIsPublished) {
  const Channels channels;
  std::map<std::string, std::atomic<int>> num_messages;
  std::atomic<std::int32_t> last_full_cloud = -1;
  for (const std::string& channel :
       {channels.odometry, channels.odometry_imu_rate, channels.state, channels.registration,
        channels.status, channels.cloud, channels.cloud_full}) {
    std::atomic<int>& num = num_messages[channel];
    bus_->Subscribe(channel, 100'000, [&num](ByteView, std::int64_t) { ++num; });
  }
  bus_->Subscribe(channels.cloud_full, 100'000, [&](ByteView data, std::int64_t) {
    ScanChunk chunk;
    EXPECT_EQ(DecodeChunk(data, chunk), DecodeStatus::kOk);
    last_full_cloud = chunk.scan_seq;
  });
  LiveOptions full;
  full.publishes_full_cloud = true;
  LiveRunner runner(*bus_, SceneOptions(), full);
  constexpr std::int32_t kMaxCloudAge = kMaxAhead + 2;
  std::int32_t start = INT32_MAX;  // how many scans had begun when the first pose came
  Play(runner, INT64_MAX, [&](std::int32_t num_scans) {
    if (start == INT32_MAX && num_messages[channels.odometry] == 0) return true;
    start = std::min(start, num_scans);
    return num_scans <= std::max<std::int32_t>(start, last_full_cloud) + kMaxCloudAge;
  });
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  EXPECT_GT(num_messages[channels.odometry], 40);  // of 60 scans, the first second being the start
  EXPECT_EQ(num_messages[channels.state], num_messages[channels.odometry]);
  EXPECT_GE(num_messages[channels.registration], num_messages[channels.odometry]);
  EXPECT_GT(num_messages[channels.odometry_imu_rate], 400);
  EXPECT_GE(num_messages[channels.status], 2);
  EXPECT_GE(num_messages[channels.cloud_full], 40 / kMaxCloudAge);
  EXPECT_GE(num_messages[channels.cloud], 4);  // due every fifth scan
}

// Two messages of one instant are compared: base's pose and motion are imu's, transformed by hand.
void ExpectMoved(const odometry_t& imu, const odometry_t& base, const Pose& T_base_imu) {
  const auto pose_of = [](const odometry_t& m) {
    return Pose{Quaternion(m.quat[0], m.quat[1], m.quat[2], m.quat[3]), Vector3(m.pos)};
  };
  const Pose expected = pose_of(imu) * T_base_imu.Inverse();
  EXPECT_LT(LogSe3(expected.Inverse() * pose_of(base)).norm(), 1e-9);
  const Vector3 w_imu(imu.rotation_rate);
  EXPECT_LT((T_base_imu.rotation * w_imu - Vector3(base.rotation_rate)).norm(), 1e-12);
  const Vector3 turning = w_imu.cross(T_base_imu.Inverse().translation);
  const Vector3 velocity = Vector3(imu.vel) + pose_of(imu).rotation * turning;
  EXPECT_LT((velocity - Vector3(base.vel)).norm(), 1e-12);
  EXPECT_EQ(imu.scan_seq, base.scan_seq);
  EXPECT_EQ(imu.source, base.source);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(base.pose_cov[i][i], 0.0);
    EXPECT_GT(base.vel_cov[i][i], 0.0);
  }
}

TEST_F(LiveRunnerTest, TheBaseFrameMovesWithTheImu) {
  Options options = SceneOptions();
  const Pose T_base_imu{ExpSo3(Vector3(0.1, -0.2, 0.7)), Vector3(1.5, -0.3, 0.8)};
  options.rig.T_base_imu = T_base_imu;
  std::map<std::string, std::map<std::int64_t, odometry_t>> by_channel;
  for (const char* channel : {"LIO_ODOM", "LIO_ODOM_BASE", "LIO_ODOM_IMU", "LIO_ODOM_BASE_IMU"}) {
    bus_->Subscribe(channel, 100'000, [&of = by_channel[channel]](ByteView data, std::int64_t) {
      odometry_t message{};
      ASSERT_EQ(message.decode(data.data(), 0, static_cast<int>(data.size())),
                static_cast<int>(data.size()));
      of[message.utime] = message;
    });
  }
  LiveRunner runner(*bus_, options, WithFiles());
  Play(runner);
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  for (const auto& [imu_channel, base_channel] :
       {std::pair("LIO_ODOM", "LIO_ODOM_BASE"), std::pair("LIO_ODOM_IMU", "LIO_ODOM_BASE_IMU")}) {
    EXPECT_GT(by_channel[imu_channel].size(), 40u);
    EXPECT_EQ(by_channel[imu_channel].size(), by_channel[base_channel].size());
    for (const auto& [utime, imu] : by_channel[imu_channel]) {
      ExpectMoved(imu, by_channel[base_channel].at(utime), T_base_imu);
    }
  }
  EXPECT_EQ(NumLines("trajectory_base.tum"), NumLines("trajectory.tum"));
}

TEST_F(LiveRunnerTest, TheLocalPoseIsTheOneInMap) {
  std::map<std::string, std::vector<odometry_t>> by_channel;
  for (const char* channel : {"LIO_ODOM", "LIO_ODOM_LOCAL"}) {
    bus_->Subscribe(channel, 100'000, [&of = by_channel[channel]](ByteView data, std::int64_t) {
      of.emplace_back().decode(data.data(), 0, static_cast<int>(data.size()));
    });
  }
  LiveRunner runner(*bus_, SceneOptions(), WithFiles());
  Play(runner);
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  const auto& world = by_channel["LIO_ODOM"];
  const auto& local = by_channel["LIO_ODOM_LOCAL"];
  ASSERT_GT(world.size(), 40u);
  ASSERT_EQ(world.size(), local.size());
  double apart_m = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(local[i].utime, world[i].utime);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(local[i].pos[k], world[i].map_pos[k]);
      apart_m = std::max(apart_m, std::abs(local[i].pos[k] - world[i].pos[k]));
    }
  }
  EXPECT_GT(apart_m, 0.0) << "two poses, not one twice";
}

TEST_F(LiveRunnerTest, StoppingInTheMiddleLeavesCompleteFilesSoon) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles(true));
  Play(runner, 700);
  const auto begin = std::chrono::steady_clock::now();
  runner.Stop();
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took, std::chrono::seconds(1));
  EXPECT_GT(NumLines("trajectory.tum"), 5);
  EXPECT_EQ(NumLines("covariance.csv"), NumLines("trajectory.tum") + 1);
  EXPECT_TRUE(std::filesystem::exists(out_ / "map.pcd"));
  // Scans are left unmatched only when their half second was over, on a busy machine.
  const bool had_time = took < std::chrono::milliseconds(400);
  EXPECT_LE(Stats()["num_shutdowns_cut_short"], had_time ? 0 : 1);
}

TEST_F(LiveRunnerTest, OverloadDropsWholeScansAndCountsThem) {
  LoadResult loaded = LoadOptions({kScene / "config.yaml"}, {"pipeline.max_queued_scans=1"});
  LiveRunner runner(*bus_, loaded.options, WithFiles());
  Play(runner, 500);  // past the start, where nothing is dropped
  bus_->Hold(true);
  EventLogReader reader(kScene / "log.lcm");
  LogEvent event;
  for (int i = 0; reader.Next(event); ++i) {
    if (i >= 500) bus_->Publish(event.channel, event.data);
  }
  has_delivered_all_ = false;
  bus_->Publish(kEndMark, Bytes{0});
  bus_->Hold(false);
  WaitUntil([this] { return has_delivered_all_.load(); }, "all messages are delivered");
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
