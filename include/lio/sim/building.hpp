// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Houses with facades that a lidar can tell apart: recessed windows and doors, balconies, shop
// fronts, cornices, parapets, roofs.
#pragma once

#include "lio/sim/mesh.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {

struct FacadeStyle {
  Material wall = Material::kPlaster;
  double storey_m = 3.2;
  double ground_storey_m = 4.0;
  double bay_m = 3.0;  // wall per window
  double window_width_m = 1.3;
  double window_height_m = 1.6;
  double sill_m = 0.9;  // of a window above its floor
  double recess_m = 0.2;
  double balcony_chance = 0.2;
  bool has_shops = true;  // wide glass on the ground floor
};
FacadeStyle RandomFacade(Random& random);

struct BuildingPlan {
  Vector2 size_m = {12.0, 10.0};  // along the front (x) and deep (y)
  int num_storeys = 5;
  bool has_gable_roof = false;  // else flat with a parapet
  bool has_plain_rear = true;   // rear and sides without windows, cheaper
  FacadeStyle facade;
};

// In its own frame: front along x at y = 0 facing -y, from x = 0 to size.x, body toward +y, floor
// at z = 0; walls reach down to -3 m, for slopes.
Mesh MakeBuilding(const BuildingPlan& plan, Random& random);

}  // namespace lio::sim
