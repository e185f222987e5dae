// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A closed room of 40 x 30 x 9 m around the origin, and a sensor that stands there.
#pragma once

#include "lio/sim/scene.hpp"
#include "lio/sim/trajectory.hpp"

namespace lio::test {

inline sim::World Room(sim::Material material = sim::Material::kPlaster) {
  sim::World world;
  AddBox(world.fixed.page(), sim::UprightPose({0.0, 0.0, -2.0}, 0.0), {40.0, 30.0, 9.0}, material);
  return world;
}

inline sim::Trajectory Still() {
  sim::MotionPlan plan;
  plan.knots.resize(4);
  return sim::Trajectory(plan);
}

}  // namespace lio::test
