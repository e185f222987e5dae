// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names voxels by integers: three signed 21-bit coordinates packed into 64 bits. A hash of them is
// here, too.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lio {

using VoxelKey = std::uint64_t;

// |coordinate| is below this, in voxels. Arithmetic: three coordinates of 21 bits fit a 64-bit key.
inline constexpr std::int32_t kVoxelCoordinateLimit = 1 << 20;

// floor() without the library call: exact for |x| < 2^31, undefined for all other x and for NaN.
template <class Float>
[[nodiscard]] std::int32_t FloorToInt(Float x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - (x < static_cast<Float>(truncated) ? 1 : 0);
}

// Holds a voxel's coordinates along x, y, z.
using VoxelCell = std::array<std::int32_t, 3>;

// Can the voxel around a point be named, whose coordinates are given in voxel edges? Returns false
// for coordinates that are not numbers, too.
[[nodiscard]] inline bool IsVoxel(const Eigen::Vector3d& scaled) {
  return (scaled.array().abs() < kVoxelCoordinateLimit - 1).all();
}

// Returns the voxel around a point whose coordinates are given in voxel edges, clamped to the
// limit. A coordinate that is no number lies at the upper limit.
[[nodiscard]] inline VoxelCell VoxelOf(const Eigen::Vector3d& scaled) {
  const auto coordinate = [](double x) {
    constexpr double kLimit = kVoxelCoordinateLimit;
    return FloorToInt(std::max(-kLimit, std::min(kLimit, x)));  // this order turns NaN to kLimit
  };
  return {coordinate(scaled.x()), coordinate(scaled.y()), coordinate(scaled.z())};
}

// Maps keep voxels in blocks of this many along each edge. Arithmetic: a 64-bit mask has a bit for
// each of the 64 voxels.
inline constexpr int kBlockEdge = 4;
[[nodiscard]] inline VoxelCell BlockOf(const VoxelCell& voxel) {
  return {voxel[0] >> 2, voxel[1] >> 2, voxel[2] >> 2};
}

// A key holds x, y and z from its high end to its low one, each of this many bits. Arithmetic: they
// hold twice kVoxelCoordinateLimit.
inline constexpr int kVoxelBits = 21;
inline constexpr std::uint64_t kVoxelMask = (std::uint64_t{1} << kVoxelBits) - 1;

[[nodiscard]] inline VoxelKey PackVoxel(std::int32_t x, std::int32_t y, std::int32_t z) {
  return ((static_cast<std::uint64_t>(x + kVoxelCoordinateLimit) & kVoxelMask)
          << (2 * kVoxelBits)) |
         ((static_cast<std::uint64_t>(y + kVoxelCoordinateLimit) & kVoxelMask) << kVoxelBits) |
         (static_cast<std::uint64_t>(z + kVoxelCoordinateLimit) & kVoxelMask);
}

// Returns the voxel that PackVoxel() named so, given coordinates within the limit.
[[nodiscard]] inline VoxelCell UnpackVoxel(VoxelKey key) {
  const auto coordinate = [&](int shift) {
    return static_cast<std::int32_t>((key >> shift) & kVoxelMask) - kVoxelCoordinateLimit;
  };
  return {coordinate(2 * kVoxelBits), coordinate(kVoxelBits), coordinate(0)};
}

// Uses Fibonacci hashing. The product's high bits depend on all three coordinates, so they are
// brought to the low end, which tables take.
[[nodiscard]] inline std::uint64_t HashVoxel(VoxelKey key) {
  return __builtin_bswap64(key * 0x9E3779B97F4A7C15ull);
}

// Calls visit(x, y, z) for all voxels from `low` to `high`, both included, x fastest.
template <class Visit>
void ForEachVoxel(const VoxelCell& low, const VoxelCell& high, const Visit& visit) {
  for (std::int32_t z = low[2]; z <= high[2]; ++z) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t x = low[0]; x <= high[0]; ++x) visit(x, y, z);
    }
  }
}

}  // namespace lio
