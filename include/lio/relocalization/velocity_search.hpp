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
// velocity. Traffic that goes along may be most of what is seen, so that things that are higher
// than any vehicle go before all others. Points are in metres, in axes whose z is up to about 10
// deg and which do not turn between the scans, with the origin at the sensor. All scans are skewed
// alike, which does little harm. The velocity is taken as constant. A pair of scans costs about 15
// ms, and as much again among buildings.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

struct SpeedRange {
  double min_mps = 0.0;
  double max_mps = 0.0;
};

// Lays views over each other.
class VelocityVotes {
 public:
  // Takes a view that has enough structures.
  void Add(Timestamp stamp, BirdsEyeView view);
  // Returns the velocity at which they agree clearly better than at any other.
  [[nodiscard]] std::optional<Eigen::Vector2f> Find() const;
  // Returns the speeds at which they do not agree clearly worse than at the best.
  [[nodiscard]] std::optional<SpeedRange> LikelySpeeds() const;
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

// Holds what views from above tell of the sensor's motion.
struct SeenVelocity {
  // In x and y [m/s]. Absent when none agrees clearly better than the rest: there are few
  // structures, they look alike along the way, or there are fewer than two scans.
  std::optional<Eigen::Vector2f> v_mps;
  bool is_of_buildings = false;  // it is that of things that are higher than any vehicle
  // Things that are higher than any vehicle, and so stand, allow these alone. Absent without them.
  std::optional<SpeedRange> by_buildings;
};

class VelocitySearch {
 public:
  // `stamp` tells when the sensor was at the points' origin. Scans come in order of time.
  void Add(Timestamp stamp, std::span<const Eigen::Vector3f> points);

  [[nodiscard]] SeenVelocity Find() const;
  std::size_t num_scans() const { return of_all_.num_scans(); }

 private:
  VelocityVotes of_all_;
  VelocityVotes of_buildings_;
};

}  // namespace lio
