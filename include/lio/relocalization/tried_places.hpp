// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Remembers places where a lost scan was matched in vain, so that the search for the next scan goes
// on with others. A place is kept as its offset from the motion prior of its scan, which moves as
// the sensor does.
#pragma once

#include <vector>

#include "lio/base/pose.hpp"

namespace lio {

// Are the poses within 1 m and 0.1 rad of each other?
bool IsSamePlace(const Pose& a, const Pose& b);

class TriedPlaces {
 public:
  void Add(const Pose& T_map_prior, const Pose& T_map_place) {
    offsets_.push_back(T_map_prior.Inverse() * T_map_place);
  }
  bool Contains(const Pose& T_map_prior, const Pose& T_map_place) const;
  void Clear() { offsets_.clear(); }

 private:
  std::vector<Pose> offsets_;  // T_prior_place
};

}  // namespace lio
