// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lio::test {
namespace {

// Returns whether the ray, seen from above, passes within `radius` of a place or begins there.
bool PassesNear(const Vector3& place, double radius, const Vector3& origin,
                const Vector3& direction, double inverse_length_sq) {
  const Eigen::Vector2d to = (place - origin).head<2>();
  const double distance_sq = to.squaredNorm();
  const double along = to.dot(direction.head<2>());
  const double radius_sq = radius * radius;
  if (distance_sq <= radius_sq) return true;
  return along > 0 && distance_sq - along * along * inverse_length_sq <= radius_sq;
}

void CastBox(const RayBox& box, int object, const Vector3& origin, const Vector3& direction,
             Hit& best) {
  const Quaternion turn = ExpSo3(Vector3(0, 0, box.yaw_rad));
  const Vector3 o = turn.conjugate() * (origin - box.centre);
  const Vector3 d = turn.conjugate() * direction;
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) < 1e-12) {
      if (std::abs(o[i]) > box.half[i]) return;
      continue;
    }
    const double a = (-box.half[i] - o[i]) / d[i];
    const double b = (box.half[i] - o[i]) / d[i];
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      axis = i;
    }
    leave = std::min(leave, std::max(a, b));
  }
  if (axis < 0 || enter > leave || enter <= 0 || enter >= best.range_m) return;
  Vector3 normal = Vector3::Zero();
  normal[axis] = d[axis] > 0 ? -1.0 : 1.0;
  best = {enter, object, turn * normal};
}

void CastCylinder(const Cylinder& cylinder, int object, const Vector3& origin,
                  const Vector3& direction, Hit& best) {
  const Eigen::Vector2d o = (origin - cylinder.foot).head<2>();
  const Eigen::Vector2d d = direction.head<2>();
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double c = o.squaredNorm() - cylinder.radius_m * cylinder.radius_m;
  const double discriminant = b * b - a * c;
  if (a < 1e-12 || discriminant <= 0) return;
  const double range = (-b - std::sqrt(discriminant)) / a;
  const double z = origin.z() + range * direction.z() - cylinder.foot.z();
  if (range <= 0 || range >= best.range_m || z < 0 || z > cylinder.height_m) return;
  const Eigen::Vector2d normal = (o + range * d) / cylinder.radius_m;
  best = {range, object, Vector3(normal.x(), normal.y(), 0.0)};
}

}  // namespace

Hit RayScene::Cast(const Vector3& origin, const Vector3& direction) const {
  Hit best;
  if (ground_z_ && direction.z() < 0 && origin.z() > *ground_z_) {
    best = {(*ground_z_ - origin.z()) / direction.z(), ground_object_, Vector3::UnitZ()};
  }
  const double inverse_length_sq = 1.0 / std::max(direction.head<2>().squaredNorm(), 1e-12);
  for (const auto& [box, object] : boxes_) {
    const double radius = box.half.head<2>().norm();
    if (!PassesNear(box.centre, radius, origin, direction, inverse_length_sq)) continue;
    CastBox(box, object, origin, direction, best);
  }
  for (const auto& [cylinder, object] : cylinders_) {
    if (!PassesNear(cylinder.foot, cylinder.radius_m, origin, direction, inverse_length_sq)) {
      continue;
    }
    CastCylinder(cylinder, object, origin, direction, best);
  }
  return best;
}

RayCastSweep CastTurn(const RayScene& scene, const SpinningLidar& lidar,
                      const std::function<Pose(double)>& T_world_lidar, std::uint32_t seed) {
  RayCastSweep result;
  result.sweep.end = result.sweep.start + lidar.turn;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int column = 0; column < lidar.num_columns; ++column) {
    const double share = static_cast<double>(column) / lidar.num_columns;
    const double azimuth = lidar.start_azimuth_rad - 2.0 * std::numbers::pi * share;
    const Pose pose = T_world_lidar(share);
    for (std::size_t ring = 0; ring < lidar.elevation_rad.size(); ++ring) {
      const double elevation = lidar.elevation_rad[ring];
      const Vector3 direction(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Hit hit = scene.Cast(pose.translation, pose.rotation * direction);
      if (!(hit.range_m < lidar.max_range_m)) continue;
      const double range =
          hit.range_m + (lidar.range_std_m > 0 ? lidar.range_std_m * noise(random) : 0.0);
      const Eigen::Vector3f p = (range * direction).cast<float>();
      LidarPoint point;
      point.x_m = p.x();
      point.y_m = p.y();
      point.z_m = p.z();
      point.t_offset_ns = static_cast<std::uint32_t>(share * static_cast<double>(lidar.turn.ns));
      point.ring = static_cast<std::uint16_t>(ring);
      result.sweep.points.push_back(point);
      result.hits.push_back(hit);
    }
  }
  return result;
}

}  // namespace lio::test
