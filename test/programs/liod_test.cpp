// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the daemon as a process, on real multicast in a network namespace of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using test::SceneDir;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kBin = test::BinDir();
constexpr const char* kUp = "ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo; ";

// Runs a shell script in a network namespace of its own, without others' multicast; needs no root.
test::ProgramResult RunAlone(const std::string& script) {
  return test::RunProgram({"unshare", "-rn", "sh", "-c", kUp + script});
}

class LiodTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (RunAlone("true").exit_code != 0) {
      GTEST_SKIP() << "this machine lets nobody make network namespaces";
    }
  }
  std::string Out(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string File(const std::string& path) const { return test::ReadText(folder_.path() / path); }
  nlohmann::json Stats(const std::string& out) const {
    return nlohmann::json::parse(File(out + "/stats.json"));
  }
  // Starts liod and waits until it listens; its process id is in $liod.
  std::string Start(const std::string& arguments) const {
    // The output of an earlier daemon must not be taken for this one's.
    return "rm -f " + Out("said") + "; " + kBin + "/liod --config " + SceneDir() + "/config.yaml " +
           arguments + " 2>" + Out("said") + " & liod=$!; while ! grep -qs listening " +
           Out("said") + "; do sleep 0.05; done; ";
  }
  // Stops liod, returns its exit code, and writes the milliseconds that took into the file `ended`.
  std::string End() const {
    return "t0=$(date +%s%3N); kill -TERM $liod; wait $liod; rc=$?; echo $(($(date +%s%3N) - t0)) "
           ">" +
           Out("ended") + "; exit $rc";
  }

  // Plays a log to liod; liod's output goes into the file said, its LIO_STATUS into status.lcm.
  void PlayHearingStatus(const std::string& arguments, const std::string& log,
                         int exit_code = 0) const {
    const auto result = RunAlone(Start(arguments) + "lcm-logger -q -f -c LIO_STATUS " +
                                 Out("status.lcm") + " & logger=$!; sleep 0.2; lcm-logplayer " +
                                 log + "; sleep 1; kill $logger; wait $logger; " + End());
    EXPECT_EQ(result.exit_code, exit_code) << result.err << File("said");
  }

  test::TempDir folder_;
};

TEST_F(LiodTest, FedByLogPlayerItWritesReplaysFiles) {
  const auto live = RunAlone(Start("--out " + Out("live")) + "lcm-logplayer " + SceneDir() +
                             "/log.lcm; " + End());
  ASSERT_EQ(live.exit_code, 0) << live.err;
  EXPECT_LT(std::stoi(File("ended")), 1000);
  const auto replay =
      test::RunProgram({kBin + "/lio-replay", "--config", SceneDir() + "/config.yaml",
                        SceneDir() + "/log.lcm", "--out", Out("replay")});
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const auto stats = Stats("live");
  const int num_lost = stats["num_kernel_dropped"].get<int>() +
                       stats["num_chunks_missing"].get<int>() +
                       stats["num_imu_missing"].get<int>() + stats["num_scans_dropped"].get<int>();
  if (num_lost != 0 || stats["num_imu"] != Stats("replay")["num_imu"]) {
    GTEST_SKIP() << "this machine is too busy to play a log without loss: " << stats.dump();
  }
  for (const char* name : {"trajectory.tum", "trajectory_world.tum", "covariance.csv",
                           "covariance_world.csv", "options.yaml"}) {
    const std::string text = File("live/" + std::string(name));
    EXPECT_FALSE(text.empty());
    EXPECT_TRUE(text == File("replay/" + std::string(name))) << name;
  }
}

TEST_F(LiodTest, GarbageIsCountedAndSurvived) {
  const auto result = RunAlone(Start("--out " + Out("live")) + "lcm-logplayer " + SceneDir() +
                               "/log.lcm & player=$!; sleep 1; " + kBin +
                               "/lio_attack; wait $player; kill -0 $liod || exit 99; " + End());
  ASSERT_EQ(result.exit_code, 0) << result.err << File("said");
  EXPECT_LT(std::stoi(File("ended")), 1000);
  const auto stats = Stats("live");
  EXPECT_GT(stats["num_messages_truncated"], 0);
  EXPECT_GE(stats["num_messages_wrong_type"], 40);
  EXPECT_GE(stats["num_messages_size_mismatch"], 3);
  EXPECT_GE(stats["num_imu_nonfinite"].get<int>() + stats["num_imu_out_of_range"].get<int>(), 100);
  EXPECT_GT(stats["num_chunks_bad"], 0);
  EXPECT_EQ(stats["num_handler_faults"], 0);
  EXPECT_FALSE(File("live/trajectory.tum").empty());
}

