// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Describes the surroundings of the sensors: one static mesh, and objects that move.
#pragma once

#include <functional>
#include <vector>

#include "lio/sim/mesh.hpp"
#include "lio/sim/paged_mesh.hpp"

namespace lio::sim {

struct Mover {
  std::size_t shape = 0;                          // index into World::shapes
  std::function<Pose(double t_s)> T_world_mover;  // must be continuous and safe from any thread
};

struct World {
  PagedMesh fixed;
  std::vector<Mesh> shapes;
  std::vector<Mover> movers;
};

}  // namespace lio::sim
