// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/consistency_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

// The first instant has two runs; the second has one, so its band is wider.
BandedSeries SomeSeries(int dof, double first) {
  BandedSeries series;
  series.dof = dof;
  series.time_s = {0.5, 1.5};
  series.mean_per_dof = {first + 0.5, first + 0.6};
  series.band_per_dof = {{0.5, 1.5}, {0.25, 2.0}};
  series.average_per_dof = first;
  series.end_average_per_dof = first + 0.25;
  series.share_in_band = 0.5;
  return series;
}

Consistency SomeConsistency() {
  Consistency c;
  c.runs = {"seed_1", "seed_2"};
  c.run_pose_average_per_dof = {0.9, 1.1};
  c.run_largest_tilt = {TiltSample{12.25, 3.125}, std::nullopt};
  c.pose = SomeSeries(6, 1.0);
  c.position = SomeSeries(3, 2.0);
  c.rotation = SomeSeries(3, 3.0);
  c.nis = SomeSeries(6, 4.0);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    c.sigma_shares[axis] = {0.01 * static_cast<double>(axis), 0.5, 0.75};
  }
  c.horizontal_m = {0.2, 0.1};
  c.vertical_m = {0.04, 0.05};
  c.tilt_deg = {0.3, 0.45};
  c.yaw_deg = {0.0, 0.6};
  c.nis_whiteness.emplace();
  c.nis_whiteness->autocorrelation.assign(20, 0.125);
  c.nis_whiteness->band.assign(20, 0.1);
  c.nis_whiteness->share_in_band = 0.9;
  return c;
}

TEST(ConsistencyJson, KeysAreStable) {
  const auto json = ConsistencyJson(SomeConsistency());
  for (const char* pointer : {"/num_runs",
                              "/runs/0/name",
                              "/runs/0/nees_pose_per_dof",
                              "/runs/0/largest_tilt_sigmas",
                              "/largest_tilt/sigmas",
                              "/largest_tilt/time_s",
                              "/largest_tilt/run",
                              "/nees/pose/dof",
                              "/nees/pose/average_per_dof",
                              "/nees/pose/end_average_per_dof",
                              "/nees/pose/band_per_dof/1",
                              "/nees/pose/num_instants",
                              "/nees/pose/share_in_band",
                              "/nees/position/average_per_dof",
                              "/nees/rotation/average_per_dof",
                              "/rms/horizontal_m/real",
                              "/rms/vertical_m/predicted",
                              "/rms/tilt_deg/predicted_to_real_ratio",
                              "/rms/yaw_deg/real",
                              "/sigma_shares/x/0",
                              "/sigma_shares/rz/2",
                              "/nis/average_per_dof",
                              "/nis/share_in_band",
                              "/nis_whiteness/autocorrelation/19",
                              "/nis_whiteness/band/0",
                              "/nis_whiteness/share_in_band",
                              "/notes"}) {
    EXPECT_TRUE(json.contains(nlohmann::ordered_json::json_pointer(pointer))) << pointer;
  }
}

TEST(ConsistencyJson, FiguresStandUnderTheirKeys) {
  const Json json = ConsistencyJson(SomeConsistency());
  EXPECT_EQ(json["num_runs"], 2);
  EXPECT_EQ(json["runs"][0],
            (Json{{"name", "seed_1"}, {"nees_pose_per_dof", 0.9}, {"largest_tilt_sigmas", 3.125}}));
  EXPECT_EQ(json["largest_tilt"], (Json{{"sigmas", 3.125}, {"time_s", 12.25}, {"run", "seed_1"}}));
  EXPECT_EQ(json["nees"]["pose"],
            (Json{{"dof", 6},
                  {"average_per_dof", 1.0},
                  {"end_average_per_dof", 1.25},
                  {"band_per_dof", {0.5, 1.5}},  // the narrowest one, which covers all runs
                  {"num_instants", 2},
                  {"share_in_band", 0.5}}));
  EXPECT_EQ(json["nees"]["position"]["average_per_dof"], 2.0);
  EXPECT_EQ(json["nees"]["rotation"]["average_per_dof"], 3.0);
  EXPECT_EQ(json["nis"]["average_per_dof"], 4.0);
  EXPECT_EQ(json["rms"]["horizontal_m"],
            (Json{{"real", 0.2}, {"predicted", 0.1}, {"predicted_to_real_ratio", 0.5}}));
  EXPECT_EQ(json["rms"]["vertical_m"]["predicted_to_real_ratio"], 1.25);
  EXPECT_EQ(json["sigma_shares"]["x"], Json::array({0.0, 0.5, 0.75}));
  EXPECT_EQ(json["sigma_shares"]["rz"], Json::array({0.05, 0.5, 0.75}));
  EXPECT_EQ(json["nis_whiteness"]["share_in_band"], 0.9);
}

