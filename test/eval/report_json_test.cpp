// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests EvaluationJson.
#include <gtest/gtest.h>

#include <array>

#include "eval/example_evaluation.hpp"

namespace lio {
namespace {

using test::ExampleEvaluation;
using test::kFiles;
using test::StatsFrom;
using Json = nlohmann::ordered_json;

// Programs read these keys: removing one breaks them.
constexpr auto kKeys = std::to_array<const char*>({"/truth",
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
                                                   "/notes"});

TEST(EvaluationJson, KeysAreStable) {
  const auto json = EvaluationJson(ExampleEvaluation(false), kFiles);
  for (const char* pointer : kKeys) {
    const nlohmann::ordered_json::json_pointer path(pointer);
    ASSERT_TRUE(json.contains(path)) << pointer;
    EXPECT_FALSE(json[path].is_null()) << pointer;
  }
}

TEST(EvaluationJson, WhatAFileCannotTellIsNull) {
  const auto json = EvaluationJson(ExampleEvaluation(true), kFiles);
  EXPECT_EQ(json["association"]["method"], "index");
  for (const char* pointer : {"/association/max_gap_s", "/duration_s", "/tilt_deg", "/z_drift",
                              "/rpe/1s", "/step/interval_s"}) {
    EXPECT_TRUE(json[nlohmann::ordered_json::json_pointer(pointer)].is_null()) << pointer;
  }
}

void ExpectStats(const Json& json, double first) {
  EXPECT_EQ(
      json,
      (Json{
          {"rmse", first}, {"mean", first + 0.1}, {"median", first + 0.2}, {"max", first + 0.3}}));
}

// Each figure is under its own key: all have different values.
TEST(EvaluationJson, FiguresStandUnderTheirKeys) {
  Evaluation e;
  e.path_length_m = 1.5;
  e.duration_s = 2.5;
  e.ape = {StatsFrom(10), StatsFrom(20), StatsFrom(30), StatsFrom(40), StatsFrom(50)};
  e.tilt_deg = StatsFrom(60);
  e.step = {{StatsFrom(70), StatsFrom(80)}, 0.1};
  e.rpe.push_back({"10m", RelativeErrors{StatsFrom(90), StatsFrom(100)}});
  e.rpe.push_back({"50m", std::nullopt});
  e.end = {1, 2, 3, 4, 5};
  e.height = HeightDrift{6, 7, 8, 9};
  e.notes = {"mind the gap"};
  const Json json = EvaluationJson(e, kFiles);
  EXPECT_EQ(json["truth"], "truth.tum");
  EXPECT_EQ(json["estimate"], "estimate.tum");
  EXPECT_EQ(json["path_length_m"], 1.5);
  EXPECT_EQ(json["duration_s"], 2.5);
  ExpectStats(json["ape"]["position_m"], 10);
  ExpectStats(json["ape"]["horizontal_m"], 20);
  ExpectStats(json["ape"]["vertical_m"], 30);
  ExpectStats(json["ape"]["rotation_deg"], 40);
  ExpectStats(json["ape"]["rotation_without_offset_deg"], 50);
  ExpectStats(json["tilt_deg"], 60);
  ExpectStats(json["step"]["translation_m"], 70);
  ExpectStats(json["step"]["rotation_deg"], 80);
  EXPECT_EQ(json["step"]["interval_s"], 0.1);
  EXPECT_EQ(json["step"]["count"], 7);
  ExpectStats(json["rpe"]["10m"]["translation_m"], 90);
  ExpectStats(json["rpe"]["10m"]["rotation_deg"], 100);
  EXPECT_TRUE(json["rpe"]["50m"].is_null());
  EXPECT_EQ(json["end"], (Json{{"error_m", 3.0},
                               {"error_percent", 4.0},
                               {"rotation_error_deg", 5.0},
                               {"estimate_gap_m", 2.0},
                               {"truth_gap_m", 1.0}}));
  EXPECT_EQ(json["z_drift"],
            (Json{{"end_m", 6.0}, {"end_percent", 7.0}, {"rmse_m", 8.0}, {"max_m", 9.0}}));
  EXPECT_EQ(json["notes"], Json::array({"mind the gap"}));
}

TEST(EvaluationJson, AssociationIsToldInFull) {
  Evaluation e;
  e.association.method = AssociationMethod::kEstimateInterpolated;
  e.association.max_gap_s = 0.3;
  e.association.is_max_gap_automatic = false;
  e.association.num_truth = 11;
  e.association.num_estimate = 12;
  e.association.num_outside = 13;
  e.association.num_in_gap = 14;
  e.association.num_missing_frames = 15;
  e.association.coverage_ratio = 0.75;
  e.association.truth_period_s = 0.01;
  e.association.estimate_period_s = 0.1;
  const Json json = EvaluationJson(e, kFiles)["association"];
  EXPECT_EQ(json, (Json{{"method", "estimate_interpolated"},
                        {"max_gap_s", 0.3},
                        {"is_max_gap_automatic", false},
                        {"num_truth", 11},
                        {"num_estimate", 12},
                        {"num_pairs", 0},
                        {"num_outside", 13},
                        {"num_in_gap", 14},
                        {"num_missing_frames", 15},
                        {"coverage_ratio", 0.75},
                        {"truth_period_s", 0.01},
                        {"estimate_period_s", 0.1}}));
}

TEST(EvaluationJson, RotationsHaveWFirst) {
  Evaluation e;
  e.alignment.mode = AlignMode::kYaw;
  e.alignment.T_truth_estimate = {Quaternion(0.1, 0.2, 0.3, 0.4), {5, 6, 7}};
  e.rotation_offset.axis = {0, 1, 0};
  e.rotation_offset.name = "90.0 deg about y";
  const Json json = EvaluationJson(e, kFiles);
  EXPECT_EQ(json["alignment"]["mode"], "yaw");
  EXPECT_EQ(json["alignment"]["rotation_wxyz"], Json::array({0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(json["alignment"]["translation_m"], Json::array({5.0, 6.0, 7.0}));
  EXPECT_EQ(json["rotation_offset"]["axis"], Json::array({0.0, 1.0, 0.0}));
  EXPECT_EQ(json["rotation_offset"]["name"], "90.0 deg about y");
  EXPECT_EQ(json["rotation_offset"]["detected"], false);
}

TEST(EvaluationJson, DriftOfAShortPathIsNullNotZero) {
  Evaluation e;
  Json drift = EvaluationJson(e, kFiles)["drift"];
  EXPECT_TRUE(drift["translation_percent"].is_null());
  EXPECT_TRUE(drift["rotation_deg_per_100m"].is_null());
  EXPECT_EQ(drift["by_length"], Json::array());
  e.drift = {false, 3, 1.25, 0.5, {{20, 3, 1.25, 0.5}}};
  drift = EvaluationJson(e, kFiles)["drift"];
  EXPECT_EQ(drift["translation_percent"], 1.25);
  EXPECT_EQ(drift["is_kitti_lengths"], false);
  EXPECT_EQ(drift["by_length"][0], (Json{{"length_m", 20.0},
                                         {"num_segments", 3},
                                         {"translation_percent", 1.25},
                                         {"rotation_deg_per_100m", 0.5}}));
}

}  // namespace
}  // namespace lio
