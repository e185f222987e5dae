// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests PictureData.
#include <gtest/gtest.h>

#include "eval/example_evaluation.hpp"

namespace lio {
namespace {

using test::kFiles;

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

// The truth is moved into the estimate's world, because the map is there.
TEST(PictureData, PathsAreInTheEstimatesWorld) {
  const Trajectory truth = test::Helix(100);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{ExpSo3({0, 0, 1}), {5, 6, 7}} * p;
  });
  const auto columns = PictureData(Evaluate(truth, estimate, {}), kFiles)["columns"];
  EXPECT_NEAR(columns["truth_x"][50].get<double>(), estimate.poses[50].pose.translation.x(), 1e-9);
  EXPECT_EQ(columns["estimate_x"][50].get<double>(), estimate.poses[50].pose.translation.x());
}

TEST(PictureData, ErrorsAndHeightsAreThoseOfEachPair) {
  const Trajectory truth = test::Helix(50);
  const Trajectory estimate = test::Map(truth, [](const Pose& p) {
    const double rise = p.translation.z();  // the estimate climbs twice as fast
    return Pose{p.rotation, p.translation + Vector3(0, 0, rise)};
  });
  EvaluationOptions options;
  options.align = AlignMode::kNone;
  const auto data = PictureData(Evaluate(truth, estimate, options), kFiles);
  const auto& columns = data["columns"];
  EXPECT_EQ(data["has_time"], true);
  for (std::size_t i = 0; i < 50; ++i) {
    const double rise = 0.01 * static_cast<double>(i);
    EXPECT_NEAR(columns["time"][i].get<double>(), 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(columns["position_error_m"][i].get<double>(), rise, 1e-9);
    EXPECT_NEAR(columns["rotation_error_deg"][i].get<double>(), 0.0, 1e-6);
    EXPECT_NEAR(columns["truth_height_m"][i].get<double>(), rise, 1e-9);
    EXPECT_NEAR(columns["estimate_height_m"][i].get<double>(), 2.0 * rise, 1e-9);
  }
  EXPECT_EQ(data["summary"]["truth"], "truth.tum");
}

// Rows without stamps are counted, and no row is taken for a hole.
TEST(PictureData, RowsOfKittiFilesAreCounted) {
  const Trajectory truth = test::AsKitti(test::Helix(50));
  const auto data = PictureData(Evaluate(truth, truth, {}), kFiles);
  EXPECT_EQ(data["has_time"], false);
  ASSERT_EQ(data["columns"]["time"].size(), 50u);
  EXPECT_EQ(data["columns"]["time"][49], 49.0);
}

// Up to three missing periods do not interrupt the line.
TEST(PictureData, AFewMissingFramesAreNoHole) {
  const Trajectory truth = test::Helix(100);
  Trajectory estimate = truth;
  estimate.poses.erase(estimate.poses.begin() + 40, estimate.poses.begin() + 42);
  const auto data = PictureData(Evaluate(truth, estimate, {}), kFiles);
  ASSERT_EQ(data["columns"]["time"].size(), 98u);
  for (const auto& time : data["columns"]["time"]) EXPECT_FALSE(time.is_null());
}

}  // namespace
}  // namespace lio
