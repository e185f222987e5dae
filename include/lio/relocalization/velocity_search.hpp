// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How fast the sensor moves when nothing is known of it: the bird's-eye views of a few scans are
// laid over each other at every velocity of a wide range, and the one where all of them agree wins.
// Good to a metre per second or so, which is where matching takes over.
//
// Only what stands up counts, since a spinning lidar's rings on the ground move with the sensor and
// would fit best without any motion. A single pair is often ambiguous (posts of a rail, traffic
// that goes along): sums over pairs of different spacing in time leave one velocity. Inputs: points
// in metres, in axes whose z is up to about 10 deg and which do not turn between the scans, origin
// at the sensor. Skew does little harm, since all scans have it. The velocity is taken as constant.
// Cost: about 15 ms a pair of scans.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

class VelocitySearch {
 public:
  // `stamp`: of the origin's place. Scans come in order of time.
  void Add(Timestamp stamp, std::span<const Eigen::Vector3f> points);

  // In x and y [m/s]. Absent when no velocity fits clearly better than the rest: few things stand
  // there, they look alike along the way, or there are less than two scans.
  std::optional<Eigen::Vector2f> Find() const;
  std::size_t num_scans() const { return scans_.size(); }

 private:
  struct Scan {
    Timestamp stamp;
    BirdsEyeView view;
  };

  void AddPair(const Scan& before, const Scan& after);

  std::vector<Scan> scans_;
  std::vector<int> scores_;  // by velocity; empty before the first pair
};

}  // namespace lio
