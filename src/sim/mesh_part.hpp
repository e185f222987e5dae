// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes that part of a mesh which lies around a place.
#pragma once

#include <Eigen/Geometry>

#include "lio/sim/mesh.hpp"

namespace lio::sim {

// Appends the triangles whose bounds in x and y meet `box_m`, in the mesh's order, and the vertices
// that they use.
void AddPartOf(const Mesh& mesh, const Eigen::AlignedBox2f& box_m, Mesh& part);

}  // namespace lio::sim
