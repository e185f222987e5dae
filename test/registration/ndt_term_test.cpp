// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/ndt_term.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

// The patch lies across z, is 2 cm thick, and has a spread of 0.5 m along x and 0.25 m along y.
SurfacePatch Floor() {
  SurfacePatch patch;
  patch.kind = SurfacePatch::Kind::kPlane;
  patch.normal = {0, 0, 1};
  patch.thickness_var = 0.0004f;
  patch.tangent1_per_std = {2, 0, 0};
  patch.tangent2_per_std = {0, 4, 0};
  patch.num_points = 40.f;
  return patch;
}

// The post stands along z and has a spread of 2 cm along x and 5 cm along y.
SurfacePatch Post() {
  SurfacePatch patch = Floor();
  patch.kind = SurfacePatch::Kind::kVertical;
  patch.normal = {1, 0, 0};
  patch.tangent1_per_std = {0, 20, 0};
  patch.tangent2_per_std.setZero();
  return patch;
}

TEST(NdtTerm, APlaneConstrainsAlongItsNormal) {
  const NdtTerm term = MakeNdtTerm(Floor(), {0, 0, 0.03f}, 0.f, 0.f);
  ASSERT_EQ(term.num_rows, 1);
  EXPECT_EQ(term.rows[0].direction, Eigen::Vector3f(0, 0, 1));
  EXPECT_FLOAT_EQ(term.rows[0].distance, 0.03f);
  EXPECT_FLOAT_EQ(term.distance_sq, 2.25f);  // 1.5 sigma
  EXPECT_FLOAT_EQ(term.rows[0].weight, RobustKernel(2.25f).weight() / 0.0004f);
}

// The variance contains the error of the mean, and that of the tilt times the square of the point's
// distance in spreads: for 10 points here and 40 in the cell, one spread along x and two along y,
// it grows by the factor 1 + (1 + 1 + 4) / 4.
TEST(NdtTerm, FarFromItsMeanAPlaneIsLessSure) {
  const NdtTerm term = MakeNdtTerm(Floor(), {0.5f, 0.5f, 0}, 10.f, 0.f);
  EXPECT_FLOAT_EQ(term.rows[0].weight, 1.f / (0.0004f * 2.5f));
  // Beyond two spreads it does not grow further.
  const NdtTerm beyond = MakeNdtTerm(Floor(), {5.f, 0.5f, 0}, 10.f, 0.f);
  EXPECT_FLOAT_EQ(beyond.rows[0].weight, 1.f / (0.0004f * (1.f + (1.f + 4.f + 4.f) / 4.f)));
}

TEST(NdtTerm, WhatTheGuessMayBeOffWidensIt) {
  const NdtTerm term = MakeNdtTerm(Floor(), {0, 0, 0.1f}, 0.f, 0.0096f);
  EXPECT_FLOAT_EQ(term.distance_sq, 1.f);
}

TEST(NdtTerm, BeyondFiveSigmaItIsAnOutlier) {
  EXPECT_FALSE(MakeNdtTerm(Floor(), {0, 0, 0.099f}, 0.f, 0.f).IsOutlier());
  EXPECT_TRUE(MakeNdtTerm(Floor(), {0, 0, 0.101f}, 0.f, 0.f).IsOutlier());
  EXPECT_TRUE(MakeNdtTerm(Floor(), {0, 0, -0.101f}, 0.f, 0.f).IsOutlier());
}

// The point is off by 2 cm of 2 cm along x, by 10 cm of 5 cm along y: 1 + 4.
TEST(NdtTerm, AVerticalStructureConstrainsTwoHorizontalDirections) {
  const NdtTerm term = MakeNdtTerm(Post(), {0.02f, 0.1f, 3.f}, 0.f, 0.f);
  ASSERT_EQ(term.num_rows, 2);
  EXPECT_EQ(term.rows[0].direction, Eigen::Vector3f(1, 0, 0));
  EXPECT_LT((term.rows[1].direction - Eigen::Vector3f(0, 1, 0)).norm(), 1e-6f);
  EXPECT_FLOAT_EQ(term.rows[0].distance, 0.02f);
  EXPECT_FLOAT_EQ(term.rows[1].distance, 0.1f);
  EXPECT_NEAR(term.distance_sq, 5.f, 1e-4f);
  const float weight = RobustKernel(5.f).weight();
  EXPECT_NEAR(term.rows[0].weight, weight / 0.0004f, 0.1f);
  EXPECT_NEAR(term.rows[1].weight, weight / 0.0025f, 0.1f);
}

TEST(NdtTerm, APostsMeanHasAnErrorOfItsOwn) {
  const NdtTerm sure = MakeNdtTerm(Post(), {0, 0, 0}, 0.f, 0.f);
  const NdtTerm shared = MakeNdtTerm(Post(), {0, 0, 0}, 40.f, 0.f);  // as many as the map has
  EXPECT_FLOAT_EQ(shared.rows[0].sure_weight, 0.5f * sure.rows[0].sure_weight);
  EXPECT_FLOAT_EQ(shared.rows[1].sure_weight, 0.5f * sure.rows[1].sure_weight);
}

// Its points are seen from one side: however many they are, they tell no more than one does.
TEST(NdtTerm, APostsPointsShareAnError) {
  constexpr auto kShared_m = static_cast<float>(NdtParameters::kSharedInWeightsStd_m);
  const NdtTerm term = MakeNdtTerm(Post(), {0, 0, 0}, 40.f, 0.f);
  EXPECT_FLOAT_EQ(term.rows[0].weight, 1.f / (2.f * 0.0004f + 40.f * kShared_m * kShared_m));
  EXPECT_FLOAT_EQ(term.rows[1].weight, 1.f / (2.f * 0.0025f + 40.f * kShared_m * kShared_m));
}

TEST(NdtTerm, APartOfAWallIsSureOnlyAcrossTheWall) {
  const NdtTerm post = MakeNdtTerm(Post(), {0.02f, 0.05f, 0}, 1.f, 0.f);
  SurfacePatch end_of_wall = Post();
  end_of_wall.tangent2_per_std = Eigen::Vector3f(0.6f, 0.8f, 0);
  const NdtTerm part = MakeNdtTerm(end_of_wall, {0.02f, 0.05f, 0}, 1.f, 0.f);
  const Eigen::Vector3f along_wall(-0.8f, 0.6f, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(post.rows[i].sure_direction, post.rows[i].direction);
    EXPECT_FLOAT_EQ(part.rows[i].weight, post.rows[i].weight);
    EXPECT_NEAR(part.rows[i].sure_direction.dot(along_wall), 0.f, 1e-6f);
    EXPECT_NEAR(part.rows[i].sure_direction.dot(end_of_wall.wall_normal()),
                post.rows[i].direction.dot(end_of_wall.wall_normal()), 1e-6f);
  }
}

}  // namespace
}  // namespace lio
