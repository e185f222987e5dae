// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/tried_places.hpp"

#include <algorithm>

#include "lio/relocalization/parameters.hpp"

namespace lio {
bool IsSamePlace(const Pose& a, const Pose& b) {
  const Pose apart = a.Inverse() * b;
  return apart.translation.norm() < kRelocalization.tried_same_m &&
         LogSo3(apart.rotation).norm() < kRelocalization.tried_same_rad;
}

bool TriedPlaces::Contains(const Pose& T_map_prior, const Pose& T_map_place) const {
  return std::any_of(offsets_.begin(), offsets_.end(), [&](const Pose& T_prior_tried) {
    return IsSamePlace(T_map_prior * T_prior_tried, T_map_place);
  });
}

}  // namespace lio
