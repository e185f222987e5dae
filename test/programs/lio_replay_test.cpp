// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs lio-replay as its users do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lio/io/event_log.hpp"
#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using test::SceneDir;
using ::testing::HasSubstr;

const std::string kLog = SceneDir() + "/log.lcm";

class LioReplayTest : public ::testing::Test {
 protected:
  test::ProgramResult Replay(const std::string& log, const std::string& out,
                             const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {test::Program("lio-replay"),
                                        "--config",
                                        SceneDir() + "/config.yaml",
                                        log,
                                        "--out",
                                        Path(out)};
    command.insert(command.end(), more.begin(), more.end());
    return test::RunProgram(command);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string File(const std::string& name) const { return test::ReadText(Path(name)); }
  nlohmann::json Stats(const std::string& out) const {
    return nlohmann::json::parse(File(out + "/stats.json"));
  }
  // Returns the rows of registration.csv without the computing times at their ends.
  std::string RegistrationWithoutTimes(const std::string& out) const {
    std::istringstream text(File(out + "/registration.csv"));
    std::string kept;
    for (std::string line; std::getline(text, line);) {
      std::size_t end = line.size();
      for (int i = 0; i < 7; ++i) end = line.rfind(',', end - 1);
      kept += line.substr(0, end) + "\n";
    }
    return kept;
  }

  test::TempDir folder_;
};

TEST_F(LioReplayTest, TheMapIsAPlyFileWhenAskedFor) {
  ASSERT_EQ(Replay(kLog, "a", {"--map", "--map-format", "ply"}).exit_code, 0);
  EXPECT_TRUE(File("a/map.ply").starts_with("ply\n"));
  EXPECT_GT(File("a/map.ply").size(), 10'000u);
  EXPECT_FALSE(std::filesystem::exists(Path("a/map.pcd")));
  // Without --map there is no map to choose a format for.
  EXPECT_EQ(Replay(kLog, "b", {"--map-format", "ply"}).exit_code, 2);
}

TEST_F(LioReplayTest, TwiceAndOnMoreThreadsItWritesTheSameBytes) {
  ASSERT_EQ(Replay(kLog, "a", {"--map"}).exit_code, 0);
  ASSERT_EQ(Replay(kLog, "b", {"--map"}).exit_code, 0);
  ASSERT_EQ(Replay(kLog, "c", {"--map", "--threads", "2"}).exit_code, 0);
  ASSERT_EQ(Replay(kLog, "d", {"--map", "--set", "pipeline.num_threads=3"}).exit_code, 0);
  for (const std::string other : {"b", "c", "d"}) {
    for (const std::string name :
         {"trajectory.tum", "trajectory_imu_rate.tum", "trajectory_world.tum", "covariance.csv",
          "covariance_world.csv", "options.yaml", "map.pcd"}) {
      EXPECT_TRUE(File("a/" + name) == File(other + "/" + name)) << other << " " << name;
      EXPECT_FALSE(File("a/" + name).empty()) << name;
    }
    EXPECT_TRUE(RegistrationWithoutTimes("a") == RegistrationWithoutTimes(other));
  }
}

TEST_F(LioReplayTest, AnEarlierRunIsKeptUnlessItMayBeOverwritten) {
  ASSERT_EQ(Replay(kLog, "out", {"--duration", "3"}).exit_code, 0);
  const std::string before = File("out/stats.json");
  const auto refused = Replay(kLog, "out");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("holds an earlier run; name another folder or add --overwrite"));
  EXPECT_EQ(File("out/stats.json"), before);
  EXPECT_EQ(Replay(kLog, "out", {"--overwrite"}).exit_code, 0);
  EXPECT_NE(File("out/stats.json"), before);
}

TEST_F(LioReplayTest, StatsHaveTheKeysThatArePromised) {
  ASSERT_EQ(Replay(kLog, "a").exit_code, 0);
  const auto stats = Stats("a");
  EXPECT_EQ(stats["num_scans"], 59);  // the rotor is a little slow
  EXPECT_EQ(stats["num_scans_dropped"], 0);
  EXPECT_EQ(stats["num_imu"], 601);
  EXPECT_NEAR(stats["log_duration_s"], 6.0, 0.05);
  EXPECT_GT(stats["wall_s"], 0.0);
  EXPECT_GT(stats["realtime_factor"], 0.1);
  EXPECT_GT(stats["rss_peak_mb"], 1.0);
  for (const char* stage : {"decode", "reduce", "deskew", "match", "insert", "filter", "total"}) {
    // Not every scan is inserted into the map.
    const bool is_rare = std::string(stage) == "insert";
    EXPECT_GE(stats["stage_ms"][stage]["median"], is_rare ? 0.0 : 1e-6) << stage;
    EXPECT_GT(stats["stage_ms"][stage]["p99"], 0.0) << stage;
    EXPECT_GT(stats["stage_ms"][stage]["max"], 0.0) << stage;
  }
}

TEST_F(LioReplayTest, DamageIsSkippedCountedAndToldWithExitCodeFive) {
  std::string bytes = test::ReadText(kLog);
  const std::size_t sync_at = bytes.find("\xED\xA1\xDA\x01", bytes.size() / 2);
  ASSERT_NE(sync_at, std::string::npos);
  const std::size_t next_at = bytes.find("\xED\xA1\xDA\x01", sync_at + 4);
  bytes[sync_at + 24] = '\x7f';  // a length of two gigabytes
  const auto damaged = folder_.Write("damaged.lcm", bytes);
  const auto result = Replay(damaged.string(), "out");
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.err, HasSubstr("skipped " + std::to_string(next_at - sync_at) + " damaged"));
  EXPECT_EQ(Stats("out")["num_skipped_bytes"], next_at - sync_at);
  EXPECT_FALSE(File("out/trajectory.tum").empty());
}

