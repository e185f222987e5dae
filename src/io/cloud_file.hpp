// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads point clouds from files of PCL, without a word on the console.
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lio {

enum class CloudKind : std::int8_t { kOther, kPcd, kPly };

// Returns the kind that a file's first words tell.
[[nodiscard]] CloudKind KindOfCloud(const std::filesystem::path& path);

// Returns a PCD or PLY file with all its fields; absent where it cannot be read as that.
[[nodiscard]] std::optional<pcl::PCLPointCloud2> ReadCloud(const std::filesystem::path& path,
                                                           CloudKind kind);

// x, y and z of all points, those that are not finite included. Needs these fields as floats.
[[nodiscard]] std::vector<Eigen::Vector3f> PointsOf(const pcl::PCLPointCloud2& cloud);

// Writes the header and, behind it, x, y and z of each point as floats, lowest byte first. Throws
// as OutputFile does.
void WriteCloud(const std::filesystem::path& path, const std::string& header,
                std::span<const Eigen::Vector3f> points);

}  // namespace lio
