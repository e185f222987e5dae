// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/world_yaw.hpp"

namespace lio {

double TakeOutYaw(Estimate& estimate) {
  const Vector3 up_imu =
      estimate.state.T_world_imu.rotation.conjugate().toRotationMatrix() * Vector3::UnitZ();
  const ErrorVector with_yaw = estimate.cov.middleCols<3>(kRot) * up_imu;
  const double yaw_var = up_imu.dot(with_yaw.segment<3>(kRot));
  if (yaw_var <= 0.0) return 0.0;
  estimate.cov -= with_yaw * with_yaw.transpose() / yaw_var;
  return yaw_var;
}

}  // namespace lio
