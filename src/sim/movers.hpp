// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Moves people and vehicles through a world.
#pragma once

#include <functional>

#include "lio/sim/path.hpp"
#include "lio/sim/random.hpp"
#include "lio/sim/world.hpp"
#include "sim/props.hpp"

namespace lio::sim {

// Adds a person who walks where `body` says: a torso and two swinging legs.
void AddWalker(World& world, Random& random, double speed_mps,
               const std::function<Pose(double t_s)>& body);

// Adds a vehicle that follows a path, at `distance(t)` along it, on the given ground.
void AddVehicleMover(World& world, VehicleKind kind, Random& random, Path path,
                     std::function<double(double t_s)> distance, HeightFunction height);

}  // namespace lio::sim