TEST(ConsistencyJson, WhatCannotBeToldIsNull) {
  Consistency c = SomeConsistency();
  c.nis.reset();
  c.nis_whiteness.reset();
  const Json json = ConsistencyJson(c);
  EXPECT_TRUE(json["nis"].is_null());
  EXPECT_TRUE(json["runs"][1]["largest_tilt_sigmas"].is_null());
  EXPECT_TRUE(json["nis_whiteness"].is_null());
  EXPECT_TRUE(json["rms"]["yaw_deg"]["predicted_to_real_ratio"].is_null()) << "no real error";
}

TEST(ConsistencyPictureData, HasTheSeriesOverTimeAndTheSummary) {
  const Json data = ConsistencyPictureData(SomeConsistency());
  EXPECT_EQ(
      data["pose"],
      (Json{
          {"time", {0.5, 1.5}}, {"mean", {1.5, 1.6}}, {"low", {0.5, 0.25}}, {"high", {1.5, 2.0}}}));
  EXPECT_EQ(data["rotation"]["mean"][0], 3.5);
  EXPECT_EQ(data["nis"]["mean"][0], 4.5);
  EXPECT_EQ(data["summary"], ConsistencyJson(SomeConsistency()));
}

TEST(ConsistencyText, TellsRunsBandsAndErrors) {
  const std::string text = ConsistencyText(SomeConsistency());
  EXPECT_THAT(text, StartsWith("runs        2\n\n"));
  EXPECT_THAT(text, HasSubstr("\nNEES pose         6      1.000      1.250    0.500 .. 1.500"
                              "       50.0 %\n"));
  EXPECT_THAT(text, HasSubstr("\nNIS               6      4.000 "));
  EXPECT_THAT(text, HasSubstr("\nhorizontal        m      0.20000      0.10000      0.500\n"));
  EXPECT_THAT(text, HasSubstr("\nyaw             deg      0.00000      0.60000      0.000\n"));
  EXPECT_THAT(text,
              HasSubstr("\nlargest tilt    3.12 sigma of roll and pitch, at 12.2 s of seed_1\n"));
  EXPECT_THAT(text, HasSubstr("\nrz                   5.0 %     50.0 %     75.0 %\n"));
  EXPECT_THAT(text, HasSubstr("\nGaussian            68.3 %     95.4 %     99.7 %\n"));
  EXPECT_THAT(text,
              EndsWith("NIS whiteness   lag-1 correlation +0.125, 90 % of 20 lags in band\n"));
}

TEST(ConsistencyText, WithoutNisThereAreNotesOnly) {
  Consistency c = SomeConsistency();
  c.nis.reset();
  c.nis_whiteness->band.clear();
  c.notes = {"no NIS"};
  EXPECT_THAT(ConsistencyText(c), Not(HasSubstr("NIS  ")));
  EXPECT_THAT(ConsistencyText(c), Not(HasSubstr("whiteness")));
  EXPECT_THAT(ConsistencyText(c), EndsWith("note: no NIS\n"));
}

}  // namespace
}  // namespace lio
