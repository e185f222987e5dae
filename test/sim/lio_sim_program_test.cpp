// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the program's contract: its output, its files and its exit codes.
#include <gtest/gtest.h>

#include "lio/sim/scenario.hpp"
#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio::sim {
namespace {

test::ProgramResult Simulate(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), test::Program("lio-sim"));
  return test::RunProgram(arguments);
}

TEST(LioSim, ListsTheScenariosOneALine) {
  const auto result = Simulate({"--list"});
  std::string expected;
  for (const ScenarioEntry& entry : AllScenarios()) expected += entry.name + "\n";
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, expected);
}

TEST(LioSim, HelpTeachesScenariosFaultsAndExamples) {
  const auto result = Simulate({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* word : {"street", "imu_gap", "wrong_extrinsic", "lio-replay", "--imu-variant"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(Simulate({"--version"}).exit_code, 0);
}

TEST(LioSim, WritesTheFourFilesAndNoProgressIntoAPipe) {
  const test::TempDir dir;
  const std::string out = (dir.path() / "made" / "here").string();
  const auto result = Simulate({"--scenario", "hall", "--duration", "0.5", "--lidar", "vlp16",
                                "--imu", "consumer_mems", "--imu-rate", "400", "--seed", "3",
                                "--fault", "nan:ratio=0.1", "--out", out});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* file : {"log.lcm", "truth.tum", "truth_states.csv", "config.yaml"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(dir.path() / "made" / "here" / file)) << file;
  }
}

TEST(LioSim, ALinkAmongItsFilesIsReplacedAndNotWrittenThrough) {
  const test::TempDir dir;
  const std::filesystem::path precious = dir.Write("precious", "precious");
  const std::filesystem::path out = dir.path() / "out";
  std::filesystem::create_directory(out);
  const std::vector<std::string> names = {"log.lcm", "truth.tum", "truth_states.csv",
                                          "config.yaml"};
  for (const std::string& name : names) std::filesystem::create_symlink(precious, out / name);
  const auto result = Simulate(
      {"--scenario", "hall", "--duration", "0.3", "--lidar", "vlp16", "--out", out.string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(test::ReadText(precious), "precious");
  for (const std::string& name : names) {
    EXPECT_FALSE(std::filesystem::is_symlink(out / name)) << name;
    EXPECT_GT(std::filesystem::file_size(out / name), 100u) << name;
  }
}

// A log of 15 s has 90 MB.
TEST(LioSim, ItsMemoryDoesNotGrowWithTheDuration) {
  const test::TempDir dir;
  const auto peak_kb = [&](const std::string& duration) {
    return test::PeakMemoryKb({test::Program("lio-sim"), "--scenario", "hall", "--lidar", "vlp16",
                               "--duration", duration, "--out", dir.path().string()});
  };
  const std::int64_t of_short_kb = peak_kb("4");
  ASSERT_GT(of_short_kb, 0);
  EXPECT_LT(peak_kb("19"), of_short_kb + 20'000);
  EXPECT_GT(std::filesystem::file_size(dir.path() / "log.lcm"), 60'000'000u);
}

TEST(LioSim, EndsWithTheRightCodeAndOneLineThatHelps) {
  const test::TempDir dir;
  const std::string file = dir.Write("file", "").string();
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    std::string word;
  };
  for (const Case& c : std::vector<Case>{
           {{}, 2, "--scenario"},
           {{"--scenario", "hall"}, 2, "--out"},
           {{"--scenario", "stret", "--out", file}, 2, "street"},
           {{"--scenario", "hall", "--duration", "-3", "--out", file}, 2, "duration"},
           {{"--scenario", "hall", "--threads", "0", "--out", file}, 2, "threads"},
           {{"--scenario", "hall", "--imu-rate", "5000", "--out", file}, 2, "imu-rate"},
           {{"--scenario", "hall", "--fault", "hole", "--out", file}, 2, "imu_gap"},
           {{"--scenario", "hall", "--lidar", "hdl33", "--out", file}, 3, "hdl32e"},
           {{"--scenario", "hall", "--imu", "best", "--out", file}, 3, "xsens_mti10"},
           {{"--scenario", "hall", "--duration", "1", "--out", file}, 2, "file"}}) {
    const auto result = Simulate(c.arguments);
    EXPECT_EQ(result.exit_code, c.exit_code) << result.err;
    EXPECT_NE(result.err.find(c.word), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace lio::sim
