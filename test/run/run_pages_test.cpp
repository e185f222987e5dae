// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/run_pages.hpp"

#include <gmock/gmock.h>

#include "lio/io/input_error.hpp"
#include "report/run_folder.hpp"

namespace lio {
namespace {

using RunPagesTest = test::RunFolder;

TEST_F(RunPagesTest, TheTruthIsThatInTheFolderElseThatOfTheScore) {
  EXPECT_FALSE(TruthOfRun(out_));
  const auto truth = WriteTruth();
  folder_.Write("run/eval.json", "{\"truth\": \"" + truth.string() + "\"}");
  EXPECT_EQ(TruthOfRun(out_), truth);
  const auto own = folder_.Write("run/truth.tum", test::ReadText(truth));
  EXPECT_EQ(TruthOfRun(out_), own);
}

TEST_F(RunPagesTest, AScoreThatIsDamagedOrNamesAMissingFileGivesNoTruth) {
  for (const char* text : {"", "{", "[]", "{\"truth\": 3}", "{\"truth\": \"/no/such.tum\"}"}) {
    folder_.Write("run/eval.json", text);
    EXPECT_FALSE(TruthOfRun(out_)) << text;
  }
}

TEST_F(RunPagesTest, APageIsOnlyReplacedWhenAskedTo) {
  const auto folder = folder_.path() / "both";
  const auto page = CompareRuns({out_, out_}, WriteTruth(), folder, false);
  EXPECT_THAT(test::ReadText(page), ::testing::HasSubstr("\"figures\""));
  EXPECT_THROW((void)CompareRuns({out_, out_}, {}, folder, false), UsageError);
  EXPECT_EQ(CompareRuns({out_, out_}, {}, folder, true), page);
}

}  // namespace
}  // namespace lio
