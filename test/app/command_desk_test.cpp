// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Commands over the bus of the running daemon: what each does, and how it is answered.
#include "app/command_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <optional>

#include "lio/io/output_decoder.hpp"
#include "lio/reply_t.hpp"
#include "live_fixture.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

class CommandDeskTest : public LiveRunnerTest {
 protected:
  CommandDeskTest() {
    bus_->Subscribe("LIO_REPLY", 100, [this](ByteView data, std::int64_t) {
      reply_t reply;
      ASSERT_GT(reply.decode(data.data(), 0, static_cast<int>(data.size())), 0);
      const std::lock_guard lock(mutex_);
      EXPECT_FALSE(replies_.contains(reply.request_id)) << "it is answered once";
      replies_[reply.request_id] = reply;
    });
  }

  void Send(const Command& command) {
    EXPECT_TRUE(bus_->Publish("LIO_CMD", EncodeCommand(command)));
  }
  reply_t Ask(CommandAction action, const std::string& name = "") {
    Command command;
    command.request_id = ++last_id_;
    command.action = action;
    command.name = name;
    Send(command);
    return ReplyTo(last_id_);
  }
  reply_t ReplyTo(std::int64_t id) {
    const auto find = [&] {
      const std::lock_guard lock(mutex_);
      return replies_.contains(id);
    };
    WaitUntil(find, "the reply comes");
    const std::lock_guard lock(mutex_);
    return replies_[id];
  }
  // Plays as Play does, from an event in the middle of the log on.
  void PlayFrom(const LiveRunner& runner, int first) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    std::optional<std::int64_t> ahead;
    const std::int64_t num_done = runner.num_matches_done();
    for (int i = 0; reader.Next(event); ++i) {
      if (i < first) continue;
      ScanChunk chunk;
      if (event.channel == "LIO_SCAN" && DecodeChunk(event.data, chunk) == DecodeStatus::kOk) {
        if (!ahead) ahead = kMaxAhead + chunk.scan_seq - num_done;
        WaitUntil([&] { return runner.num_matches_done() + *ahead >= chunk.scan_seq; },
                  "scans are matched");
      }
      if (HasFatalFailure()) return;
      EXPECT_TRUE(bus_->Publish(event.channel, event.data));
    }
    has_delivered_all_ = false;
    EXPECT_TRUE(bus_->Publish(kEndMark, Bytes{0}));
    WaitUntil([this] { return has_delivered_all_.load(); }, "all messages are delivered");
  }
  static bool IsDone(const reply_t& reply) { return reply.result == reply_t::DONE; }
  std::string In(const std::string& folder, const std::string& name) const {
    return test::ReadText(folder_.path() / folder / name);
  }

  std::int64_t last_id_ = 1000;
  std::mutex mutex_;  // guards replies_
  std::map<std::int64_t, reply_t> replies_;
};

TEST_F(CommandDeskTest, EveryCommandIsAnsweredWithItsIdAndWhatCannotBeIsRefused) {
  LiveRunner runner(*bus_, SceneOptions(), LiveOptions());
  for (const auto action : {CommandAction::kCloudFullOn, CommandAction::kCloudFullOff,
                            CommandAction::kReset, CommandAction::kStatusNow}) {
    const reply_t reply = Ask(action);
    EXPECT_TRUE(IsDone(reply)) << reply.text;
    EXPECT_EQ(reply.action, static_cast<int>(action));
    EXPECT_GT(reply.utime, 0);
  }
  EXPECT_THAT(Ask(CommandAction::kNewFiles).text, HasSubstr("--out"));
  EXPECT_THAT(Ask(CommandAction::kSaveMap, "map.pcd").text, HasSubstr("--map"));
  EXPECT_THAT(Ask(static_cast<CommandAction>(33)).text, HasSubstr("no action is 33"));
  Command nowhere;
  nowhere.request_id = 5;
  nowhere.action = CommandAction::kResetAtPose;
  nowhere.T_world_imu.rotation.coeffs().setZero();
  Send(nowhere);
  const reply_t refused = ReplyTo(5);
  EXPECT_FALSE(IsDone(refused));
  EXPECT_THAT(refused.text, HasSubstr("quat"));
  runner.Stop();
}

TEST_F(CommandDeskTest, TheStatusThatIsAskedForHasTheOptions) {
  std::atomic<int> num_with_options = 0;
  const std::string options = PrintOptions(SceneOptions());
  bus_->Subscribe("LIO_STATUS", 1000, [&](ByteView data, std::int64_t) {
    StatusReport report;
    EXPECT_EQ(DecodeStatusReport(data, report), DecodeStatus::kOk);
    if (report.options == options) ++num_with_options;
  });
  LiveRunner runner(*bus_, SceneOptions(), LiveOptions());
  WaitUntil([&] { return num_with_options == 1; }, "the first status comes");
  EXPECT_TRUE(IsDone(Ask(CommandAction::kStatusNow)));
  WaitUntil([&] { return num_with_options == 2; }, "the status that was asked for comes");
  runner.Stop();
}

