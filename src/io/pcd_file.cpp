// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/pcd_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "cloud_file.hpp"

namespace lio {

void WritePcd(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  // PCL reads no empty cloud in binary form.
  WriteCloud(path,
             fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\n"
                         "SIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\n"
                         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA {1}\n",
                         points.size(), points.empty() ? "ascii" : "binary"),
             points);
}

std::vector<Eigen::Vector3f> LoadPcd(const std::filesystem::path& path) {
  const auto cloud = ReadCloud(path, CloudKind::kPcd);
  if (!cloud) throw std::runtime_error("cannot read " + path.string() + " as a PCD file");
  return PointsOf(*cloud);
}

}  // namespace lio
