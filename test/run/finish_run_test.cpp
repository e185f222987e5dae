// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/finish_run.hpp"

#include <gmock/gmock.h>

#include "lio/io/options_yaml.hpp"
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
  RemoveStaleFiles(out_, {out_ / "truth.tum"});
  EXPECT_FALSE(std::filesystem::exists(out_ / "eval.json"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "truth.tum"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "trajectory.tum"));
}

TEST_F(FinishRunTest, TheCorrectedRigHasTheLinesOfTheLikeliestCause) {
  const auto rig = folder_.Write("rig.yaml",
                                 "rig:\n  lidar: {model: vlp16}\n  T_imu_lidar: {translation_m: "
                                 "[0, 0, 0], rotation_rpy_deg: [0, 0, 0]}\n");
  Verdict verdict;
  verdict.causes = {{CauseKind::kNoMotion, Trust::kDoubtful, 0.0, "the body stood", ""},
                    {CauseKind::kClockOffset, Trust::kNo, 9.0, "the clocks differ",
                     "rig: {lidar: {clock_offset_s: 0.025}}"}};
  const auto corrected = WriteCorrectedRig(out_, {rig}, verdict);
  ASSERT_TRUE(corrected);
  const LoadResult loaded = LoadOptions({*corrected}, {});
  EXPECT_THAT(loaded.faults, ::testing::IsEmpty());
  EXPECT_EQ(loaded.options.rig.lidar.clock_offset_s, 0.025);
  EXPECT_EQ(loaded.options.rig.lidar.model, "vlp16");
  EXPECT_THAT(test::ReadText(*corrected), HasSubstr("# the clocks differ\n"));
}

TEST_F(FinishRunTest, WithoutAFixThereIsNoCorrectedRig) {
  Verdict verdict;
  verdict.causes = {{CauseKind::kNoMotion, Trust::kDoubtful, 0.0, "the body stood", ""}};
  EXPECT_FALSE(WriteCorrectedRig(out_, {}, verdict));
  EXPECT_FALSE(std::filesystem::exists(out_ / "rig_corrected.yaml"));
}

}  // namespace
}  // namespace lio
