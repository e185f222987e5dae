// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the filter's state and the conventions of its errors. Error-state form: Sola, arXiv
// 1711.02508.
//
// Frames: world (z up, gravity-aligned, origin at the imu's first pose), imu (the body), map (the
// frame of the map that scans are matched against; it starts as world and drifts from it).
// Two poses: T_world_imu is levelled by gravity and is the output in world; T_map_imu is what
// registration measures. docs/filter.md says why both are needed.
//
// Error state, 24 numbers, true = nominal (+) error:
//   position       p_true = p + dp                 m, world
//   rotation       R_true = R Exp(dtheta)          rad, right (local)
//   velocity       v_true = v + dv                 m/s, world
//   gyro bias, accel bias                          rad/s, m/s^2, added
//   map pose       M_true = M ExpSe3(mu)           [m; rad], right (local)
//   map's start    D_true = Exp(ddelta) D          rad, world (left), D = R_world_map_start
// Gravity is the vector g_world = (0, 0, -g): an accelerometer at rest measures -R^T g_world.
#pragma once

#include <Eigen/Core>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

inline constexpr int kPos = 0;
inline constexpr int kRot = 3;
inline constexpr int kVel = 6;
inline constexpr int kGyroBias = 9;
inline constexpr int kAccelBias = 12;
inline constexpr int kMapPose = 15;   // translation, then rotation
inline constexpr int kMapStart = 21;  // the rotation between world and map at the map's start
inline constexpr int kStateDim = 24;

using ErrorVector = Eigen::Matrix<double, kStateDim, 1>;
// Holds the covariance of the first four blocks: position, rotation, velocity, gyro bias; 12x12.
using NavCov = Eigen::Matrix<double, kAccelBias, kAccelBias>;
using ErrorMatrix = Eigen::Matrix<double, kStateDim, kStateDim>;

struct NavState {
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();  // m/s
  Vector3 gyro_bias = Vector3::Zero();    // rad/s
  Vector3 accel_bias = Vector3::Zero();   // m/s^2
  Pose T_map_imu;
  Quaternion R_world_map_start = Quaternion::Identity();  // map_bend.hpp
};

// Returns a vector of the world in the axes of the map, by the poses of one instant in both.
template <class PosesOfInstant>
Vector3 InMap(const PosesOfInstant& at, const Vector3& v_world) {
  return at.T_map_imu.rotation * (at.T_world_imu.rotation.conjugate() * v_world);
}

// Returns state (+) error, by the conventions above.
NavState BoxPlus(const NavState& state, const ErrorVector& error);

// Injects an error that a measurement has shown: BoxPlus to first order. A motion that both poses
// lack moves both alike, exactly, however far: the rotation and place of world and map to each
// other change by the difference of the two poses' errors alone. BoxPlus would leave half the
// product of the motion's turn and shift between them, 0.5 m after 30 m and 2 deg of drift.
NavState Inject(const NavState& state, const ErrorVector& error);
// d (error about Inject(state, error)) / d (error about state), at `error`.
ErrorMatrix InjectJacobian(const NavState& state, const ErrorVector& error);

struct Estimate {
  Timestamp stamp;
  NavState state;
  ErrorMatrix cov = ErrorMatrix::Zero();
};

}  // namespace lio
