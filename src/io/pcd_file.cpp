// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/pcd_file.hpp"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <stdexcept>

#include "cloud_file.hpp"

namespace lio {

void WritePcd(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.reserve(points.size());
  for (const Eigen::Vector3f& p : points) cloud.push_back({p.x(), p.y(), p.z()});
  try {
    // PCL refuses empty clouds in binary form.
    const bool is_written = points.empty()
                                ? pcl::PCDWriter().writeASCII(path.string(), cloud) == 0
                                : pcl::PCDWriter().writeBinary(path.string(), cloud) == 0;
    if (is_written) return;
  } catch (const pcl::IOException&) {
    // The error below names the file.
  }
  throw std::runtime_error("cannot write " + path.string());
}

std::vector<Eigen::Vector3f> LoadPcd(const std::filesystem::path& path) {
  const auto cloud = ReadCloud(path, CloudKind::kPcd);
  if (!cloud) throw std::runtime_error("cannot read " + path.string() + " as a PCD file");
  return PointsOf(*cloud);
}

}  // namespace lio
