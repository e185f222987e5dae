// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs lio-run as its users do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using test::SceneDir;
using ::testing::HasSubstr;
using ::testing::Not;

class LioRunTest : public ::testing::Test {
 protected:
  test::ProgramResult Run(const std::vector<std::string>& words) {
    std::vector<std::string> command = {test::Program("lio-run")};
    command.insert(command.end(), words.begin(), words.end());
    return test::RunProgram(command);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  bool Has(const std::string& name) const { return std::filesystem::exists(Path(name)); }

  test::TempDir folder_;
};

TEST_F(LioRunTest, ASimulatedDriveIsRunScoredAndReported) {
  const auto result = Run({SceneDir(), "--out", Path("out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* name :
       {"trajectory_level.tum", "verdict.json", "stats.json", "options.yaml", "states.csv",
        "notices.tsv", "map.pcd", "eval.json", "eval.txt", "report.html"}) {
    EXPECT_TRUE(Has(std::string("out/") + name)) << name;
  }
  EXPECT_FALSE(Has("out/log.lcm")) << "a log is read where it lies";
  EXPECT_THAT(result.out, HasSubstr("config.yaml, which lies beside"));
  EXPECT_THAT(result.out, HasSubstr("position error"));
  EXPECT_THAT(result.out, HasSubstr("trust: "));
}

TEST_F(LioRunTest, ALoneLogIsRunWithADraftedRigThatCanBeGivenBack) {
  std::filesystem::copy(SceneDir() + "/log.lcm", folder_.path() / "drive.lcm");
  const auto drafted = Run({Path("drive.lcm"), "--out", Path("out")});
  EXPECT_THAT(drafted.err, Not(HasSubstr("configuration")));
  EXPECT_THAT(drafted.out, HasSubstr("ASSUMED"));
  EXPECT_THAT(test::ReadText(Path("out/rig_draft.yaml")), HasSubstr("model: vlp16"));
  const auto again = Run({Path("drive.lcm"), "--rig", Path("out/rig_draft.yaml"), "--out",
                          Path("out"), "--overwrite"});
  EXPECT_EQ(again.exit_code, drafted.exit_code);
  EXPECT_THAT(again.out, Not(HasSubstr("ASSUMED")));
  EXPECT_TRUE(Has("out/rig_draft.yaml")) << "the rig in use is not removed";
}

TEST_F(LioRunTest, AFolderWithSomethingInItIsOnlyOverwrittenWhenAskedTo) {
  folder_.Write("out/precious.txt", "");
  const auto refused = Run({SceneDir(), "--out", Path("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--overwrite"));
  EXPECT_EQ(Run({SceneDir(), "--out", Path("out"), "--overwrite"}).exit_code, 0);
  EXPECT_TRUE(Has("out/precious.txt"));
}

TEST_F(LioRunTest, TheFolderOfTheInputIsNeverWrittenInto) {
  std::filesystem::copy(SceneDir(), folder_.path() / "sim");
  const std::string truth = test::ReadText(Path("sim/truth.tum"));
  for (const char* input : {"sim", "sim/", "sim/log.lcm"}) {
    const auto result = Run({Path(input), "--out", Path("sim"), "--overwrite"});
    EXPECT_EQ(result.exit_code, 2) << input;
    EXPECT_THAT(result.err, HasSubstr("holds the input")) << input;
  }
  EXPECT_TRUE(test::ReadText(Path("sim/truth.tum")) == truth);
}

TEST_F(LioRunTest, AFinishedRunGetsItsReportAnew) {
  ASSERT_EQ(Run({SceneDir(), "--out", Path("out")}).exit_code, 0);
  std::filesystem::remove(Path("out/report.html"));
  const auto result = Run({Path("out"), "--truth", SceneDir() + "/truth.tum"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(Has("out/report.html"));
  EXPECT_THAT(result.out, HasSubstr("position error"));
}

TEST_F(LioRunTest, AReportMadeAnewKeepsTheTruthThatTheRunWasScoredWith) {
  ASSERT_EQ(Run({SceneDir(), "--out", Path("out"), "--truth", SceneDir() + "/truth.tum"}).exit_code,
            0);
  const auto result = Run({Path("out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("position error"));
}

TEST_F(LioRunTest, SeveralRunsMakeOnePageAndAllMustBeRuns) {
  ASSERT_EQ(Run({SceneDir(), "--out", Path("a")}).exit_code, 0);
  ASSERT_EQ(Run({SceneDir(), "--out", Path("b"), "--set", "pipeline.use_imu=false"}).exit_code, 0);
  const auto compared = Run({Path("a"), Path("b"), "--out", Path("both")});
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_THAT(test::ReadText(Path("both/report.html")), HasSubstr("\"runs\":[{"));
  const auto again = Run({Path("a"), Path("b"), "--out", Path("both")});
  EXPECT_EQ(again.exit_code, 2) << "a page is only replaced when asked to";
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
  EXPECT_THAT(Run({Path("a"), SceneDir(), "--out", Path("both")}).err,
              HasSubstr("is no folder of"));
  EXPECT_THAT(Run({Path("a"), Path("b")}).err, HasSubstr("--out is required"));
  EXPECT_THAT(Run({Path("a"), Path("b"), "--out", Path("a")}).err, HasSubstr("of its own"));
}

TEST_F(LioRunTest, AResultWithoutTrustEndsWithSix) {
  const auto result = Run({SceneDir(), "--out", Path("out"), "--duration", "1"});
  EXPECT_EQ(result.exit_code, 6) << result.err;
  EXPECT_TRUE(Has("out/report.html")) << "also a run without a pose has its page";
  EXPECT_THAT(result.out, HasSubstr("trust: no"));
}

TEST_F(LioRunTest, WrongInputsEndInOneLineThatNamesTheFix) {
  struct Case {
    std::vector<std::string> words;
    int exit_code;
    std::string says;
  };
  const std::string out = Path("never");
  const std::string rig = folder_.Write("rig.yaml", "rig: {lidar: {modell: vlp16}}\n").string();
  for (const Case& wrong :
       std::vector<Case>{{{}, 2, "INPUT"},
                         {{SceneDir()}, 2, "--out"},
                         {{SceneDir(), "--out", out, "--nonsense"}, 2, "--nonsense"},
                         {{SceneDir(), "--out", rig}, 2, "--out"},
                         {{"/no/such.bag", "--out", out}, 5, "/no/such.bag"},
                         {{rig, "--out", out}, 5, "is no ROS bag"},
                         {{SceneDir(), "--out", out, "--truth", "/no/such.tum"}, 2, "--truth"},
                         {{SceneDir(), "--out", out, "--overwrite", "--set", "rig.lidar.modell=x"},
                          3,
                          "model?"}}) {
    const auto result = Run(wrong.words);
    EXPECT_EQ(result.exit_code, wrong.exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(wrong.says));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(LioRunTest, HelpTeaches) {
  const auto help = Run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* words : {"Examples:", "Exit codes:", "--overwrite", "rig_draft.yaml"}) {
    EXPECT_THAT(help.out, HasSubstr(words));
  }
}

}  // namespace
}  // namespace lio
