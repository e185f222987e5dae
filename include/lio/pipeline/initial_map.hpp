// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a map saved before, to start in.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/relocalization/place_seeker.hpp"

namespace lio {

struct InitialMap {
  std::vector<Eigen::Vector3f> points;  // finite; in axes whose z is up to about 10 deg
  std::optional<PlaceGuess> guess;      // absent: anywhere in the map
};

// Tells why nobody can start in these points; empty where one can.
[[nodiscard]] std::string WhyUnusable(std::span<const Eigen::Vector3f> points);

// It is read only, so that threads may share it. Null: no such map.
using InitialMapPtr = std::shared_ptr<const InitialMap>;

}  // namespace lio
