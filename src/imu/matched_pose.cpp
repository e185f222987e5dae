// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/matched_pose.hpp"

#include <cmath>

#include "lio/imu/rest.hpp"

namespace lio {

ShownMotion ShownBetween(const MatchedPose& then, const MatchedPose& now) {
  const Pose motion = then.T_any_imu.Inverse() * now.T_any_imu;
  const Matrix3 R_then_now = motion.rotation.toRotationMatrix();
  const auto shown = [&](const Vector3& change, int at) {
    const Vector3 along = change.normalized();
    const Vector3 along_now = R_then_now.transpose() * along;
    const double var = along.dot(then.cov.block<3, 3>(at, at) * along) +
                       along_now.dot(now.cov.block<3, 3>(at, at) * along_now);
    const double size = change.norm();
    return size > kRest.at_start.min_sigmas * std::sqrt(var) ? size : 0.0;
  };
  const Matrix3 turn_cov =
      R_then_now.transpose() * then.cov.block<3, 3>(3, 3) * R_then_now + now.cov.block<3, 3>(3, 3);
  return {shown(motion.translation, 0), shown(LogSo3(motion.rotation), 3),
          std::sqrt(turn_cov.operatorNorm())};
}

}  // namespace lio
