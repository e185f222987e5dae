// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes and reads point clouds as PCD files, which every viewer of point clouds opens.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

namespace lio {

// The file is binary, with the fields x y z [m]; an existing one is overwritten. Throws OutputError
// naming the file when it cannot, WriteError when it cannot be written in full.
void WritePcd(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points);

// Returns the points of any PCD file with x, y and z. Throws std::runtime_error naming the file
// when it cannot be read.
[[nodiscard]] std::vector<Eigen::Vector3f> LoadPcd(const std::filesystem::path& path);

}  // namespace lio
