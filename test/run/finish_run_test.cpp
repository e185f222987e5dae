// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/finish_run.hpp"

#include <gmock/gmock.h>

#include "report/run_folder.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using FinishRunTest = test::RunFolder;

TEST_F(FinishRunTest, AScoredRunHasItsFigures) {
  const Score score = ScoreRun(out_, WriteTruth());
  EXPECT_TRUE(score.is_scored) << score.line;
  EXPECT_THAT(score.line, HasSubstr("0.000 m rmse"));
  EXPECT_THAT(test::ReadText(out_ / "eval.json"), HasSubstr("trajectory_level.tum"));
  EXPECT_FALSE(test::ReadText(out_ / "eval.txt").empty());
}

TEST_F(FinishRunTest, ATruthThatDoesNotFitIsSaidNotThrown) {
  const Score score = ScoreRun(out_, folder_.Write("bad.tum", "1 2 three\n"));
  EXPECT_FALSE(score.is_scored);
  EXPECT_THAT(score.line, HasSubstr("bad.tum"));
}

TEST_F(FinishRunTest, StaleFilesGoButNotTheTruthThatIsGiven) {
  for (const char* name : {"run/eval.json", "run/truth.tum"}) folder_.Write(name, "old");
  RemoveStaleFiles(out_, out_ / "truth.tum");
  EXPECT_FALSE(std::filesystem::exists(out_ / "eval.json"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "truth.tum"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "trajectory.tum"));
}

}  // namespace
}  // namespace lio
