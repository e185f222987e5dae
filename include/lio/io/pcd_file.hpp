// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes point clouds as PCD files, which every viewer of point clouds opens.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>

namespace lio {

// The file is binary, with the fields x y z [m]; an existing one is overwritten. Throws
// std::runtime_error naming the file when it cannot.
void WritePcd(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points);

}  // namespace lio
