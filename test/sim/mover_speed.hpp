// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How fast what moves in a world moves.
#pragma once

#include "lio/sim/scene.hpp"

namespace lio::test {

inline double SpeedOf(const sim::Mover& mover, double t_s) {
  return (mover.T_world_mover(t_s + 0.01).translation - mover.T_world_mover(t_s).translation)
             .norm() /
         0.01;
}

}  // namespace lio::test
