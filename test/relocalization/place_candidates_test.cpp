// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_candidates.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace lio {
namespace {

// Returns posts at random places, as a body at the pose sees them.
std::vector<Eigen::Vector3f> Wood(const Pose& T_map_imu) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 80; ++i) {
    const double x = coordinate(random);
    const double y = coordinate(random);
    for (double z = -1.8; z < 0.6; z += 0.3) {
      points.push_back((T_map_imu.Inverse() * Vector3(x, y, z)).cast<float>());
    }
  }
  return points;
}

TEST(PlaceCandidates, AreWhereTheViewsAgreeAndAtLastWhereItWas) {
  const Pose earlier{ExpSo3(Vector3(0, 0, 0.5)), Vector3(1, 2, 0)};
  const Pose now{ExpSo3(Vector3(0, 0, 1.1)), Vector3(8, -1, 0)};
  const Pose expected{ExpSo3(Vector3(0, 0, 0.9)), Vector3(9.5, 0.5, 0)};
  const auto points_then = Wood(earlier);
  const auto points_now = Wood(now);
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << Vector3::Constant(2.0), Vector3::Constant(0.04);
  const std::vector<Pose> guesses =
      PlaceCandidates({points_then, earlier}, {points_now, expected}, cov, Quaternion::Identity());
  ASSERT_GE(guesses.size(), 2u);
  const Pose error = now.Inverse() * guesses.front();
  EXPECT_LT(error.translation.norm(), 0.5);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.03);
  EXPECT_EQ(guesses.back().translation, earlier.translation);
}

TEST(PlaceCandidates, OfBareGroundAreOnlyWhereItWas) {
  const std::vector<Eigen::Vector3f> ground{{5.f, 0.f, -1.8f}, {0.f, 5.f, -1.8f}};
  const std::vector<Pose> guesses = PlaceCandidates(
      {ground, Pose{}}, {ground, Pose{}}, Matrix6::Identity(), LevelFromMap(Vector3::UnitZ()));
  EXPECT_EQ(guesses.size(), 1u);
}

}  // namespace
}  // namespace lio
