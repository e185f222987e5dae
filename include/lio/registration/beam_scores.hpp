// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores (gradients of a term's cost) summed by the beam's direction, as the lidar sees it. Errors
// that move with the sensor (biases of lasers, errors of the beam table and of the encoder, mixed
// pixels) pull a match the same way scan after scan, and the sums of one elevation or of one octant
// of the turn show by how much; a cell of the map (cluster_scores.hpp) meets too many beams for
// that.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lio/base/pose.hpp"

namespace lio {

class BeamScores {
 public:
  using Score = Eigen::Matrix<float, 6, 1>;
  // Bins of the sine of the elevation over -1..1, each 1 deg wide near the horizon. Chosen: the
  // beams of a VLP-16 are 2 deg apart.
  static constexpr int kElevations = 120;
  // Sectors of the turn, told by three signs. Measured: 24 of them give the same
  // (docs/experiments/sensor_fixed_errors.md).
  static constexpr int kOctants = 8;
  static constexpr std::size_t kNumDirections = kElevations + kOctants;

  // Forgets all scores. The lidar's place tells the elevation of a deskewed point's beam to some
  // tenths of a degree, more where the body moves by part of the point's range in a sweep.
  void Reset(const Pose& T_imu_lidar) {
    R_lidar_imu_ = T_imu_lidar.rotation.conjugate().toRotationMatrix().cast<float>();
    lidar_imu_ = T_imu_lidar.translation.cast<float>();
    for (Score& score : by_direction_) score.setZero();
  }

  // Each score counts once by its elevation and once by its octant.
  void Add(const Eigen::Vector3f& point_imu, const Score& score) {
    const Eigen::Vector3f view = R_lidar_imu_ * (point_imu - lidar_imu_);
    by_direction_[ElevationOf(view)] += score;
    by_direction_[kElevations + OctantOf(view)] += score;
  }

  // Returns the elevations' sums, then the octants'.
  [[nodiscard]] std::vector<Vector6> ByDirection() const {
    std::vector<Vector6> sums;
    sums.reserve(kNumDirections);
    for (const Score& sum : by_direction_) sums.push_back(sum.cast<double>());
    return sums;
  }

 private:
  static std::size_t ElevationOf(const Eigen::Vector3f& view) {
    constexpr float kHalf = 0.5f * kElevations;
    const float sine = view.z() / std::max(view.norm(), 1e-6f);
    return static_cast<std::size_t>(std::clamp(kHalf + kHalf * sine, 0.f, kElevations - 1.f));
  }
  static std::size_t OctantOf(const Eigen::Vector3f& view) {
    return (view.x() < 0.f ? 1u : 0u) + (view.y() < 0.f ? 2u : 0u) +
           (std::abs(view.x()) < std::abs(view.y()) ? 4u : 0u);
  }

  Eigen::Matrix3f R_lidar_imu_ = Eigen::Matrix3f::Identity();
  Eigen::Vector3f lidar_imu_ = Eigen::Vector3f::Zero();
  std::array<Score, kNumDirections> by_direction_{};
};

}  // namespace lio