// A reset between two events is that of a daemon that starts there.
TEST_F(CommandDeskTest, AfterAResetTheFilesAreThoseOfADaemonStartedThen) {
  constexpr int kFirst = 60;
  {
    LiveRunner runner(*bus_, SceneOptions(), WithFiles());
    Play(runner, kFirst);
    EXPECT_TRUE(IsDone(Ask(CommandAction::kReset)));
    PlayFrom(runner, kFirst);
    runner.Stop();
  }
  {
    RenewBus();
    LiveOptions fresh = WithFiles();
    fresh.out = folder_.path() / "fresh";
    LiveRunner runner(*bus_, SceneOptions(), fresh);
    PlayFrom(runner, kFirst);
    runner.Stop();
  }
  for (const char* name : {"trajectory.tum", "covariance.csv"}) {
    EXPECT_GT(In("live-2", name).size(), 1000u) << name;
    EXPECT_EQ(In("live-2", name), In("fresh", name));
  }
  EXPECT_FALSE(Live("verdict.json").empty());
  EXPECT_THAT(In("live-2", "notices.tsv"), HasSubstr("the estimate begins anew, in a new map"));
}

TEST_F(CommandDeskTest, AResetAtAPosePlacesTheWorld) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles());
  Command command;
  command.request_id = 8;
  command.action = CommandAction::kResetAtPose;
  command.T_world_imu.translation = {1000.0, 2000.0, 30.0};
  command.pose_cov = Matrix6::Identity() * 0.04;
  Send(command);
  EXPECT_TRUE(IsDone(ReplyTo(8)));
  Play(runner);
  runner.Stop();
  double t_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  std::istringstream(In("live-2", "trajectory_world.tum")) >> t_s >> x_m >> y_m >> z_m;
  EXPECT_NEAR(x_m, 1000.0, 1.0);
  EXPECT_NEAR(y_m, 2000.0, 1.0);
  EXPECT_NEAR(z_m, 30.0, 1.0);
}

// All rows of the drive are in one of the folders, none twice.
TEST_F(CommandDeskTest, NewFilesGoOnWithTheNextRow) {
  {
    LiveRunner runner(*bus_, SceneOptions(), WithFiles());
    Play(runner, 500);
    const reply_t reply = Ask(CommandAction::kNewFiles);
    EXPECT_TRUE(IsDone(reply));
    EXPECT_THAT(reply.text, HasSubstr("live-2"));
    EXPECT_FALSE(Live("verdict.json").empty()) << "the old run is complete";
    PlayFrom(runner, 500);
    runner.RenewFiles();  // as SIGHUP does
    WaitUntil([this] { return std::filesystem::exists(folder_.path() / "live-3/options.yaml"); },
              "the files go on");
    runner.Stop();
  }
  RenewBus();
  LiveOptions whole = WithFiles();
  whole.out = folder_.path() / "whole";
  LiveRunner runner(*bus_, SceneOptions(), whole);
  PlayFrom(runner, 0);
  runner.Stop();
  EXPECT_GT(Live("trajectory.tum").size(), 500u);
  EXPECT_GT(In("live-2", "trajectory.tum").size(), 500u);
  EXPECT_EQ(
      Live("trajectory.tum") + In("live-2", "trajectory.tum") + In("live-3", "trajectory.tum"),
      In("whole", "trajectory.tum"));
}

TEST_F(CommandDeskTest, TheMapIsNotSavedOverAnInput) {
  LiveOptions live = WithFiles(true);
  live.inputs = {out_ / "start.pcd"};
  LiveRunner runner(*bus_, SceneOptions(), live);
  Play(runner, 1200);
  folder_.Write("live/start.pcd", "mine");
  const reply_t reply = Ask(CommandAction::kSaveMap, "start.pcd");
  EXPECT_FALSE(IsDone(reply));
  EXPECT_THAT(reply.text, HasSubstr("is input"));
  EXPECT_EQ(test::ReadText(out_ / "start.pcd"), "mine");
  EXPECT_TRUE(IsDone(Ask(CommandAction::kSaveMap, "other.pcd")));
  runner.Stop();
}

TEST_F(CommandDeskTest, TheMapIsSavedUnderItsNameAndNowhereElse) {
  LiveRunner runner(*bus_, SceneOptions(), WithFiles(true));
  Play(runner, 1200);
  const reply_t reply = Ask(CommandAction::kSaveMap, "now.ply");
  EXPECT_TRUE(IsDone(reply)) << reply.text;
  EXPECT_THAT(reply.text, HasSubstr((out_ / "now.ply").string()));
  EXPECT_THAT(Live("now.ply"), HasSubstr("end_header"));
  EXPECT_FALSE(IsDone(Ask(CommandAction::kSaveMap, "../now.ply")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "now.ply"));
  const auto kept = folder_.Write("kept", "mine");
  std::filesystem::create_symlink(kept, out_ / "link.pcd");
  EXPECT_TRUE(IsDone(Ask(CommandAction::kSaveMap, "link.pcd")));
  EXPECT_EQ(test::ReadText(kept), "mine") << "a link is replaced, not followed";
  runner.Stop();
  EXPECT_FALSE(Live("map.pcd").empty());
}

}  // namespace
}  // namespace lio
