// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/full_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "lio/io/lcm_codec.hpp"
#include "lio/scan/deskew.hpp"

namespace lio {
namespace {

constexpr std::int8_t kRegistered = -1;  // scan_t.SENSOR_REGISTERED

std::vector<LidarPoint> FinitePoints(const std::vector<LidarPoint>& points) {
  std::vector<LidarPoint> finite;
  finite.reserve(points.size());
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite), [](const LidarPoint& p) {
    return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m);
  });
  return finite;
}

}  // namespace

std::vector<ScanChunk> RegisterFullCloud(const FullCloudTask& task) {
  const Sweep& sweep = *task.sweep;
  std::vector<LidarPoint> points = FinitePoints(sweep.points);
  std::vector<ScanPoint> positions;
  positions.reserve(points.size());
  for (const LidarPoint& p : points) positions.push_back({{p.x_m, p.y_m, p.z_m}, p.t_offset_ns});
  const std::vector<Eigen::Vector3f> points_imu =
      Deskew(positions, {sweep.start, sweep.end, sweep.middle()}, task.T_any_imu, task.T_imu_lidar);
  const Eigen::Matrix3f rotation = task.T_map_imu.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = task.T_map_imu.translation.cast<float>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f point_map = rotation * points_imu[i] + translation;
    points[i].x_m = point_map.x();
    points[i].y_m = point_map.y();
    points[i].z_m = point_map.z();
  }
  std::vector<ScanChunk> chunks;
  const std::size_t num_chunks = (points.size() + kMaxChunkPoints - 1) / kMaxChunkPoints;
  for (std::size_t i = 0; i < num_chunks; ++i) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i * kMaxChunkPoints);
    const auto size = std::min<std::ptrdiff_t>(kMaxChunkPoints, points.end() - begin);
    chunks.push_back({sweep.start,
                      sweep.scan_seq,
                      static_cast<std::int16_t>(i),
                      static_cast<std::int16_t>(num_chunks),
                      kRegistered,
                      {begin, begin + size}});
  }
  return chunks;
}

}  // namespace lio
