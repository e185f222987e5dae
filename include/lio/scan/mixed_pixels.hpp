// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds mixed pixels: returns of a beam that straddled an edge, which lie somewhere between the two
// surfaces and move with the sensor.
//
// A return is one when its neighbours on the ring, the beams before and after it, lie well nearer
// and well farther than itself, and it continues neither's surface: on a plane the inverse of the
// range runs evenly with the angle, so that a surface seen at grazing incidence continues. Lidar
// frame, metres. Nothing throws.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lio/scan/sweep.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

class MixedPixelFinder {
 public:
  // Takes a sweep, whose points stay borrowed until the next call. Their order does not matter. A
  // sweep without rings has no neighbours and no mixed pixels.
  void Load(const Sweep& sweep);
  [[nodiscard]] bool IsMixed(std::uint32_t index) const;
  // Returns how much farther a point is than the plane through its neighbours on the ring [m];
  // absent where it has not both.
  [[nodiscard]] std::optional<float> OffsetFromPlane(std::uint32_t index) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  struct Neighbours {
    std::uint32_t before = kNone;
    std::uint32_t after = kNone;
  };

  bool LinkAsSent();  // false: some ring's points do not come by time
  void LinkByOrder();
  [[nodiscard]] float RangeBeside(const Eigen::Vector3f& direction, std::uint32_t index) const;

  const std::vector<LidarPoint>* points_ = nullptr;
  std::vector<Neighbours> neighbours_;
  std::vector<std::uint32_t> newest_;  // by ring
};

}  // namespace lio
