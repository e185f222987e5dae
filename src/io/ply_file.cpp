// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/ply_file.hpp"

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <stdexcept>

#include "lio/pcl_conversions.hpp"

namespace lio {

void WritePly(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  constexpr bool kIsBinary = true;
  constexpr bool kHasCamera = false;  // an element that other programs do not know
  try {
    const pcl::PointCloud<pcl::PointXYZ> cloud = CloudToPcl(points);
    if (pcl::PLYWriter().write(path.string(), cloud, kIsBinary, kHasCamera) == 0) return;
  } catch (const std::exception&) {
    // Told below, with the file's name.
  }
  throw std::runtime_error("cannot write " + path.string());
}

}  // namespace lio
