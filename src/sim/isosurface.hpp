// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Meshes the surface of a place that is given by its signed distance, for caves and rough rock. It
// is used inside src/sim only.
#pragma once

#include <functional>

#include "lio/sim/mesh.hpp"

namespace lio::sim {

// Gives about the distance [m] from a point to the nearest surface, negative in the open. It must
// not change by more than the way between two points.
using DistanceFunction = std::function<double(const Vector3& p_m)>;

// Appends the surface on which the distance is zero, within the box, by marching tetrahedra (Doi
// and Koide 1991) on a lattice of `cell_m`.
void AddIsosurface(Mesh& mesh, const DistanceFunction& distance, const Vector3& low_m,
                   const Vector3& high_m, double cell_m, Material material);

}  // namespace lio::sim
