// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Derives the motion of the rig's base frame from that of imu, both being fixed to the same body.
//
// Let r be the origin of base in imu and w the rate of imu (R = R_world_imu). Then
//   p_base = p + R r,   R_world_base = R R_imu_base,   v_base = v + R (w x r),
// and the errors, to first order, with dw = -d(gyro bias) plus the noise of the reading:
//   dp_base     = dp - R [r]x dtheta
//   dtheta_base = R_base_imu dtheta
//   dv_base     = dv - R [w x r]x dtheta - R [r]x dw
// The map pose's right error goes through the adjoint of T_base_imu.
#pragma once

#include "lio/filter/nav_state.hpp"
#include "lio/pipeline/outputs.hpp"

namespace lio {

// `cov` is that of position, rotation, velocity and gyro bias of `nav`, whose own blocks are not
// looked at. `rate_var` is that of the noise in nav.w_imu_radps, (rad/s)^2 an axis, independent of
// all else.
BaseMotion MoveToBase(const NavOutput& nav, const NavCov& cov, double rate_var,
                      const Pose& T_base_imu);

}  // namespace lio
