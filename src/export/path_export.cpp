// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the path as TUM, and the map's points as PLY.
#include "export/output_reader.hpp"
#include "lio/io/map_cloud.hpp"
#include "lio/io/ply_file.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {

ExportCounts ExportTum(const std::filesystem::path& log, const std::filesystem::path& file,
                       const ExportOptions& options) {
  StampedPoses poses;
  OutputTakers takers;
  takers.odometry = [&](const NavOutput& nav, Timestamp) {
    if (poses.empty() || nav.stamp > poses.back().stamp) {
      poses.push_back({nav.stamp, nav.T_world_imu});
    }
  };
  const ExportCounts counts = ReadOutputs(log, options, takers);
  WriteTum(file, poses);
  return counts;
}

ExportCounts ExportPly(const std::filesystem::path& log, const std::filesystem::path& file,
                       const ExportOptions& options) {
  MapCloud map;
  OutputTakers takers;
  std::vector<Eigen::Vector3f> points;
  takers.cloud = [&](const ScanChunk& chunk, Timestamp) {
    points.clear();
    for (const LidarPoint& p : chunk.points) {
      const Eigen::Vector3f point(p.x_m, p.y_m, p.z_m);
      if (point.allFinite()) points.push_back(point);
    }
    map.Add(points, Pose::Identity());
  };
  ExportCounts counts = ReadOutputs(log, options, takers);
  counts.num_points = static_cast<std::int64_t>(map.points_map().size());
  WritePly(file, map.points_map());
  return counts;
}

}  // namespace lio
