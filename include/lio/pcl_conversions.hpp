// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts clouds and poses between the estimator and PCL, for programs that use both. Header-only:
// whoever includes it finds and links PCL (components common), liod itself does not.
//
//   odometry.AddSweep(lio::SweepFromPcl(cloud, lio::StampFromPcl(cloud.header)));
//   pcl::transformPointCloud(cloud, cloud_world, lio::AffineFromPose(T_world_lidar));
//
// Works with every point type that has x, y, z [m]. Further members are used where the type has
// them: `intensity`, `ring` (0 is the lowest beam) and the point's own time, which is
//   `time`, floating point: seconds after the cloud's stamp, as velodyne_pointcloud publishes; or
//   `t`, an integer: nanoseconds after the cloud's stamp, as ouster_ros publishes.
// Other drivers name, count or scale it otherwise: give a function of the point for those.
#pragma once

#include <pcl/PCLHeader.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/lidar_sweep.hpp"

namespace lio {
namespace pcl_detail {

template <class Point>
concept HasSeconds = requires(const Point& p) {
  requires std::floating_point<decltype(p.time)>;
};
template <class Point>
concept HasNanoseconds = requires(const Point& p) {
  requires std::integral<decltype(p.t)>;
};
template <class Point>
concept HasAmbiguousTime =
    !HasSeconds<Point> && !HasNanoseconds<Point> &&
    (
        requires(const Point& p) { p.timestamp; } || requires(const Point& p) { p.time; } ||
        requires(const Point& p) { p.t; } || requires(const Point& p) { p.offset_time; } ||
        requires(const Point& p) { p.time_stamp; });

template <class Point>
LidarPoint ToLidarPoint(const Point& p) {
  LidarPoint point{.x_m = p.x, .y_m = p.y, .z_m = p.z};
  if constexpr (requires { p.intensity; }) {
    const auto intensity = static_cast<double>(p.intensity);
    point.intensity =
        intensity > 0.0 ? static_cast<std::uint16_t>(std::lround(std::min(intensity, 65535.0))) : 0;
  }
  if constexpr (requires { p.ring; }) point.ring = static_cast<std::uint16_t>(p.ring);
  return point;
}

}  // namespace pcl_detail

// PCL counts microseconds.
inline Timestamp StampFromPcl(const pcl::PCLHeader& header) {
  return Timestamp::FromMicroseconds(static_cast<std::int64_t>(header.stamp));
}

// `seconds_after_stamp(point)` tells when the point was measured, as a double; before `stamp` is
// negative. Points that are not finite are left out. Throws std::invalid_argument when the times
// span more than 4 s, which is a wrong unit. The result's stamp is that of its earliest point.
template <class Point, class SecondsAfterStamp>
LidarSweep SweepFromPcl(const pcl::PointCloud<Point>& cloud, Timestamp stamp,
                        SecondsAfterStamp&& seconds_after_stamp) {
  LidarSweep sweep{stamp, {}};
  sweep.points.reserve(cloud.size());
  std::vector<double> seconds;
  seconds.reserve(cloud.size());
  double first_s = std::numeric_limits<double>::infinity();
  double last_s = -first_s;
  for (const Point& p : cloud) {
    const double s = seconds_after_stamp(p);
    const bool is_finite =
        std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(s);
    if (!is_finite) continue;
    sweep.points.push_back(pcl_detail::ToLidarPoint(p));
    seconds.push_back(s);
    first_s = std::min(first_s, s);
    last_s = std::max(last_s, s);
  }
  if (sweep.points.empty()) return sweep;
  if (std::abs(first_s) > 1e9 || last_s - first_s > 4.0) {
    throw std::invalid_argument(
        "SweepFromPcl: the times of the points span more than 4 s; their unit must be wrong");
  }
  const Duration first = Duration::FromSeconds(first_s);
  sweep.stamp = stamp + first;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Duration offset = Duration::FromSeconds(seconds[i]) - first;
    sweep.points[i].t_offset_ns = static_cast<std::uint32_t>(offset.ns);
  }
  return sweep;
}

// The points keep the type's own time, see above. A type without one gives a sweep that was
// measured at once; its points must have been moved to where they are seen at `stamp` already.
template <class Point>
LidarSweep SweepFromPcl(const pcl::PointCloud<Point>& cloud, Timestamp stamp) {
  static_assert(!pcl_detail::HasAmbiguousTime<Point>,
                "the unit of this type's times is unknown: give SweepFromPcl a function of them");
  return SweepFromPcl(cloud, stamp, []([[maybe_unused]] const Point& p) {
    if constexpr (pcl_detail::HasSeconds<Point>) return static_cast<double>(p.time);
    if constexpr (pcl_detail::HasNanoseconds<Point>) return 1e-9 * static_cast<double>(p.t);
    return 0.0;
  });
}

// Returns points [m] as a cloud of any type with x, y, z; its other members keep their defaults.
template <class Point = pcl::PointXYZ>
pcl::PointCloud<Point> CloudToPcl(std::span<const Eigen::Vector3f> points) {
  pcl::PointCloud<Point> cloud;
  cloud.reserve(points.size());
  for (const Eigen::Vector3f& p : points) {
    Point point;
    point.x = p.x();
    point.y = p.y();
    point.z = p.z();
    cloud.push_back(point);
  }
  return cloud;
}

// Returns the transform from source to target for T_target_source, as pcl::transformPointCloud
// takes it.
inline Eigen::Affine3d AffineFromPose(const Pose& T_target_source) {
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.linear() = T_target_source.rotation.toRotationMatrix();
  affine.translation() = T_target_source.translation;
  return affine;
}

}  // namespace lio
