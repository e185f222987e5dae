// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where a scan may be that was not found where it was expected: after time unseen, or after the
// lidar's clock was set.
#pragma once

#include <span>
#include <vector>

#include "lio/base/pose.hpp"

namespace lio {

// A deskewed scan and where it is.
struct PlacedScan {
  std::span<const Eigen::Vector3f> points_imu;
  Pose T_map_imu;
};

// Best first: by the bird's-eye views of both, between the earlier place and where `now` is
// expected and around them by what is not known of that (`cov`, right error); at last the earlier
// place itself, for the clock may have jumped. How the body leans is taken to be as it was.
std::vector<Pose> GuessPlaces(const PlacedScan& earlier, const PlacedScan& now, const Matrix6& cov,
                              const Quaternion& R_level_map);

// The rotation that takes up in the map to z.
Quaternion LevelOf(const Vector3& up_map);

// What such a guess may be off by, right error.
Matrix6 GuessedPlaceCov();

// To axes whose z is up; the origin stays at the sensor.
std::vector<Eigen::Vector3f> Levelled(std::span<const Eigen::Vector3f> points_imu,
                                      const Quaternion& R_level_imu);

}  // namespace lio
