// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a small world of a flat ground and boxes, and a lidar in it: rays are cast analytically,
// each from the sensor's pose at its own instant.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "support/motion.hpp"

namespace lio::test {

struct Box {
  Vector3 centre;
  Vector3 half_size;
  double yaw_rad = 0.0;
};

class Scene {
 public:
  Scene(double ground_z_m, const std::vector<Box>& boxes);

  // Returns the distance along the unit vector `direction` to the nearest surface.
  std::optional<double> Cast(const Vector3& origin, const Vector3& direction,
                             double max_range_m) const;

 private:
  struct TurnedBox {
    Vector3 centre;
    Vector3 half_size;
    double cosine = 1.0;
    double sine = 0.0;
    double radius_m = 0.0;  // around its axis, seen from above
  };
  double ground_z_m_;
  std::vector<TurnedBox> boxes_;
};

// Makes houses, parked cars and poles on both sides of the road that WindingDrive() takes, x from
// -60 to 200 m. The imu drives 1 m above the ground.
Scene Street();
// Makes two endless plain walls along x, 4 m to either side, and the ground.
Scene Corridor();

// Makes open ground with posts in no order beside the road.
Scene RoadWithPosts();

struct Lidar {
  std::vector<double> elevations_rad;
  int num_azimuths = 300;
  double period_s = 0.1;
  double max_range_m = 80.0;
  double range_std_m = 0.01;
  Pose T_imu_lidar;
};
// Has 20 beams from -24 to +8 degrees, and is mounted turned and off the imu.
Lidar TestLidar();

// Returns the points of one turn of the lidar from `start_s` on, with offsets from there.
std::vector<LidarPoint> CastSweep(const Scene& scene, const Lidar& lidar, const Motion& motion,
                                  double start_s, std::mt19937_64& random);
// Returns the points of one turn without motion, in the imu frame.
std::vector<Eigen::Vector3f> CastStill(const Scene& scene, const Lidar& lidar,
                                       const Pose& T_world_imu, std::mt19937_64& random);

}  // namespace lio::test
