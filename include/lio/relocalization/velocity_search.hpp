// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the sensor's velocity when nothing is known of it: the bird's-eye views of a few scans
// are laid over each other at every velocity of a wide range, and the one where all agree wins
// (correlative scan matching, Olson, ICRA 2009, over velocities instead of poses). It is good to
// about 1 m/s, from where matching converges.
//
// Only vertical structures count, since a spinning lidar's rings on the ground move with the sensor
// and would agree best without any motion. A single pair of scans is often ambiguous (posts of a
// rail, traffic that goes along); the sum over pairs of different spacing in time leaves one
// velocity. Points are in metres, in axes whose z is up to about 10 deg and which do not turn
// between the scans, with the origin at the sensor. All scans are skewed alike, which does little
// harm. The velocity is taken as constant. A pair of scans costs about 15 ms.
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
  // `stamp` tells when the sensor was at the points' origin. Scans come in order of time.
  void Add(Timestamp stamp, std::span<const Eigen::Vector3f> points);

  // Returns the velocity in x and y [m/s]. Absent when none agrees clearly better than the rest:
  // there are few structures, they look alike along the way, or there are fewer than two scans.
  [[nodiscard]] std::optional<Eigen::Vector2f> Find() const;
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
