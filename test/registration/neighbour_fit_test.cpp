// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/neighbour_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

constexpr float kPointsEach = 4.f;  // each neighbour is the mean of so many

PointMap::Neighbours Of(const std::vector<Eigen::Vector3f>& points) {
  PointMap::Neighbours neighbours;
  for (const Eigen::Vector3f& point : points) {
    auto& neighbour = neighbours.list[static_cast<std::size_t>(neighbours.count++)];
    neighbour.from_query = point;
    neighbour.num_points = kPointsEach;
  }
  return neighbours;
}

// Range noise left in a mean of four: 3 cm / 2.
const LoamOptions kOptions;
const double kNoiseVar = kOptions.surface_std_m * kOptions.surface_std_m / double{kPointsEach};

// --- lines

std::vector<Eigen::Vector3f> PointsOnALine(float step_m, float off_m = 0.f) {
  const Eigen::Vector3f start(1, 2, 3);
  const Eigen::Vector3f along = Eigen::Vector3f(1, 2, 2) / 3.f;
  std::vector<Eigen::Vector3f> points;
  for (int i = -2; i <= 2; ++i) points.push_back(start + static_cast<float>(i) * step_m * along);
  points[2] += off_m * Eigen::Vector3f(0, 1, -1).normalized();
  return points;
}

TEST(FitLine, FindsTheLineThroughItsPoints) {
  const auto line = FitLine(Of(PointsOnALine(0.4f)), kOptions);
  ASSERT_TRUE(line);
  EXPECT_LT((line->centre - Vector3(1, 2, 3)).norm(), 1e-6);
  EXPECT_NEAR(std::abs(line->direction.dot(Vector3(1, 2, 2) / 3.0)), 1.0, 1e-6);
  // Five points have a variance along of 2 * 0.4^2: the noise over their sum.
  EXPECT_NEAR(line->direction_var, kNoiseVar / (5 * 2 * 0.16), 1e-7);
}

TEST(FitLine, ScatterAcrossMakesTheDirectionUnsure) {
  const auto line = FitLine(Of(PointsOnALine(0.4f, 0.15f)), kOptions);
  ASSERT_TRUE(line);
  const double across_var = 0.15 * 0.15 * 0.2 * 0.8;  // one point in five is off
  EXPECT_NEAR(line->direction_var, across_var / (5 * 2 * 0.16), 1e-5);
}

TEST(FitLine, RoundHeapsShortPiecesAndFewPointsAreNone) {
  EXPECT_FALSE(
      FitLine(Of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5f, 0.5f, 1}}), kOptions));
  EXPECT_FALSE(FitLine(Of(PointsOnALine(0.05f)), kOptions)) << "within a leaf";
  auto four = PointsOnALine(0.4f);
  four.pop_back();
  EXPECT_FALSE(FitLine(Of(four), kOptions));
}

TEST(FitLine, HowMuchLongerThanWideIsAnOption) {
  const auto points = Of(PointsOnALine(0.4f, 0.6f));  // variances 0.32 and 0.0576
  LoamOptions options;
  options.min_line_ratio = 5.0;
  EXPECT_TRUE(FitLine(points, options));
  options.min_line_ratio = 6.0;
  EXPECT_FALSE(FitLine(points, options));
}

// --- planes

// Makes a cross of half width `half_m` in the plane across z, off it by `off_m` at its middle.
std::vector<Eigen::Vector3f> Cross(float half_m, float narrow_m, float off_m = 0.f) {
  return {{0, 0, 2 + off_m}, {half_m, 0, 2}, {-half_m, 0, 2}, {0, narrow_m, 2}, {0, -narrow_m, 2}};
}

TEST(FitPlane, FindsThePlaneThroughItsPoints) {
  const auto plane = FitPlane(Of(Cross(0.6f, 0.4f)), kOptions);
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->centre - Vector3(0, 0, 2)).norm(), 1e-6);
  EXPECT_NEAR(std::abs(plane->normal.z()), 1.0, 1e-6);
  EXPECT_LT((plane->axes.transpose() * plane->axes - Matrix3::Identity()).norm(), 1e-6);
  EXPECT_EQ(plane->axes.col(0), plane->normal);
  // The tilt toward the narrow side comes first: the noise over the sum of squares 2 * 0.4^2, 2 *
  // 0.6^2.
  EXPECT_NEAR(std::abs(plane->axes(1, 1)), 1.0, 1e-6);
  EXPECT_NEAR(plane->normal_var[0], kNoiseVar / (2 * 0.16), 1e-7);
  EXPECT_NEAR(plane->normal_var[1], kNoiseVar / (2 * 0.36), 1e-7);
}

TEST(FitPlane, APointOffThePlaneSpoilsIt) {
  // The mean follows by a fifth: 0.8 of it is left.
  EXPECT_TRUE(FitPlane(Of(Cross(0.6f, 0.6f, 0.12f)), kOptions));
  LoamOptions strict;
  strict.max_plane_error_m = 0.09;
  EXPECT_FALSE(FitPlane(Of(Cross(0.6f, 0.6f, 0.12f)), strict));
}

TEST(FitPlane, APieceOfOneRingIsNone) {
  EXPECT_FALSE(FitPlane(Of(Cross(0.6f, 0.05f)), kOptions));
  EXPECT_FALSE(FitPlane(Of(PointsOnALine(0.4f)), kOptions));
}

TEST(FitPlane, ANormalNotKnownToSixDegreesIsNone) {
  LoamOptions options;
  options.surface_std_m = 0.3;  // a mean of four errs 0.15 m: 0.15 / sqrt(0.72) rad
  EXPECT_FALSE(FitPlane(Of(Cross(0.6f, 0.6f)), options));
}

TEST(FitPlane, FewPointsAreNone) {
  auto four = Cross(0.6f, 0.6f);
  four.pop_back();
  EXPECT_FALSE(FitPlane(Of(four), kOptions));
}

}  // namespace
}  // namespace lio
