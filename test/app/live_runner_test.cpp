// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The daemon's threads over a bus in memory, on a log that lio-sim made for the tests.
#include "app/live_runner.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <future>
#include <map>

#include "app/end_run.hpp"
#include "app/live_fixture.hpp"
#include "lio/odometry_t.hpp"
#include "support/replay_log.hpp"

namespace lio {
namespace {

TEST_F(LiveRunnerTest, ScanRateFilesAreReplaysByteForByte) {
  const Options options = SceneOptions();
  const test::Replayed replayed =
      test::ReplayLog(kScene / "log.lcm", options, folder_.path() / "replay");
  LiveRunner runner(*bus_, options, WithFiles());
  Play(runner);
  // Stop gives what is left half a second, which may be too little on a busy machine.
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
  ExpectAccountCloses();
}

TEST_F(LiveRunnerTest, TheVerdictNamesALidarOfAnotherModel) {
  Options options = SceneOptions();
  options.rig.lidar.model = "hdl64e";
  LiveRunner runner(*bus_, options, WithFiles());
  Play(runner);
  runner.Stop();
  ASSERT_TRUE(runner.verdict());
  EXPECT_EQ(std::ranges::count(runner.verdict()->causes, CauseKind::kLidarModel, &Cause::kind), 1);
  EXPECT_NE(Live("verdict.json").find("lidar_model"), std::string::npos);
}

TEST_F(LiveRunnerTest, TheAccountClosesWithHostileBytesAmongTheMessages) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles());
  Play(runner, 500, [&](std::int32_t num_scans) {
    const auto size = static_cast<std::size_t>(num_scans % 90);
    for (const char* channel : {"LIO_IMU", "LIO_SCAN", "LIO_CMD"}) {
      EXPECT_TRUE(bus_->Publish(channel, Bytes(size, static_cast<std::uint8_t>(num_scans))));
    }
    return true;
  });
  runner.Stop();
  ExpectAccountCloses();
  EXPECT_GT(Stats()["account"]["imu"]["truncated"], 0);
  EXPECT_GT(Stats()["account"]["chunks"]["truncated"], 0);
}

// A newer cloud replaces one that still waits to be sent. So the log is held up while
// the last full cloud is too many scans old, and then enough of them must have been sent however
// slow the machine is.
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
  EXPECT_GT(num_messages[channels.odometry], 40);  // 60 are sent, the first ten to start with
  EXPECT_EQ(num_messages[channels.state], num_messages[channels.odometry]);
  EXPECT_GE(num_messages[channels.registration], num_messages[channels.odometry]);
  EXPECT_GT(num_messages[channels.odometry_imu_rate], 400);
  EXPECT_GE(num_messages[channels.status], 2);
  EXPECT_GE(num_messages[channels.cloud_full], 40 / kMaxCloudAge);
  EXPECT_GE(num_messages[channels.cloud], 4);  // due every fifth scan
}

// Both messages are of one instant: base's pose and motion are imu's, moved by hand.
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

TEST_F(LiveRunnerTest, StoppingInTheMiddleLeavesCompleteFiles) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles(true));
  Play(runner, 700);
  runner.Stop();
  EXPECT_FALSE(runner.is_cut_short());
  EXPECT_GT(NumLines("trajectory.tum"), 5);
  EXPECT_EQ(NumLines("covariance.csv"), NumLines("trajectory.tum") + 1);
  EXPECT_TRUE(std::filesystem::exists(out_ / "map.pcd"));
  EXPECT_EQ(Stats()["num_shutdowns_cut_short"], 0);
}

// Matching stands still where this clock is read while it is held.
struct HoldableClock {
  static std::int64_t Now() {
    while (is_held) {
      is_waited_for = true;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return 0;
  }
  inline static std::atomic<bool> is_held = false;
  inline static std::atomic<bool> is_waited_for = false;
};

TEST_F(LiveRunnerTest, StoppingGivesUpTheScansThatWaitWhenItsTimeIsOver) {
  EXPECT_LT(LiveOptions().max_finish, std::chrono::milliseconds(500));
  LiveOptions live = WithFiles(true);
  live.max_finish = std::chrono::milliseconds(0);
  live.match_clock = HoldableClock::Now;
  LiveRunner runner(*bus_, SceneOptions(), live);
  Play(runner, 500);
  HoldableClock::is_held = true;
  PublishRest(500);
  WaitUntil([] { return HoldableClock::is_waited_for.load(); }, "a match is under way");
  const std::int64_t num_matches = runner.num_matches_done();
  auto stopping = std::async(std::launch::async, [&] { runner.Stop(); });
  WaitUntil([&] { return runner.is_cut_short(); }, "the scans that wait are given up");
  HoldableClock::is_held = false;
  stopping.get();
  EXPECT_LE(runner.num_matches_done(), num_matches + 1) << "the match that was under way";
  EXPECT_GT(NumLines("trajectory.tum"), 5);
  EXPECT_EQ(NumLines("covariance.csv"), NumLines("trajectory.tum") + 1);
  EXPECT_TRUE(std::filesystem::exists(out_ / "map.pcd"));
  EXPECT_EQ(Stats()["num_shutdowns_cut_short"], 1);
  ExpectAccountCloses();
}

TEST_F(LiveRunnerTest, OverloadDropsWholeScansAndCountsThem) {
  LoadResult loaded = LoadOptions({kScene / "config.yaml"}, {"pipeline.max_queued_scans=1"});
  LiveRunner runner(*bus_, loaded.options, WithFiles());
  Play(runner, 500);  // past the start, where nothing is dropped
  bus_->Hold(true);
  PublishRest(500);
  bus_->Hold(false);
  WaitUntil([this] { return has_delivered_all_.load(); }, "all messages are delivered");
  runner.Stop();
  EXPECT_EQ(Stats()["num_imu_queue_dropped"], 0);
  EXPECT_EQ(Stats()["num_chunks_missing"], 0);
  EXPECT_GT(Stats()["num_scans_dropped"], 0);
  EXPECT_LT(Stats()["num_scans_dropped"], Stats()["num_scans"]);
  ExpectAccountCloses();
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
  EXPECT_TRUE(bus_->Publish(
      "LIO_CMD", EncodeCommand({.request_id = 1, .action = CommandAction::kCloudFullOn})));
  Play(runner);
  runner.Stop();
  while (bus_->Receive(std::chrono::milliseconds(0)) == ReceiveResult::kMessage) {
  }
  EXPECT_GT(num_full, 0);
}

TEST_F(LiveRunnerTest, AFullDiskIsSaidInTheStatusAndTheMessagesGoOn) {
  std::vector<std::string> notes;
  std::atomic<int> num_poses = 0;
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  bus_->Subscribe("LIO_ODOM", 1000, [&](ByteView, std::int64_t) { ++num_poses; });
  bus_->Subscribe("LIO_STATUS", 1000, [&](ByteView data, std::int64_t) {
    notes.emplace_back(data.begin(), data.end());
  });
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  {
    LiveRunner runner(*bus_, SceneOptions(), WithFiles());
    const rlimit small{.rlim_cur = 20'000, .rlim_max = limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    Play(runner);
    EXPECT_EQ(EndRun(runner, ""), kExitWriteFailed);
  }
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_GT(num_poses, 40);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& status) {
    return status.find("in full: File too large") != std::string::npos;
  }));
  EXPECT_GT(Stats()["num_scans"], 50);
  EXPECT_GT(Stats()["num_outputs_dropped"], 50);
  EXPECT_GT(NumLines("trajectory_imu_rate.tum"), 50);
}

}  // namespace
}  // namespace lio
