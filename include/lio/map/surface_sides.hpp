// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// From which side may the surfaces of a cloud be seen, if nobody knows where its scans were taken?
// A slab or a wall between rooms shows two sheets a hand's breadth or two apart with nothing
// between them, and each is seen from the side that is turned away from the other one. All other
// surfaces may be seen from both sides.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lio/base/parallel.hpp"

namespace lio {

// Returns for each point the unit normal towards the side that its surface is seen from; zero where
// the points do not tell.
[[nodiscard]] std::vector<Eigen::Vector3f> SurfaceSides(std::span<const Eigen::Vector3f> points,
                                                        const Workers& workers = Workers(1));

}  // namespace lio
