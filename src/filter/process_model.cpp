// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/process_model.hpp"

#include <algorithm>

namespace lio {
namespace {

// What a step needs of its two samples and states, computed once.
struct Step {
  double dt_s = 0.0;
  Matrix3 R0, R1;             // imu to world before and after
  Matrix3 dR_T;               // (R0^T R1)^T
  Vector3 f0, f1;             // bias-corrected specific force at both ends, imu
  Matrix3 right_jacobian_dt;  // d rotation after / d (-gyro bias)
};

Vector3 RotationVector(const NavState& state, const ImuSample& from, const ImuSample& to,
                       double dt_s) {
  const Vector3 w0 = from.w_imu_radps - state.gyro_bias;
  const Vector3 w1 = to.w_imu_radps - state.gyro_bias;
  return 0.5 * dt_s * (w0 + w1) + dt_s * dt_s / 12.0 * w0.cross(w1);
}

Step MakeStep(const NavState& before, const NavState& after, const ImuSample& from,
              const ImuSample& to) {
  Step step;
  step.dt_s = SecondsBetween(from.stamp, to.stamp);
  step.R0 = before.T_world_imu.rotation.toRotationMatrix();
  step.R1 = after.T_world_imu.rotation.toRotationMatrix();
  step.dR_T = step.R1.transpose() * step.R0;
  step.f0 = from.f_imu_mps2 - before.accel_bias;
  step.f1 = to.f_imu_mps2 - before.accel_bias;
  step.right_jacobian_dt =
      step.dt_s * RightJacobianSo3(RotationVector(before, from, to, step.dt_s));
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
  const double dt = s.dt_s;
  // d (R f) / d rotation error at each end, and through the end's dependence on the gyro bias.
  const Matrix3 force0 = -s.R0 * Hat(s.f0);
  const Matrix3 force1 = -s.R1 * Hat(s.f1);
  const Matrix3 force1_start = force1 * s.dR_T;
  const Matrix3 force1_gyro = -force1 * s.right_jacobian_dt;
  Blocks b;
  b.v_rot = 0.5 * dt * (force0 + force1_start);
  b.v_gyro = 0.5 * dt * force1_gyro;
  b.v_accel = -0.5 * dt * (s.R0 + s.R1);
  b.p_vel = dt;
  b.p_rot = dt * dt / 6.0 * (2.0 * force0 + force1_start);
  b.p_gyro = dt * dt / 6.0 * force1_gyro;
  b.p_accel = -dt * dt / 6.0 * (2.0 * s.R0 + s.R1);
  b.rot_rot = s.dR_T;
  b.rot_gyro = -s.right_jacobian_dt;
  return b;
}

// The map pose takes the same increment D = T0^-1 T1, whose own error is that of T1 less that of T0
// carried through D.
void AddMapBlocks(const NavState& before, const NavState& after, const Step& s, Blocks& b) {
  const Matrix3 R1_T = s.R1.transpose();
  const Vector3 d_world = after.T_world_imu.translation - before.T_world_imu.translation;
  const Vector3 d = s.R0.transpose() * d_world;  // translation of D
  // Ad(D^-1) = [dR^T, -dR^T Hat(d); 0, dR^T] for D = (dR, d).
  b.m_m = s.dR_T;
  b.m_mrot = -s.dR_T * Hat(d);
  b.m_rot = R1_T * b.p_rot - b.m_mrot;
  b.m_vel = b.p_vel * R1_T;
  b.m_gyro = R1_T * b.p_gyro;
  b.m_accel = R1_T * b.p_accel;
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
  const double dt = s.dt_s;
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
  const double dt = SecondsBetween(from.stamp, to.stamp);
  const Quaternion turn = ExpSo3(RotationVector(state, from, to, dt));
  const Quaternion R0 = state.T_world_imu.rotation;
  NavState next = state;
  next.T_world_imu.rotation = (R0 * turn).normalized();
  const Vector3 a0 = R0 * (from.f_imu_mps2 - state.accel_bias) + g_world;
  const Vector3 a1 = next.T_world_imu.rotation * (to.f_imu_mps2 - state.accel_bias) + g_world;
  const Vector3 shift = dt * state.v_world_imu + dt * dt / 6.0 * (2.0 * a0 + a1);
  next.v_world_imu += 0.5 * dt * (a0 + a1);
  next.T_world_imu.translation += shift;
  next.T_map_imu = state.T_map_imu * Pose{turn, R0.conjugate() * shift};
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
