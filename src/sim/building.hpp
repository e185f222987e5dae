// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes houses whose facades a lidar can tell apart: they have recessed windows and doors,
// balconies, shop fronts, cornices, parapets and roofs.
#pragma once

#include "lio/sim/mesh.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {

struct FacadeStyle {
  Material wall = Material::kPlaster;
  double storey_m = 3.2;
  double ground_storey_m = 4.0;
  double bay_m = 3.0;  // width of wall that has one window
  double window_width_m = 1.3;
  double window_height_m = 1.6;
  double sill_m = 0.9;  // height of a window's lower edge above its floor
  double recess_m = 0.2;
  double balcony_chance = 0.2;
  bool has_shops = true;  // the ground floor has wide shop windows
};
[[nodiscard]] FacadeStyle RandomFacade(Random& random);

struct BuildingPlan {
  Vector2 size_m = {12.0, 10.0};  // along the front (x) and in depth (y)
  int num_storeys = 5;
  bool has_gable_roof = false;  // false: the roof is flat and has a parapet
  bool has_plain_rear = true;   // rear and side walls have no windows, which saves triangles
  FacadeStyle facade;
};

// Makes a building in its own frame: the front lies along x at y = 0 and faces -y, from x = 0 to
// size.x; the body extends toward +y; the floor is at z = 0. Walls reach down to z = -3 m, so that
// they meet sloping ground.
[[nodiscard]] Mesh MakeBuilding(const BuildingPlan& plan, Random& random);

}  // namespace lio::sim