TEST_F(LiodTest, UnitsThatItRecognisesAreInItsLogAndStatus) {
  const auto made =
      test::RunProgram({kBin + "/lio-sim", "--scenario", "street", "--lidar", "vlp16", "--duration",
                        "3", "--imu-variant", "in-g", "--out", Out("in-g")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  PlayHearingStatus("", Out("in-g") + "/log.lcm");
  EXPECT_THAT(File("said"), HasSubstr("inertial messages: accelerometer in g, gyro in rad/s"));
  EXPECT_THAT(File("status.lcm"), HasSubstr("started at rest"));
  EXPECT_THAT(File("status.lcm"), HasSubstr("accelerometer in g, gyro in rad/s"));
}

TEST_F(LiodTest, WhatTheConfigurationSaysWronglyOfTheImuIsRefusedWithTheFix) {
  const std::pair<std::string, std::string> cases[] = {
      {"rig.imu.units=g", "set rig.imu.units: auto or si"},
      {"rig.imu.gravity=removed", "set rig.imu.gravity: auto or present"}};
  for (const auto& [statement, fix] : cases) {
    constexpr int kExitNoTrust = 6;
    PlayHearingStatus("--out " + Out("live") + " --overwrite --set " + statement,
                      SceneDir() + "/log.lcm", kExitNoTrust);
    EXPECT_THAT(File("said"), HasSubstr(fix));
    EXPECT_THAT(File("status.lcm"), HasSubstr(fix));
    EXPECT_EQ(File("live/trajectory.tum"), "") << statement;
  }
}

TEST_F(LiodTest, SignalsEndItAtOnceWithoutInput) {
  for (const char* signal : {"TERM", "INT"}) {
    const auto result =
        RunAlone(Start("--out " + Out(signal)) + "kill -" + signal + " $liod; wait $liod");
    EXPECT_EQ(result.exit_code, 0) << signal;
    EXPECT_EQ(Stats(signal)["num_scans"], 0);
  }
}

TEST_F(LiodTest, ARestartKeepsTheFilesOfTheRunBefore) {
  const auto run = [this](const std::string& more) {
    return RunAlone(Start("--out " + Out("live") + more) + "kill $liod; wait $liod").exit_code;
  };
  ASSERT_EQ(run(""), 0);
  const std::string before = File("live/stats.json");
  ASSERT_EQ(run(""), 0);
  EXPECT_THAT(File("said"), HasSubstr("the files of this one go to " + Out("live-2")));
  EXPECT_EQ(File("live/stats.json"), before);
  EXPECT_EQ(Stats("live-2")["num_scans"], 0);
  ASSERT_EQ(run(" --overwrite"), 0);
  EXPECT_NE(File("live/stats.json"), before);
  EXPECT_FALSE(std::filesystem::exists(Out("live-3")));
}

TEST_F(LiodTest, CommandsAreAnsweredOverLcm) {
  const std::string ask = kBin + "/lio_ask ";
  const auto result = RunAlone(Start("--out " + Out("live")) + "lcm-logplayer " + SceneDir() +
                               "/log.lcm & player=$!; sleep 2; " + ask + "6 1; " + ask + "2 2; " +
                               ask + "77 3; " + ask + "4 4 map.pcd; wait $player; " + End());
  EXPECT_EQ(result.exit_code, 0) << result.err << File("said");
  EXPECT_THAT(result.out, HasSubstr("1 done LIO_STATUS comes now"));
  EXPECT_THAT(result.out, HasSubstr("2 done the estimate begins anew, in a new map"));
  EXPECT_THAT(result.out, HasSubstr("3 refused no action is 77"));
  EXPECT_THAT(result.out, HasSubstr("4 refused the map is kept only with --out and --map"));
  EXPECT_FALSE(File("live/verdict.json").empty());
  EXPECT_FALSE(File("live-2/trajectory.tum").empty()) << "it has started again";
}

TEST_F(LiodTest, SighupCompletesTheFilesAndGoesOnInTheNextFolder) {
  const auto wait = [this](const std::string& words) {
    return "while ! grep -q '" + words + "' " + Out("said") + "; do sleep 0.05; done; ";
  };
  const auto result =
      RunAlone(Start("--out " + Out("live")) + "lcm-logplayer " + SceneDir() +
               "/log.lcm & player=$!; sleep 3; kill -HUP $liod; " + wait("files go on in") +
               "test -s " + Out("live/verdict.json") +
               " || exit 98; wait $player; kill -HUP $liod; " + wait("live-3") + End());
  EXPECT_EQ(result.exit_code, 0) << result.err << File("said");
  EXPECT_FALSE(File("live/trajectory.tum").empty());
  EXPECT_FALSE(File("live-2/trajectory.tum").empty());
  EXPECT_EQ(Stats("live-3")["num_imu"], 0);
  const int num_imu = Stats("live")["num_imu"].get<int>() + Stats("live-2")["num_imu"].get<int>();
  EXPECT_GT(num_imu, 0);
}

// A socket stands in place of systemd's. The daemon is told that the watchdog wants a word each
// second.
TEST_F(LiodTest, SystemdHearsOfStartLifeAndEnd) {
  const std::string heard = Out("heard");
  const std::string listen =
      "python3 -c \"import socket,sys\n"
      "s=socket.socket(socket.AF_UNIX,socket.SOCK_DGRAM); s.bind('" +
      Out("notify") + "')\nopen('" + heard +
      "','w').close()\n"
      "while True:\n"
      "  d=s.recv(999).decode(); open('" +
      heard + "','a').write(d+'\\n')\n\" & listener=$!; while [ ! -e " + heard +
      " ]; do sleep 0.05; done; export NOTIFY_SOCKET=" + Out("notify") + " WATCHDOG_USEC=1000000; ";
  const auto result = RunAlone(listen + Start("") + "while [ $(grep -c WATCHDOG " + heard +
                               ") -lt 3 ]; do sleep 0.05; done; kill -TERM $liod; wait $liod; "
                               "rc=$?; while ! grep -q STOPPING " +
                               heard + "; do sleep 0.05; done; kill $listener; exit $rc");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(File("heard").find("READY=1\nSTATUS=listening on LIO_IMU and LIO_SCAN"), 0u);
}

TEST_F(LiodTest, SighupWithoutFilesChangesNothing) {
  const auto result = RunAlone(Start("") + "kill -HUP $liod; while ! grep -q 'signal: refused' " +
                               Out("said") + "; do sleep 0.05; done; " + End());
  EXPECT_EQ(result.exit_code, 0) << result.err << File("said");
}

TEST_F(LiodTest, ChannelsFollowThePrefix) {
  const auto result = RunAlone(Start("--channel-prefix CAR_") + End());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(File("said"), HasSubstr("CAR_IMU and CAR_SCAN"));
}

TEST_F(LiodTest, WithoutAMulticastRouteItSaysWhatToTypeAndEndsWithFour) {
  const auto result =
      test::RunProgram({"unshare", "-rn", kBin + "/liod", "--config", SceneDir() + "/config.yaml"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("sudo ip route add 224.0.0.0/4 dev lo"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(LiodTest, WrongArgumentsAndConfigurationsHaveTheirExitCodes) {
  EXPECT_EQ(test::RunProgram({kBin + "/liod", "--no-such-option"}).exit_code, 2);
  const auto missing = test::RunProgram({kBin + "/liod", "--config", Out("missing.yaml")});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.yaml"));
  const auto unknown = test::RunProgram(
      {kBin + "/liod", "--config", SceneDir() + "/config.yaml", "--set", "ndt.voxel=1"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("voxel_m"));
  EXPECT_EQ(test::RunProgram({kBin + "/liod", "--version"}).exit_code, 0);
}

// Plays half a log after the silence. LIO_STATUS tells, too, as long as it lasts.
TEST_F(LiodTest, SilenceIsSaidOnceAndAgainAfterItHadPassed) {
  const auto wait_for = [this](const std::string& words, int count) {
    return "i=0; while [ $(grep -c '" + words + "' " + Out("said") + ") -lt " +
           std::to_string(count) + " ] && [ $i -lt 600 ]; do sleep 0.1; i=$((i+1)); done; ";
  };
  const auto result =
      RunAlone(Start("") + "lcm-logger -q -f -c LIO_STATUS " + Out("status.lcm") +
               " & logger=$!; sleep 0.2; " + wait_for("liod: nothing comes on", 1) +
               "sleep 1.5; lcm-logplayer " + SceneDir() + "/log.lcm; " +
               wait_for("liod: nothing comes on", 2) + "kill $logger; wait $logger; " + End());
  EXPECT_EQ(result.exit_code, 0) << result.err << File("said");
  const std::string said = File("said");
  const auto count = [&](const std::string& words) {
    int num = 0;
    for (std::size_t at = said.find(words); at != std::string::npos; at = said.find(words, at + 1))
      ++num;
    return num;
  };
  EXPECT_EQ(count("liod: nothing comes on LIO_IMU and LIO_SCAN"), 2) << said;
  EXPECT_EQ(count("liod: no longer so: nothing comes"), 1) << said;
  EXPECT_THAT(said, HasSubstr("ip route get 239.255.76.67"));
  EXPECT_THAT(File("status.lcm"), HasSubstr("nothing comes on LIO_IMU and LIO_SCAN"));
}

// Whatever a busy machine loses: all that liod knows of has a fate.
TEST_F(LiodTest, TheAccountOfARecordingCloses) {
  const auto result = RunAlone("lcm-logger -q -f " + Out("all.lcm") + " & logger=$!; sleep 0.3; " +
                               Start("") + "lcm-logplayer " + SceneDir() +
                               "/log.lcm; kill -TERM $liod; wait $liod; rc=$?; sleep 0.5; "
                               "kill $logger; wait $logger; exit $rc");
  ASSERT_EQ(result.exit_code, 0) << result.err << File("said");
  const auto info = test::RunProgram({kBin + "/lio-log", "info", Out("all.lcm")});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("The last status of liod says"));
  EXPECT_THAT(info.out, Not(HasSubstr("fate"))) << info.out;
}

TEST_F(LiodTest, ASensorThatIsMissingIsSaid) {
  // The channel filter of lcm-logplayer is an expression of what is played.
  const auto result =
      RunAlone(Start("") + "lcm-logplayer -e LIO_SCAN " + SceneDir() +
               "/log.lcm; i=0; while ! grep -q 'no inertial samples' " + Out("said") +
               " && [ $i -lt 100 ]; do sleep 0.1; i=$((i+1)); done; " + End());
  EXPECT_EQ(result.exit_code, 0) << result.err << File("said");
  EXPECT_THAT(File("said"), HasSubstr("scans come, but no inertial samples on LIO_IMU"));
}

// A network namespace whose loopback is down: a start would end with 4 there.
TEST_F(LiodTest, CheckValidatesAllAndOpensNoNetwork) {
  const auto check = [this](const std::string& more) {
    return test::RunProgram(
        {"unshare", "-rn", "sh", "-c",
         kBin + "/liod --check --config " + SceneDir() + "/config.yaml " + more});
  };
  const auto good = check("--out " + Out("live"));
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("LIO_IMU, LIO_SCAN and LIO_CMD"));
  EXPECT_THAT(good.out, HasSubstr(SceneDir() + "/config.yaml"));
  EXPECT_FALSE(std::filesystem::exists(Out("live")));
  const auto bad = check("--set ndt.voxel=1 --set rig.imu.gyro=2 --lcm-url nonsense");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_EQ(bad.out, "");
  for (const char* fault : {"ndt.voxel", "rig.imu.gyro", "nonsense"}) {
    EXPECT_THAT(bad.err, HasSubstr(fault));
  }
  EXPECT_EQ(check("--initial-map " + Out("no.pcd")).exit_code, 5);
  EXPECT_EQ(check("--no-such-option").exit_code, 2);
  EXPECT_EQ(check("--lcm-url nonsense").exit_code, 4);
}

TEST_F(LiodTest, AFolderThatCannotBeMadeIsAUsageError) {
  const auto file = folder_.Write("file", "");
  const auto result = RunAlone(kBin + "/liod --config " + SceneDir() + "/config.yaml --out " +
                               file.string() + "/out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr(file.string()));
}

TEST_F(LiodTest, ASecondDaemonOnTheSameChannelsIsNoticedByBoth) {
  const std::string second =
      kBin + "/liod --config " + SceneDir() + "/config.yaml 2>" + Out("second") + " & second=$!; ";
  const auto result =
      RunAlone(Start("") + second + "sleep 5; kill $second; wait $second; sleep 8; " + End());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string line = "another liod publishes on LIO_STATUS";
  EXPECT_THAT(File("second"), HasSubstr(line));
  const std::string said = File("said");
  ASSERT_THAT(said, HasSubstr(line));
  EXPECT_THAT(said, HasSubstr("no longer so: " + line));
}

}  // namespace
}  // namespace lio
