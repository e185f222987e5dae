// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/process_model.hpp"

#include <algorithm>

#include "lio/filter/inertial_increment.hpp"

namespace lio {
namespace {

// What a step needs of its samples and states, computed once.
struct Step {
  InertialIncrement increment;
  IncrementByBias by_bias;
  Matrix3 R0, R1;  // imu to world before and after
  Matrix3 dR_T;    // (R0^T R1)^T
};

Step MakeStep(const NavState& before, const NavState& after, const ImuSample& from,
              const ImuSample& to) {
  Step step;
  step.increment = MakeIncrement(from, to, before.gyro_bias, before.accel_bias, step.by_bias);
  step.R0 = before.T_world_imu.rotation.toRotationMatrix();
  step.R1 = after.T_world_imu.rotation.toRotationMatrix();
  step.dR_T = step.R1.transpose() * step.R0;
  return step;
}

// The transition's 3x3 blocks that are neither zero nor identity. Rows: position, rotation,
// velocity, map translation, map rotation.
struct Blocks {
  Matrix3 p_rot, p_gyro, p_accel;
  double p_vel = 0.0;
  Matrix3 rot_rot, rot_gyro;
  Matrix3 v_rot, v_gyro, v_accel;
  Matrix3 m_rot, m_vel, m_gyro, m_accel, m_m, m_mrot;  // map translation
};

Blocks MakeBlocks(const Step& s) {
  Blocks b;
  b.v_rot = -s.R0 * Hat(s.increment.velocity);
  b.v_gyro = s.R0 * s.by_bias.velocity_by_gyro;
  b.v_accel = s.R0 * s.by_bias.velocity_by_accel;
  b.p_vel = s.increment.dt_s;
  b.p_rot = -s.R0 * Hat(s.increment.position);
  b.p_gyro = s.R0 * s.by_bias.position_by_gyro;
  b.p_accel = s.R0 * s.by_bias.position_by_accel;
  b.rot_rot = s.dR_T;
  b.rot_gyro = s.by_bias.turn_by_gyro;
  return b;
}

// The map pose takes the same increment D = T0^-1 T1, whose own error is that of T1 less that of T0
// carried through D.
void AddMapBlocks(const NavState& before, const NavState& after, const Step& s, Blocks& b) {
  const Vector3 d_world = after.T_world_imu.translation - before.T_world_imu.translation;
  const Vector3 d = s.R0.transpose() * d_world;  // translation of D
  // Ad(D^-1) = [dR^T, -dR^T Hat(d); 0, dR^T] for D = (dR, d).
  b.m_m = s.dR_T;
  b.m_mrot = -s.dR_T * Hat(d);
  b.m_rot = s.dR_T * Hat(d - s.increment.position);
  b.m_vel = b.p_vel * s.R1.transpose();
  b.m_gyro = s.dR_T * s.by_bias.position_by_gyro;
  b.m_accel = s.dR_T * s.by_bias.position_by_accel;
}

using Rows = Eigen::Matrix<double, 3, kStateDim>;

// F * P, row block by row block.
ErrorMatrix MultiplyTransition(const Blocks& b, const ErrorMatrix& P) {
  const Rows p = P.middleRows<3>(kPos);
  const Rows rot = P.middleRows<3>(kRot);
  const Rows vel = P.middleRows<3>(kVel);
  const Rows gyro = P.middleRows<3>(kGyroBias);
  const Rows accel = P.middleRows<3>(kAccelBias);
  const Rows m = P.middleRows<3>(kMapPose);
  const Rows m_rot = P.middleRows<3>(kMapPose + 3);
  ErrorMatrix out;
  out.middleRows<3>(kPos) = p + b.p_vel * vel;
  out.middleRows<3>(kPos).noalias() += b.p_rot * rot;
  out.middleRows<3>(kPos).noalias() += b.p_gyro * gyro;
  out.middleRows<3>(kPos).noalias() += b.p_accel * accel;
  out.middleRows<3>(kRot).noalias() = b.rot_rot * rot;
  out.middleRows<3>(kRot).noalias() += b.rot_gyro * gyro;
  out.middleRows<3>(kVel) = vel;
  out.middleRows<3>(kVel).noalias() += b.v_rot * rot;
  out.middleRows<3>(kVel).noalias() += b.v_gyro * gyro;
  out.middleRows<3>(kVel).noalias() += b.v_accel * accel;
  out.middleRows<3>(kGyroBias) = gyro;
  out.middleRows<3>(kAccelBias) = accel;
  out.middleRows<3>(kMapPose).noalias() = b.m_m * m;
  out.middleRows<3>(kMapPose).noalias() += b.m_mrot * m_rot;
  out.middleRows<3>(kMapPose).noalias() += b.m_rot * rot;
  out.middleRows<3>(kMapPose).noalias() += b.m_vel * vel;
  out.middleRows<3>(kMapPose).noalias() += b.m_gyro * gyro;
  out.middleRows<3>(kMapPose).noalias() += b.m_accel * accel;
  out.middleRows<3>(kMapPose + 3).noalias() = b.m_m * m_rot;
  out.middleRows<3>(kMapPose + 3).noalias() += b.rot_gyro * gyro;
  return out;
}

void AddNoise(const Step& s, const ProcessNoise& noise, ErrorMatrix& P) {
  const double dt = s.increment.dt_s;
  const double gyro = noise.gyro_density * noise.gyro_density * dt;
  const double vel = noise.accel_density * noise.accel_density * dt;
  const double pos_vel = 0.5 * dt * vel;
  const double pos = dt * dt / 3.0 * vel;
  const auto add = [&](int row, int col, const Matrix3& block) {
    P.block<3, 3>(row, col) += block;
    if (row != col) P.block<3, 3>(col, row) += block.transpose();
  };
  const Matrix3 identity = Matrix3::Identity();
  const Matrix3 R1_T = s.R1.transpose();
  add(kPos, kPos, pos * identity);
  add(kPos, kVel, pos_vel * identity);
  add(kVel, kVel, vel * identity);
  add(kRot, kRot, gyro * identity);
  add(kMapPose, kMapPose, pos * identity);
  add(kMapPose, kPos, pos * R1_T);
  add(kMapPose, kVel, pos_vel * R1_T);
  add(kMapPose + 3, kMapPose + 3, gyro * identity);
  add(kMapPose + 3, kRot, gyro * identity);
  add(kGyroBias, kGyroBias,
      noise.gyro_bias_walk_density * noise.gyro_bias_walk_density * dt * identity);
  add(kAccelBias, kAccelBias,
      noise.accel_bias_walk_density * noise.accel_bias_walk_density * dt * identity);
}

Blocks MakeAllBlocks(const NavState& before, const NavState& after, const Step& step) {
  Blocks blocks = MakeBlocks(step);
  AddMapBlocks(before, after, step, blocks);
  return blocks;
}

}  // namespace

NavState PropagateState(const NavState& state, const ImuSample& from, const ImuSample& to,
                        const Vector3& g_world) {
  const InertialIncrement increment = MakeIncrement(from, to, state.gyro_bias, state.accel_bias);
  const double dt = increment.dt_s;
  const Quaternion R0 = state.T_world_imu.rotation;
  const Vector3 shift = dt * state.v_world_imu + 0.5 * dt * dt * g_world + R0 * increment.position;
  NavState next = state;
  next.T_world_imu.rotation = (R0 * increment.turn).normalized();
  next.T_world_imu.translation += shift;
  next.v_world_imu += dt * g_world + R0 * increment.velocity;
  next.T_map_imu = state.T_map_imu * Pose{increment.turn, R0.conjugate() * shift};
  return next;
}

ErrorMatrix TransitionMatrix(const NavState& before, const NavState& after, const ImuSample& from,
                             const ImuSample& to) {
  return MultiplyTransition(MakeAllBlocks(before, after, MakeStep(before, after, from, to)),
                            ErrorMatrix::Identity());
}

void Propagate(Estimate& estimate, const ImuSample& from, const ImuSample& to,
               const ProcessNoise& noise, const Vector3& g_world) {
  const NavState before = estimate.state;
  estimate.state = PropagateState(before, from, to, g_world);
  estimate.stamp = to.stamp;
  const Step step = MakeStep(before, estimate.state, from, to);
  const Blocks blocks = MakeAllBlocks(before, estimate.state, step);
  const ErrorMatrix half = MultiplyTransition(blocks, estimate.cov);
  estimate.cov = MultiplyTransition(blocks, half.transpose());
  AddNoise(step, noise, estimate.cov);
  estimate.cov = 0.5 * (estimate.cov + estimate.cov.transpose()).eval();
}

ImuSample InterpolateSample(const ImuSample& a, const ImuSample& b, Timestamp stamp) {
  const double span_s = SecondsBetween(a.stamp, b.stamp);
  const double fraction =
      span_s > 0 ? std::clamp(SecondsBetween(a.stamp, stamp) / span_s, 0.0, 1.0) : 0.0;
  ImuSample sample;
  sample.stamp = stamp;
  sample.w_imu_radps = a.w_imu_radps + fraction * (b.w_imu_radps - a.w_imu_radps);
  sample.f_imu_mps2 = a.f_imu_mps2 + fraction * (b.f_imu_mps2 - a.f_imu_mps2);
  return sample;
}

}  // namespace lio
