// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/scored_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/paths.hpp"
#include "lio/eval/time_offset.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(ScoreRun, TakesTheSteadyPathOfAFolder) {
  const test::TempDir dir;
  WriteTum(dir.path() / "trajectory.tum", test::Straight(50, 1.0).poses);
  WriteTum(dir.path() / "trajectory_level.tum", test::Helix(50).poses);
  const ScoredRun run = ScoreRun(test::Helix(50), dir.path().string(), {}, {});
  EXPECT_EQ(run.name, dir.path().string());
  EXPECT_EQ(run.file, (dir.path() / "trajectory_level.tum").string());
  EXPECT_LT(run.evaluation.ape.position_m.max, 1e-6);
}

TEST(ScoreRun, SetsTheClockAsWished) {
  const test::TempDir dir;
  const std::string file = (dir.path() / "late.tum").string();
  WriteTum(file, Shifted(test::Helix(200), 0.25).poses);
  EXPECT_GT(ScoreRun(test::Helix(200), file, {}, {}).evaluation.ape.position_m.max, 1e-3);
  const ScoredRun told = ScoreRun(test::Helix(200), file, {}, {false, -0.25});
  EXPECT_LT(told.evaluation.ape.position_m.max, 1e-6);
  const ScoredRun found = ScoreRun(test::Helix(200), file, {}, {true, 0.0});
  EXPECT_NEAR(found.time_offset_s, -0.25, 1e-3);
}

TEST(ScoreRun, AFileThatIsMissingIsNamed) {
  const auto score = [] { return ScoreRun(test::Helix(50), "/no/such.tum", {}, {}); };
  EXPECT_THAT(score, ThrowsMessage<std::runtime_error>(HasSubstr("/no/such.tum")));
}

}  // namespace
}  // namespace lio
