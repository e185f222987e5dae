// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Samples a share of the points of a large sweep. The choice does not depend on their order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "lio/scan/sweep.hpp"
#include "scan/scan_parameters.hpp"

namespace lio {

// Defines a total order on points, so that ties do not depend on the order of arrival.
inline bool Precedes(const LidarPoint& a, const LidarPoint& b) {
  if (a.t_offset_ns != b.t_offset_ns) return a.t_offset_ns < b.t_offset_ns;
  if (a.ring != b.ring) return a.ring < b.ring;
  if (a.x_m != b.x_m) return a.x_m < b.x_m;
  if (a.y_m != b.y_m) return a.y_m < b.y_m;
  return a.z_m < b.z_m;
}

inline constexpr std::size_t kMaxSampled = kScanParameters.thinning.max_sampled;

// Returns a hash in 0..65535 of the point's time and ring; of its position, too, in clouds without
// times, because otherwise whole rings would be drawn.
inline std::uint32_t Sample(const LidarPoint& point) {
  std::uint32_t name = point.t_offset_ns + 0x9E3779B9u * (point.ring + 1u);
  if (point.t_offset_ns == 0) {
    const std::uint32_t place = std::bit_cast<std::uint32_t>(point.x_m) * 0x27D4EB2Fu;
    name ^= place ^ (place >> 15);
  }
  const std::uint32_t mixed = name * 0x85EBCA6Bu;
  return (mixed ^ (mixed >> 15)) * 0xC2B2AE35u >> 16;
}

// Points whose sample is below this are used.
inline std::uint32_t SampleShare(std::size_t num_points) {
  if (num_points <= kMaxSampled) return 1u << 16;
  return static_cast<std::uint32_t>((kMaxSampled << 16) / num_points);
}

}  // namespace lio
