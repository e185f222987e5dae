// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/ply_file.hpp"

#include <fmt/format.h>

#include "io/cloud_file.hpp"

namespace lio {

void WritePly(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points) {
  WriteCloud(path,
             fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                         "property float x\nproperty float y\nproperty float z\nend_header\n",
                         points.size()),
             points);
}

}  // namespace lio
