// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a matcher of the method ndt in a world that a lidar sees.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "lio/registration/ndt_matcher.hpp"
#include "support/scene.hpp"

namespace lio::test {

using Points = std::vector<Eigen::Vector3f>;

// The vehicle goes along a straight, level road, 1 m between two scans.
inline Pose OnRoad(double x_m, double y_m = 5.0) {
  Pose pose;
  pose.translation = Vector3(x_m, y_m, 0.0);
  pose.rotation = ExpSo3(Vector3(0, 0, 0.01 * x_m));
  return pose;
}

// Returns the right error of the match.
inline Vector6 ErrorOf(const MatchResult& result, const Pose& truth) {
  return LogSe3(truth.Inverse() * result.T_map_imu);
}

// Holds a world, a lidar in it, and a matcher with a map of its scans.
class NdtMatcherIn {
 public:
  explicit NdtMatcherIn(const Scene& scene) : scene_(scene) {}

  Points See(const Pose& T_world_imu) { return CastStill(scene_, lidar_, T_world_imu, random_); }
  void InsertFrom(const Pose& T_world_imu) { matcher_.Insert({See(T_world_imu)}, T_world_imu); }
  void Insert(const Points& points, const Pose& T_world_imu) {
    matcher_.Insert({points}, T_world_imu);
  }
  void InsertRoad(double from_m, double to_m) {
    for (double x = from_m; x <= to_m; x += 1.0) InsertFrom(OnRoad(x));
  }
  MatchResult MatchFrom(const Pose& T_world_imu, const Vector6& guess_error, double guess_std) {
    return Match(See(T_world_imu), T_world_imu * ExpSe3(guess_error), guess_std);
  }
  // The scan as a turn rate deskewed it that is wrong by this much over half a sweep, matched from
  // the guess of that rate.
  MatchResult MatchBent(const Pose& T_world_imu, double yaw_error_rad, bool bends) {
    Points points = See(T_world_imu);
    Vector6 error = Vector6::Zero();
    error[5] = yaw_error_rad;
    std::vector<float> shares;
    for (Eigen::Vector3f& point : points) {
      const double share = 1.0 + std::atan2(point.y(), point.x()) / (2.0 * std::numbers::pi);
      point = (ExpSe3((1.0 - share) * error) * point.cast<double>()).cast<float>();
      shares.push_back(static_cast<float>(share));
    }
    MatchInput input{points, T_world_imu * ExpSe3(-error), 0.01 * Matrix6::Identity()};
    input.is_far_off = true;
    if (bends) input.shares_of_correction = shares;
    return matcher_.Match(input);
  }
  MatchResult Match(const Points& points, const Pose& guess, double guess_std) {
    Matrix6 cov = Matrix6::Zero();
    cov.topLeftCorner<3, 3>() = guess_std * guess_std * Matrix3::Identity();
    cov.bottomRightCorner<3, 3>() = 0.0025 * guess_std * guess_std * Matrix3::Identity();
    MatchInput input{points, guess, cov};
    input.shift_std_m = shift_std_m;
    return matcher_.Match(input);
  }

  // For the next matches; vertical structures are left out where it is small.
  double shift_std_m = 1.0;

  NdtMatcher& matcher() { return matcher_; }
  std::mt19937_64& random() { return random_; }

 private:
  Scene scene_;
  Lidar lidar_ = TestLidar();
  std::mt19937_64 random_{11};
  NdtMatcher matcher_{NdtOptions{}};
};

}  // namespace lio::test
