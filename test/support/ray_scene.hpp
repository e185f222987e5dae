// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Casts rays exactly in a small analytic world of ground, boxes and vertical cylinders, with a
// spinning lidar, for tests that need to know where every return comes from.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/scan/sweep.hpp"

namespace lio::test {

struct Hit {
  double range_m = std::numeric_limits<double>::infinity();
  int object = -1;                   // index as added; the ground is object 0 if it was added first
  Vector3 normal = Vector3::Zero();  // outward
};

// The box is turned about z by `yaw_rad` and stands on `centre`'s xy.
struct RayBox {
  Vector3 centre = Vector3::Zero();
  Vector3 half = Vector3::Ones();
  double yaw_rad = 0.0;
};

struct Cylinder {
  Vector3 foot = Vector3::Zero();
  double radius_m = 0.1;
  double height_m = 3.0;
};

class RayScene {
 public:
  int AddGround(double z_m) {
    ground_z_ = z_m;
    ground_object_ = num_objects_++;
    return ground_object_;
  }
  int Add(const RayBox& box) {
    boxes_.push_back({box, num_objects_});
    return num_objects_++;
  }
  int Add(const Cylinder& cylinder) {
    cylinders_.push_back({cylinder, num_objects_});
    return num_objects_++;
  }

  // Returns the first surface on the ray; `direction` has length one.
  Hit Cast(const Vector3& origin, const Vector3& direction) const;

 private:
  std::optional<double> ground_z_;
  int ground_object_ = -1;
  std::vector<std::pair<RayBox, int>> boxes_;
  std::vector<std::pair<Cylinder, int>> cylinders_;
  int num_objects_ = 0;
};

struct SpinningLidar {
  std::vector<double> elevation_rad;  // lowest first
  int num_columns = 1800;             // per turn
  double start_azimuth_rad = 0.0;     // the turn goes clockwise from here
  double max_range_m = 100.0;
  double range_std_m = 0.0;
  Duration turn{100'000'000};

  static SpinningLidar Hdl32e() {
    SpinningLidar lidar;
    for (int i = 0; i < 32; ++i) {
      lidar.elevation_rad.push_back((-92.0 / 3.0 + 4.0 / 3.0 * i) * std::numbers::pi / 180.0);
    }
    return lidar;
  }
};

struct RayCastSweep {
  Sweep sweep;
  std::vector<Hit> hits;  // one per point
};

// Casts one turn in the order of firing, column by column. `T_world_lidar` gives the sensor's pose
// at a share 0..1 of the turn. Beams without a return give no point.
RayCastSweep CastTurn(const RayScene& scene, const SpinningLidar& lidar,
                      const std::function<Pose(double)>& T_world_lidar, std::uint32_t seed = 1);

inline RayCastSweep CastTurn(const RayScene& scene, const SpinningLidar& lidar,
                             const Pose& T_world_lidar, std::uint32_t seed = 1) {
  return CastTurn(
      scene, lidar, [&](double) { return T_world_lidar; }, seed);
}

}  // namespace lio::test
