// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/ply_file.hpp"

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <fstream>
#include <stdexcept>

#include "lio/pcl_conversions.hpp"

namespace lio {

namespace {

// PCL refuses empty clouds.
bool WriteEmpty(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex 0\n"
          "property float x\nproperty float y\nproperty float z\nend_header\n";
  file.close();
  return static_cast<bool>(file);
}

bool WriteFull(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  constexpr bool kIsBinary = true;
  constexpr bool kHasCamera = false;  // an element that other programs do not know
  const pcl::PointCloud<pcl::PointXYZ> cloud = CloudToPcl(points);
  return pcl::PLYWriter().write(path.string(), cloud, kIsBinary, kHasCamera) == 0;
}

}  // namespace

void WritePly(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  const bool is_written = points.empty() ? WriteEmpty(path) : WriteFull(path, points);
  if (!is_written) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace lio
