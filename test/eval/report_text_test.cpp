// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests EvaluationText.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/example_evaluation.hpp"

namespace lio {
namespace {

using test::ExampleEvaluation;
using test::kFiles;
using test::StatsFrom;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string Text(const Evaluation& evaluation) {
  return EvaluationText(evaluation, kFiles);
}

TEST(EvaluationText, AssociationAlignmentAndMissingFramesAreAlwaysTold) {
  for (const bool is_kitti : {false, true}) {
    const std::string text = EvaluationText(ExampleEvaluation(is_kitti), kFiles);
    EXPECT_THAT(text, HasSubstr("associated  600 pairs, "));
    EXPECT_THAT(text, HasSubstr("alignment   se3: estimate turned by "));
    EXPECT_THAT(text, HasSubstr("0 missing frames"));
    EXPECT_THAT(text, HasSubstr("APE position"));
  }
  EXPECT_THAT(EvaluationText(ExampleEvaluation(false), kFiles),
              HasSubstr("gaps of up to 0.25 s (automatic)"));
}

TEST(EvaluationText, HeadNamesFilesRatesAndWhatWasLost) {
  Evaluation e;
  e.association.num_truth = 500;
  e.association.truth_period_s = 0.01;
  e.association.num_estimate = 50;
  e.association.max_gap_s = 0.3;
  e.association.is_max_gap_automatic = false;
  e.association.num_outside = 2;
  e.association.num_in_gap = 3;
  e.association.coverage_ratio = 0.987;
  e.association.num_missing_frames = 4;
  e.path_length_m = 123.456;
  e.duration_s = 7.5;
  EXPECT_THAT(Text(e),
              StartsWith("truth       truth.tum: 500 poses, one every 0.01 s\n"
                         "estimate    estimate.tum: 50 poses\n"
                         "associated  0 pairs, truth interpolated across gaps of up to 0.3 s "
                         "(--max-gap); 2 outside the other's time, 3 in gaps\n"
                         "coverage    98.7 % of the truth, 4 missing frames\n"
                         "alignment   none\n"
                         "body offset none (mean 0.00 deg, scatter 0.00 deg)\n"
                         "path        123.46 m in 7.50 s\n\n"));
}

TEST(EvaluationText, RowsOfKittiFilesHaveNoTimes) {
  Evaluation e;
  e.association.method = AssociationMethod::kByIndex;
  e.path_length_m = 10;
  EXPECT_THAT(Text(e),
              AllOf(HasSubstr("row by row (no stamps)"), HasSubstr("path        10.00 m\n"),
                    HasSubstr("\nstep "), Not(HasSubstr("z drift")), Not(HasSubstr("tilt"))));
}

TEST(EvaluationText, AlignmentIsToldByItsSize) {
  Evaluation e;
  e.alignment.mode = AlignMode::kYaw;
  e.alignment.T_truth_estimate = {ExpSo3({0, 0, M_PI / 6}), {3, 4, 0}};
  EXPECT_THAT(Text(e), HasSubstr("yaw: estimate turned by 30.00 deg and moved by 5.000 m\n"));
}

TEST(EvaluationText, ADetectedOffsetIsNamed) {
  Evaluation e;
  e.rotation_offset.is_detected = true;
  e.rotation_offset.name = "90.0 deg about z";
  EXPECT_THAT(Text(e), HasSubstr("body offset 90.0 deg about z\n"));
}

TEST(EvaluationText, TheTableHasOneRowAFigure) {
  Evaluation e;
  e.ape = {StatsFrom(1), StatsFrom(2), StatsFrom(3), StatsFrom(4), StatsFrom(5)};
  e.tilt_deg = StatsFrom(6);
  e.step = {{StatsFrom(7), StatsFrom(8)}, 0.1};
  e.rpe.push_back({"10m", RelativeErrors{StatsFrom(9), StatsFrom(10)}});
  e.rpe.push_back({"50m", std::nullopt});
  const std::string text = Text(e);
  EXPECT_THAT(text, HasSubstr("APE position                  m     1.0000     1.1000     1.2000"
                              "     1.3000\n"));
  for (const char* row :
       {"    horizontal                m     2.0000", "    vertical                  m     3.0000",
        "    rotation                deg     4.0000", "    rotation, mean removed  deg     5.0000",
        "tilt (roll and pitch)       deg     6.0000", "step, 0.1 s                   m     7.0000",
        "                            deg     8.0000", "RPE over 10m                  m     9.0000",
        "                            deg    10.0000"}) {
    EXPECT_THAT(text, HasSubstr(std::string("\n").append(row)));
  }
  EXPECT_THAT(text, Not(HasSubstr("50m")));
}

TEST(EvaluationText, DriftSaysOverWhichLengths) {
  Evaluation e;
  EXPECT_THAT(Text(e), HasSubstr("drift       path too short\n"));
  e.drift = {true, 12, 1.25, 0.5, {{100, 8, 0, 0}, {200, 4, 0, 0}}};
  EXPECT_THAT(Text(e), HasSubstr("drift       1.250 %, 0.5000 deg/100m; 12 segments of 100 .. 200 "
                                 "m\n"));
  e.drift.is_kitti_lengths = false;
  EXPECT_THAT(Text(e), HasSubstr("200 m (path too short for KITTI's 100 m)\n"));
}

TEST(EvaluationText, EndsWithEndHeightAndNotes) {
  Evaluation e;
  e.end = {0.5, 1.5, 2.5, 3.5, 4.5};
  e.height = HeightDrift{-0.25, 1.0, 0.125, 0.5};
  e.notes = {"first", "second"};
  EXPECT_THAT(
      Text(e),
      EndsWith("end         error 2.500 m = 3.50 % of the path, 4.500 deg; start-to-end gap "
               "1.500 m, truth's 0.500 m\n"
               "z drift     -0.250 m at the end = 1.00 % of the path; rmse 0.125 m, max "
               "0.500 m\n"
               "note: first\nnote: second\n"));
}

}  // namespace
}  // namespace lio
