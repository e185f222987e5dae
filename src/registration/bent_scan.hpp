// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Bends a scan so that its deskew follows the pose that is found. An error of a guessed motion both
// moves the scan and bends it, and a rigid scan that is bent matches nothing. Here the pose of each
// point's own instant takes its share of the correction (J. Dellenbach et al., "CT-ICP: Real-time
// Elastic LiDAR Odometry with Loop Closure", ICRA 2022, does so with a pose at either end of the
// sweep).
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "lio/registration/scan_matcher.hpp"

namespace lio {

class BentScan {
 public:
  // Borrows the input's points and shares; without shares the scan is rigid.
  explicit BentScan(const MatchInput& input);

  // Returns the input, with its points as they are seen when the guess is corrected to this pose.
  [[nodiscard]] const MatchInput& At(const Pose& T_guess_imu);

 private:
  // The share has so many steps, whose points take one pose each. Chosen: with a correction of 3
  // deg a point at 10 m is off by 2 mm then, below the range noise.
  static constexpr std::size_t kNumSteps = 128;

  std::span<const Eigen::Vector3f> points_imu_;
  std::span<const float> shares_;
  float least_share_ = 0.f;
  float steps_per_share_ = 0.f;
  std::vector<Eigen::Vector3f> bent_imu_;
  MatchInput input_;
};

}  // namespace lio
