// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes clouds as PLY files, for programs that edit meshes and clouds (MeshLab, CloudCompare,
// Blender).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>

namespace lio {

// Writes binary, one element `vertex` of the floats x y z [m]. Overwrites an existing file. Throws
// OutputError naming the file when it cannot be created, WriteError when it cannot be written in
// full.
void WritePly(const std::filesystem::path& path, std::span<const Eigen::Vector3f> points);

}  // namespace lio
