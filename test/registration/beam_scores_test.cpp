// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/beam_scores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lio {
namespace {

BeamScores::Score Ones() {
  return BeamScores::Score::Ones();
}

Eigen::Vector3f PointAt(double azimuth_deg, double elevation_deg, double range_m) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
  const double elevation = elevation_deg * std::numbers::pi / 180.0;
  return Vector3(range_m * Vector3(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
      .cast<float>();
}

std::vector<double> FirstEntries(const BeamScores& scores) {
  std::vector<double> entries;
  for (const Vector6& score : scores.ByDirection()) {
    if (!score.isZero(0.0)) entries.push_back(score[0]);
  }
  return entries;
}

TEST(BeamScores, ARingsPointsAreOneSumAndEachOctantsAreOne) {
  BeamScores scores;
  scores.Reset(Pose::Identity());
  for (int azimuth_deg = 5; azimuth_deg < 360; azimuth_deg += 15) {
    scores.Add(PointAt(azimuth_deg, -7.5, 3.0 + azimuth_deg), Ones());
  }
  EXPECT_EQ(FirstEntries(scores), std::vector<double>({24, 3, 3, 3, 3, 3, 3, 3, 3}));
}

TEST(BeamScores, RingsTwoDegreesApartAreTwoSums) {
  BeamScores scores;
  scores.Reset(Pose::Identity());
  for (const double elevation_deg : {-15.0, -13.0, -1.0, 1.0, 13.0, 15.0}) {
    scores.Add(PointAt(10.0, elevation_deg, 20.0), Ones());
  }
  EXPECT_EQ(FirstEntries(scores), std::vector<double>({1, 1, 1, 1, 1, 1, 6}));
}

TEST(BeamScores, DirectionsAreThoseThatTheLidarSees) {
  const Pose T_imu_lidar{ExpSo3(Vector3(0.0, 0.7, 0.0)), Vector3(1.0, -2.0, 0.5)};
  BeamScores scores;
  scores.Reset(T_imu_lidar);
  for (const double azimuth_deg : {10.0, 100.0, 190.0, 280.0}) {
    const Vector3 point_lidar = PointAt(azimuth_deg, 4.5, 8.0).cast<double>();
    scores.Add((T_imu_lidar * point_lidar).cast<float>(), Ones());
  }
  EXPECT_EQ(FirstEntries(scores), std::vector<double>({4, 1, 1, 1, 1}));
}

TEST(BeamScores, AResetForgetsAndAPointAtTheLidarHarmsNothing) {
  BeamScores scores;
  scores.Reset(Pose::Identity());
  scores.Add(Eigen::Vector3f::Zero(), Ones());
  scores.Add(PointAt(0.0, 90.0, 1.0), Ones());
  scores.Add(PointAt(0.0, -90.0, 1.0), Ones());
  EXPECT_FALSE(FirstEntries(scores).empty());
  scores.Reset(Pose::Identity());
  EXPECT_TRUE(FirstEntries(scores).empty());
}

}  // namespace
}  // namespace lio
