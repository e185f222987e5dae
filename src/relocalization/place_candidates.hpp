// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives poses where a scan may be that was not found near its motion prior: after a time unseen, or
// after the lidar's clock was set.
#pragma once

#include <span>
#include <vector>

#include "lio/base/pose.hpp"

namespace lio {

// Holds a deskewed scan and its pose.
struct PlacedScan {
  std::span<const Eigen::Vector3f> points_imu;
  Pose T_map_imu;
};

// Returns candidate poses of `now`, best first, by the bird's-eye views of both scans. The search
// covers the prior `now.T_map_imu`, widened by its covariance `cov` (right error). The way
// from the earlier pose to there is searched besides if the body was unseen, and the earlier pose
// comes last: the body may have stopped, or the clock may have jumped. From one sweep to the next
// it cannot have, and the earlier pose is where rings on the ground would have it. Roll, pitch and
// height are taken from the earlier pose and the prior.
[[nodiscard]] std::vector<Pose> PlaceCandidates(const PlacedScan& earlier, const PlacedScan& now,
                                                const Matrix6& cov, const Quaternion& R_level_map,
                                                bool was_unseen);

// Returns the rotation R_level_map that turns up in the map to z.
[[nodiscard]] Quaternion LevelFromMap(const Vector3& up_map);

// Returns the points in axes whose z is up; the origin stays at the sensor.
[[nodiscard]] std::vector<Eigen::Vector3f> Levelled(std::span<const Eigen::Vector3f> points_imu,
                                                    const Quaternion& R_level_imu);

}  // namespace lio
