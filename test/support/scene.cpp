// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/scene.hpp"

#include <algorithm>
#include <cmath>

namespace lio::test {
namespace {

constexpr double kImuHeight_m = 1.0;

// Returns the distance at which the ray enters the box; absent when it misses or starts inside.
std::optional<double> CastBox(const Vector3& origin, const Vector3& direction,
                              const Vector3& half_size) {
  double enter = 0.0;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / direction[axis];  // infinite for a parallel ray, which works
    const double a = (-half_size[axis] - origin[axis]) * inverse;
    const double b = (half_size[axis] - origin[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter <= 0.0 || enter > leave) return std::nullopt;
  return enter;
}

double Uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

LidarPoint ToPoint(const Vector3& position, int ring) {
  LidarPoint point;
  point.x_m = static_cast<float>(position.x());
  point.y_m = static_cast<float>(position.y());
  point.z_m = static_cast<float>(position.z());
  point.ring = static_cast<std::uint16_t>(ring);
  return point;
}

// Calls `take(azimuth index, point)` for each return of one turn; `pose_at(azimuth index)` gives
// the pose of the imu in world.
template <class PoseAt, class Take>
void CastTurn(const Scene& scene, const Lidar& lidar, std::mt19937_64& random,
              const PoseAt& pose_at, const Take& take) {
  std::normal_distribution<double> noise(0.0, lidar.range_std_m);
  for (int i = 0; i < lidar.num_azimuths; ++i) {
    const Pose T_world_lidar = pose_at(i) * lidar.T_imu_lidar;
    const double azimuth = -2.0 * M_PI * i / lidar.num_azimuths;
    for (std::size_t ring = 0; ring < lidar.elevations_rad.size(); ++ring) {
      const double elevation = lidar.elevations_rad[ring];
      const Vector3 beam(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const auto range =
          scene.Cast(T_world_lidar.translation, T_world_lidar.rotation * beam, lidar.max_range_m);
      if (range) take(i, ToPoint((*range + noise(random)) * beam, static_cast<int>(ring)));
    }
  }
}

}  // namespace

Scene::Scene(double ground_z_m, const std::vector<Box>& boxes) : ground_z_m_(ground_z_m) {
  for (const Box& box : boxes) {
    boxes_.push_back({box.centre, box.half_size, std::cos(box.yaw_rad), std::sin(box.yaw_rad),
                      box.half_size.head<2>().norm()});
  }
}

std::optional<double> Scene::Cast(const Vector3& origin, const Vector3& direction,
                                  double max_range_m) const {
  double nearest = max_range_m;
  if (direction.z() < 0) nearest = std::min(nearest, (ground_z_m_ - origin.z()) / direction.z());
  for (const TurnedBox& box : boxes_) {
    const Vector3 offset = origin - box.centre;
    const double aside = offset.x() * direction.y() - offset.y() * direction.x();
    if (std::abs(aside) > box.radius_m) continue;
    const auto turn = [&](const Vector3& v) {
      return Vector3(box.cosine * v.x() + box.sine * v.y(), -box.sine * v.x() + box.cosine * v.y(),
                     v.z());
    };
    if (const auto range = CastBox(turn(offset), turn(direction), box.half_size)) {
      nearest = std::min(nearest, *range);
    }
  }
  if (nearest >= max_range_m) return std::nullopt;
  return nearest;
}

Scene Street() {
  std::mt19937_64 random(7);
  std::vector<Box> boxes;
  for (const double side : {-1.0, 1.0}) {
    const double kerb_y = side < 0 ? -6.0 : 16.0;
    for (double x = -60.0; x < 200.0; x += Uniform(random, 9.0, 16.0)) {
      const double depth = Uniform(random, 3.0, 5.0);
      const double height = Uniform(random, 2.5, 6.0);
      boxes.push_back({{x, kerb_y + side * (depth + Uniform(random, 1.0, 4.0)), height - 1.0},
                       {Uniform(random, 2.5, 5.0), depth, height},
                       Uniform(random, -0.2, 0.2)});
    }
    for (double x = -50.0; x < 200.0; x += Uniform(random, 8.0, 20.0)) {
      boxes.push_back({{x, kerb_y, -0.3}, {2.1, 0.9, 0.7}, Uniform(random, -0.05, 0.05)});
    }
    for (double x = -55.0; x < 200.0; x += Uniform(random, 15.0, 25.0)) {
      boxes.push_back({{x, kerb_y - 1.2 * side, 2.0}, {0.15, 0.15, 3.0}, Uniform(random, 0, 1.5)});
    }
  }
  return {-kImuHeight_m, boxes};
}

Scene Corridor() {
  const Vector3 half_size(1e4, 0.5, 20.0);
  return {-kImuHeight_m, {{{0, 4.5, 0}, half_size}, {{0, -4.5, 0}, half_size}}};
}

Scene RoadWithPosts() {
  std::mt19937_64 random(9);
  std::vector<Box> boxes;
  for (double x = -60.0; x < 200.0; x += Uniform(random, 2.0, 5.0)) {
    const double y = Uniform(random, 4.0, 12.0);
    const double y_signed = Uniform(random, -1.0, 1.0) < 0 ? -y : y;
    boxes.push_back({{x, y_signed, 1.0}, {0.12, 0.12, 2.0}, Uniform(random, 0, 1.5)});
  }
  return {-kImuHeight_m, boxes};
}

Lidar TestLidar() {
  Lidar lidar;
  constexpr int kBeams = 20;
  for (int i = 0; i < kBeams; ++i) {
    lidar.elevations_rad.push_back((-24.0 + 32.0 * i / (kBeams - 1)) * M_PI / 180.0);
  }
  lidar.T_imu_lidar.translation = Vector3(0.3, -0.1, 0.7);
  lidar.T_imu_lidar.rotation = ExpSo3(Vector3(0.02, -0.03, 0.5));
  return lidar;
}

std::vector<LidarPoint> CastSweep(const Scene& scene, const Lidar& lidar, const Motion& motion,
                                  double start_s, std::mt19937_64& random) {
  const double firing_s = lidar.period_s / lidar.num_azimuths;
  std::vector<LidarPoint> points;
  CastTurn(
      scene, lidar, random, [&](int i) { return motion(start_s + i * firing_s); },
      [&](int i, LidarPoint point) {
        point.t_offset_ns = static_cast<std::uint32_t>(std::lround(1e9 * i * firing_s));
        points.push_back(point);
      });
  return points;
}

std::vector<Eigen::Vector3f> CastStill(const Scene& scene, const Lidar& lidar,
                                       const Pose& T_world_imu, std::mt19937_64& random) {
  std::vector<Eigen::Vector3f> points;
  CastTurn(
      scene, lidar, random, [&](int) { return T_world_imu; },
      [&](int, const LidarPoint& point) {
        const Vector3 position(point.x_m, point.y_m, point.z_m);
        points.push_back((lidar.T_imu_lidar * position).cast<float>());
      });
  return points;
}

}  // namespace lio::test
