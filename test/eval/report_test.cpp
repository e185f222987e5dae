// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

const ReportedFiles kFiles{"truth.tum", "estimate.tum"};

Evaluation Example(bool is_kitti) {
  Trajectory truth = test::Helix(600);
  Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{p.rotation, 1.01 * p.translation};
  });
  if (is_kitti) truth = test::AsKitti(truth), estimate = test::AsKitti(estimate);
  return Evaluate(truth, estimate, {});
}

// Programs read these: a key that goes away breaks them.
TEST(EvaluationJson, KeysAreStable) {
  const auto json = EvaluationJson(Example(false), kFiles);
  for (const char* pointer : {"/truth",
                              "/estimate",
                              "/association/method",
                              "/association/max_gap_s",
                              "/association/is_max_gap_automatic",
                              "/association/num_truth",
                              "/association/num_estimate",
                              "/association/num_pairs",
                              "/association/num_outside",
                              "/association/num_in_gap",
                              "/association/num_missing_frames",
                              "/association/coverage_ratio",
                              "/association/truth_period_s",
                              "/association/estimate_period_s",
                              "/alignment/mode",
                              "/alignment/translation_m",
                              "/alignment/rotation_wxyz",
                              "/alignment/used_attitude",
                              "/alignment/rotation_uncertainty_deg",
                              "/rotation_offset/detected",
                              "/rotation_offset/removed",
                              "/rotation_offset/angle_deg",
                              "/rotation_offset/axis",
                              "/rotation_offset/scatter_deg",
                              "/rotation_offset/name",
                              "/path_length_m",
                              "/duration_s",
                              "/ape/position_m/rmse",
                              "/ape/position_m/mean",
                              "/ape/position_m/median",
                              "/ape/position_m/max",
                              "/ape/horizontal_m/rmse",
                              "/ape/vertical_m/rmse",
                              "/ape/rotation_deg/rmse",
                              "/ape/rotation_without_offset_deg/rmse",
                              "/tilt_deg/rmse",
                              "/step/interval_s",
                              "/step/count",
                              "/step/translation_m/median",
                              "/step/rotation_deg/median",
                              "/rpe/1s/count",
                              "/rpe/10m/translation_m/rmse",
                              "/rpe/50m/rotation_deg/rmse",
                              "/rpe/100m",
                              "/drift/translation_percent",
                              "/drift/rotation_deg_per_100m",
                              "/drift/num_segments",
                              "/drift/is_kitti_lengths",
                              "/drift/by_length/0/length_m",
                              "/drift/by_length/0/num_segments",
                              "/drift/by_length/0/translation_percent",
                              "/drift/by_length/0/rotation_deg_per_100m",
                              "/end/error_m",
                              "/end/error_percent",
                              "/end/rotation_error_deg",
                              "/end/estimate_gap_m",
                              "/end/truth_gap_m",
                              "/z_drift/end_m",
                              "/z_drift/end_percent",
                              "/z_drift/rmse_m",
                              "/z_drift/max_m",
                              "/notes"}) {
    const nlohmann::ordered_json::json_pointer path(pointer);
    ASSERT_TRUE(json.contains(path)) << pointer;
    EXPECT_FALSE(json[path].is_null()) << pointer;
  }
}

TEST(EvaluationJson, WhatAFileCannotTellIsNull) {
  const auto json = EvaluationJson(Example(true), kFiles);
  EXPECT_EQ(json["association"]["method"], "index");
  for (const char* pointer : {"/association/max_gap_s", "/duration_s", "/tilt_deg", "/z_drift",
                              "/rpe/1s", "/step/interval_s"}) {
    EXPECT_TRUE(json[nlohmann::ordered_json::json_pointer(pointer)].is_null()) << pointer;
  }
}

TEST(EvaluationText, AssociationAlignmentAndMissingFramesAreAlwaysTold) {
  for (const bool is_kitti : {false, true}) {
    const std::string text = EvaluationText(Example(is_kitti), kFiles);
    EXPECT_THAT(text, HasSubstr("associated  600 pairs, "));
    EXPECT_THAT(text, HasSubstr("alignment   se3: estimate turned by "));
    EXPECT_THAT(text, HasSubstr("0 missing frames"));
    EXPECT_THAT(text, HasSubstr("APE position"));
  }
  EXPECT_THAT(EvaluationText(Example(false), kFiles),
              HasSubstr("gaps of up to 0.25 s (automatic)"));
}

TEST(PictureData, ColumnsAreEquallyLongAndBreakAtHoles) {
  const Trajectory truth = test::Helix(100);
  Trajectory estimate = truth;
  estimate.poses.erase(estimate.poses.begin() + 40, estimate.poses.begin() + 60);
  const auto data = PictureData(Evaluate(truth, estimate, {}), kFiles);
  for (const auto& [name, column] : data["columns"].items()) {
    ASSERT_EQ(column.size(), 81u) << name;
    EXPECT_TRUE(column[40].is_null()) << name;
  }
}

// Truth moved into the estimate's world, where the map is.
TEST(PictureData, PathsAreInTheEstimatesWorld) {
  const Trajectory truth = test::Helix(100);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{ExpSo3({0, 0, 1}), {5, 6, 7}} * p;
  });
  const auto columns = PictureData(Evaluate(truth, estimate, {}), kFiles)["columns"];
  EXPECT_NEAR(columns["truth_x"][50].get<double>(), estimate.poses[50].pose.translation.x(), 1e-9);
  EXPECT_EQ(columns["estimate_x"][50].get<double>(), estimate.poses[50].pose.translation.x());
}

}  // namespace
}  // namespace lio
