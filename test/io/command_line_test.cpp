// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::internal::CaptureStderr;
using ::testing::internal::CaptureStdout;
using ::testing::internal::GetCapturedStderr;
using ::testing::internal::GetCapturedStdout;

// Makes a program with one required positional argument, as lio-replay has.
struct Program {
  explicit Program(std::vector<const char*> arguments) {
    CLI::App app("Test program", "lio-test");
    app.add_option("INPUT", input)->required();
    AddOptionsArguments(app, options_arguments);
    arguments.insert(arguments.begin(), "lio-test");
    CaptureStdout();
    CaptureStderr();
    exit_code = ParseCommandLine(app, static_cast<int>(arguments.size()), arguments.data(), "1.2.3",
                                 options_arguments, options);
    out = GetCapturedStdout();
    err = GetCapturedStderr();
  }

  std::string input, out, err;
  OptionsArguments options_arguments;
  Options options;
  std::optional<int> exit_code;
};

constexpr char kNoImu[] = "pipeline.use_imu=false";

TEST(CommandLine, OptionsStandBeforeOrAfterThePositional) {
  const Program before({"--set", kNoImu, "--set", "ndt.voxel_m=2", "in.lcm"});
  const Program after({"in.lcm", "--set", kNoImu, "--set=ndt.voxel_m=2"});
  for (const Program* run : {&before, &after}) {
    EXPECT_EQ(run->exit_code, std::nullopt) << run->err;
    EXPECT_EQ(run->input, "in.lcm");
    EXPECT_THAT(run->options_arguments.sets, ElementsAre(kNoImu, "ndt.voxel_m=2"));
    EXPECT_EQ(run->options.ndt.voxel_m, 2);
  }
}

TEST(CommandLine, ListsPassThroughSet) {
  const Program run({"--set", "rig.T_imu_lidar.rotation_wxyz=[0,1,0,0]", "--set",
                     "rig.T_imu_lidar.translation_m=[-1, 2, 3]", "in.lcm"});
  EXPECT_EQ(run.exit_code, std::nullopt) << run.err;
  EXPECT_EQ(run.options.rig.T_imu_lidar->translation.x(), -1);
}

TEST(CommandLine, ConfigAndSetTakeExactlyOneValue) {
  const Program run({"--set", kNoImu, "in.lcm", "more"});
  EXPECT_EQ(run.exit_code, kExitUsage);
  EXPECT_EQ(Program({"in.lcm", "--config"}).exit_code, kExitUsage);
  EXPECT_EQ(Program({"in.lcm", "--set"}).exit_code, kExitUsage);
  EXPECT_EQ(Program({"in.lcm", "--set", "ndt.voxel_m"}).exit_code, kExitUsage);
}

TEST(CommandLine, UsageErrorsAreOneLineThatSaysWhatToDo) {
  const Program run({"--set", kNoImu});
  EXPECT_EQ(run.exit_code, kExitUsage);
  EXPECT_EQ(run.err, "lio-test: INPUT is required (see --help)\n");
  EXPECT_EQ(Program({"--unknown", "in.lcm"}).exit_code, kExitUsage);
}

TEST(CommandLine, ConfigurationFaultsAreALineEach) {
  const Program run({"in.lcm", "--set", "ndt.voxle_m=1", "--set", "filter.history_s=0"});
  EXPECT_EQ(run.exit_code, kExitConfiguration);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("did you mean ndt.voxel_m?"));
  EXPECT_EQ(Program({"in.lcm", "--config", "/nowhere/x.yaml"}).exit_code, kExitConfiguration);
}

TEST(CommandLine, PrintOptionsNeedsNoOtherArgumentsAndPrintsTheEffectiveOnes) {
  const Program run({"--print-options", "--set", kNoImu, "--set", "ndt.voxel_m=2"});
  EXPECT_EQ(run.exit_code, kExitDone) << run.err;
  Options expected;
  expected.pipeline.use_imu = false;
  expected.ndt.voxel_m = 2;
  EXPECT_EQ(run.out, PrintOptions(expected));
  EXPECT_EQ(Program({"--print-options"}).exit_code, kExitConfiguration);
}

TEST(CommandLine, HelpAndVersionEndWithZero) {
  EXPECT_EQ(Program({"--version"}).exit_code, kExitDone);
  EXPECT_EQ(Program({"--version"}).out, "lio-test 1.2.3\n");
  const Program help({"--help"});
  EXPECT_EQ(help.exit_code, kExitDone);
  EXPECT_THAT(help.out, HasSubstr("--print-options"));
}

TEST(CommandLine, NumbersAreCheckedAndNaNIsNone) {
  for (const char* bad : {"nan", "inf", "-inf", "", "x", "1x", "1e999", "--1"}) {
    EXPECT_THAT(NumberFromZero()(bad), HasSubstr("expects a number from 0 on, not '")) << bad;
    EXPECT_NE(NumberAboveZero()(bad), "") << bad;
    EXPECT_NE(NumberWithin(-5, 5)(bad), "") << bad;
    EXPECT_NE(WholeNumberFromZero()(bad), "") << bad;
  }
  EXPECT_EQ(NumberFromZero()("0"), "");
  EXPECT_EQ(NumberFromZero()("+1.5e3"), "");
  EXPECT_NE(NumberFromZero()("-0.1"), "");
  EXPECT_EQ(NumberAboveZero()("1e-9"), "");
  EXPECT_NE(NumberAboveZero()("0"), "");
  EXPECT_EQ(NumberWithin(-5, 5)("-5"), "");
  EXPECT_EQ(NumberWithin(-5, 5)("5.1"), "expects a number within -5 .. 5, not '5.1'");
  EXPECT_EQ(WholeNumberFromZero()("18446744073709551615"), "");
  EXPECT_NE(WholeNumberFromZero()("18446744073709551616"), "");
  EXPECT_NE(WholeNumberFromZero()("-1"), "");
  EXPECT_NE(WholeNumberFromZero()("1.5"), "");
}

TEST(CommandLine, NamesHaveALargestLength) {
  EXPECT_EQ(NameUpTo(3)("abc"), "");
  EXPECT_THAT(NameUpTo(3)("abcd"), HasSubstr("at most 3 characters"));
}

}  // namespace
}  // namespace lio