TEST_F(LioReplayTest, ACutLogIsReplayedToItsEnd) {
  const std::string bytes = test::ReadText(kLog);
  const auto cut = folder_.Write("cut.lcm", bytes.substr(0, bytes.size() * 2 / 3));
  EXPECT_EQ(Replay(cut.string(), "out").exit_code, 5);
  EXPECT_NEAR(Stats("out")["num_scans"], 40, 2);
}

TEST_F(LioReplayTest, AMessageThatDoesNotDecodeIsDamageToo) {
  const auto log = folder_.path() / "log.lcm";
  std::filesystem::copy(kLog, log);
  {
    EventLogWriter bad(folder_.path() / "bad.lcm");
    bad.Write(1, "LIO_IMU", std::vector<std::uint8_t>(20));
  }
  folder_.Write("joined.lcm", test::ReadText(log) + File("bad.lcm"));
  const auto result = Replay(Path("joined.lcm"), "out");
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.err, HasSubstr("refused 1 undecodable message"));
}

TEST_F(LioReplayTest, LogsWithoutScansAndMissingLogsAreUnusable) {
  { EventLogWriter writer(folder_.path() / "empty.lcm"); }
  const auto empty = Replay(Path("empty.lcm"), "out");
  EXPECT_EQ(empty.exit_code, 5);
  EXPECT_THAT(empty.err, HasSubstr("no scans on LIO_SCAN"));
  const auto missing = Replay(Path("missing.lcm"), "out");
  EXPECT_EQ(missing.exit_code, 5);
  EXPECT_THAT(missing.err, HasSubstr("missing.lcm"));
  EXPECT_EQ(Replay(folder_.path().string(), "out").exit_code, 5);
}

TEST_F(LioReplayTest, StartAndDurationCutTheLog) {
  // A second and a half is too short for a start: there is no pose, and nothing to trust.
  ASSERT_EQ(Replay(kLog, "out", {"--start", "2", "--duration", "1.5"}).exit_code, 6);
  EXPECT_NEAR(Stats("out")["num_imu"], 150, 3);
  EXPECT_NEAR(Stats("out")["num_scans"], 15, 2);
}

TEST_F(LioReplayTest, LidarOnlyGivesATrajectoryToo) {
  ASSERT_EQ(Replay(kLog, "out", {"--set", "pipeline.use_imu=false"}).exit_code, 0);
  const std::string trajectory = File("out/trajectory.tum");
  EXPECT_GT(std::count(trajectory.begin(), trajectory.end(), '\n'), 50);
}

TEST_F(LioReplayTest, WrongArgumentsAreUsageErrorsInOneLine) {
  const std::string program = test::Program("lio-replay");
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {}, {"log.lcm"}, {"--threads", "0", "log.lcm", "--out", "x"}, {"--nonsense"}}) {
    std::vector<std::string> command = {program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto result = test::RunProgram(command);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  const auto file = folder_.Write("file", "");
  EXPECT_EQ(Replay(kLog, "file/out").exit_code, 2);
}

TEST_F(LioReplayTest, HelpTeachesAndVersionTells) {
  const std::string program = test::Program("lio-replay");
  const auto help = test::RunProgram({program, "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("Examples:"));
  EXPECT_EQ(test::RunProgram({program, "--version"}).exit_code, 0);
}

}  // namespace
}  // namespace lio
