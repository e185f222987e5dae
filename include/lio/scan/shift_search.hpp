// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How far the sensor has moved between two scans when nothing is known of its velocity: the
// bird's-eye view of what stands up is laid over that of the scan before, at every shift of a wide
// range. Good to a quarter of a metre, which is where matching takes over.
//
// Only what stands up counts, since a spinning lidar's rings on the ground move with the sensor and
// would fit best without any motion.
// Inputs: points in metres, in axes whose z is up to about 10 deg and which do not turn between the
// two scans, origin at the sensor. Skew does little harm, since both scans have it.
// Cost: about 3 ms for 1000 upright cells and shifts up to 6 m.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lio {

class UprightView {
 public:
  explicit UprightView(std::span<const Eigen::Vector3f> points);

  // Where things stand, one point a cell.
  const std::vector<Eigen::Vector2f>& places() const { return places_; }
  // Does something stand within about a cell of there?
  bool IsNear(const Eigen::Vector2f& place) const;

 private:
  std::vector<Eigen::Vector2f> places_;
  std::vector<std::uint8_t> near_;  // by cell of a square around the origin
};

// The sensor's shift in x and y from one scan to the other [m]. Absent when no shift fits clearly
// better than the rest: few things stand there, or they look alike along the way.
std::optional<Eigen::Vector2f> FindShift(const UprightView& before, const UprightView& after);

}  // namespace lio
