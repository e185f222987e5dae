// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where the sensor is after it was blind for a while: the bird's-eye view of now is laid over the
// last one, shifted and turned in every way within a range, first roughly, then the best ones
// finely. Good to a quarter of a metre and half a degree, which is where matching takes over. Views
// may be alike in several places (a row of houses, of parked cars), so it tells a few, best first:
// matching decides. Views must be of axes whose z is up to about 10 deg.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

// Of the later view in the axes of the earlier one: a place p appears at R(turn) p + shift.
struct FlatPose {
  Eigen::Vector2f shift_m = Eigen::Vector2f::Zero();
  float turn_rad = 0.f;
};

// To each side of where it is sought.
struct FlatRange {
  Eigen::Vector2f shift_m = Eigen::Vector2f::Zero();
  float turn_rad = 0.f;
};

// At most twelve; none where too little stands there.
std::vector<FlatPose> FindPlaces(const BirdsEyeView& earlier, const BirdsEyeView& later,
                                 const FlatPose& middle, const FlatRange& range);

}  // namespace lio
