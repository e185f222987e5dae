// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/process_model.hpp"

#include <algorithm>

#include "filter/inertial_increment.hpp"

namespace lio {
namespace {

// The transition of the errors over one step, where e is the error before, and D = (dR, d) the
// step's motion seen from the imu frame at its start:
//   u = -position x e_rot + position_by_gyro e_gyro + position_by_accel e_accel
//   w = -velocity x e_rot + velocity_by_gyro e_gyro + velocity_by_accel e_accel
// and after the step
//   position         e_pos + dt e_vel + R0 u
//   rotation         dR^T e_rot + turn_by_gyro e_gyro
//   velocity         e_vel + R0 w
//   map translation  dR^T (e_mt + d x (e_rot - e_mr) + dt R0^T e_vel + u)
//   map rotation     dR^T e_mr + turn_by_gyro e_gyro
// The errors of the biases and of the map's start stay as they are. The map pose takes the same
// increment D = T0^-1 T1 as the world pose, whose own error is that of T1 less that of T0 carried
// through D.
struct Step {
  InertialIncrement increment;
  IncrementByBias by_bias;
  Matrix3 R0, dR, R1;  // imu to world before, the turn, imu to world after
  Vector3 d;
};

Step MakeStep(const NavState& before, const NavState& after, const ImuSample& from,
              const ImuSample& to) {
  Step step;
  step.increment = MakeIncrement(from, to, before.gyro_bias, before.accel_bias, step.by_bias);
  step.R0 = before.T_world_imu.rotation.toRotationMatrix();
  step.dR = step.increment.turn.toRotationMatrix();
  step.R1 = step.R0 * step.dR;
  step.d = step.R0.transpose() * (after.T_world_imu.translation - before.T_world_imu.translation);
  return step;
}

// Columns of X F^T, three at a time, for the rows from kFrom on: each is the error after the step
// above, with the columns of X for e and all factors transposed. Columns are contiguous in memory.
template <int kFrom>
class Columns {
 public:
  using Three = Eigen::Matrix<double, kStateDim - kFrom, 3>;

  Columns(const Step& step, const ErrorMatrix& X) : s_(step), x_(X) {}

  Three Position() const {
    Three y = Of(kPos) + s_.increment.dt_s * Of(kVel);
    y.noalias() += PositionGain().lazyProduct(s_.R0.transpose());
    return y;
  }
  Three Rotation() const { return Turned(kRot); }
  Three Velocity() const {
    Three w = Of(kRot).lazyProduct(Hat(s_.increment.velocity));
    w.noalias() += Of(kGyroBias).lazyProduct(s_.by_bias.velocity_by_gyro.transpose());
    w.noalias() += Of(kAccelBias).lazyProduct(s_.by_bias.velocity_by_accel.transpose());
    Three y = Of(kVel);
    y.noalias() += w.lazyProduct(s_.R0.transpose());
    return y;
  }
  Three MapTranslation() const {
    Three y = PositionGain() + Of(kMapPose);
    y.noalias() -= (Of(kRot) - Of(kMapPose + 3)).lazyProduct(Hat(s_.d));
    y.noalias() += Of(kVel).lazyProduct(s_.increment.dt_s * s_.R0);
    return y.lazyProduct(s_.dR);
  }
  Three MapRotation() const { return Turned(kMapPose + 3); }

 private:
  auto Of(int column) const { return x_.template block<kStateDim - kFrom, 3>(kFrom, column); }
  Three PositionGain() const {
    Three u = Of(kRot).lazyProduct(Hat(s_.increment.position));
    u.noalias() += Of(kGyroBias).lazyProduct(s_.by_bias.position_by_gyro.transpose());
    u.noalias() += Of(kAccelBias).lazyProduct(s_.by_bias.position_by_accel.transpose());
    return u;
  }
  Three Turned(int column) const {
    Three y = Of(column).lazyProduct(s_.dR);
    y.noalias() += Of(kGyroBias).lazyProduct(s_.by_bias.turn_by_gyro.transpose());
    return y;
  }

  const Step& s_;
  const ErrorMatrix& x_;
};

// X F^T.
ErrorMatrix TimesTransitionTransposed(const Step& step, const ErrorMatrix& X) {
  const Columns<0> columns(step, X);
  ErrorMatrix out;
  out.middleCols<3>(kPos) = columns.Position();
  out.middleCols<3>(kRot) = columns.Rotation();
  out.middleCols<3>(kVel) = columns.Velocity();
  out.middleCols<6>(kGyroBias) = X.middleCols<6>(kGyroBias);
  out.middleCols<3>(kMapPose) = columns.MapTranslation();
  out.middleCols<3>(kMapPose + 3) = columns.MapRotation();
  out.middleCols<3>(kMapStart) = X.middleCols<3>(kMapStart);
  return out;
}

// Returns the lower triangle of X F^T, which is symmetric here; elements above the diagonal are
// undefined.
ErrorMatrix LowerTimesTransitionTransposed(const Step& step, const ErrorMatrix& X) {
  ErrorMatrix out;
  out.middleCols<3>(kPos) = Columns<kPos>(step, X).Position();
  out.block<kStateDim - kRot, 3>(kRot, kRot) = Columns<kRot>(step, X).Rotation();
  out.block<kStateDim - kVel, 3>(kVel, kVel) = Columns<kVel>(step, X).Velocity();
  constexpr int kRows = kStateDim - kGyroBias;
  out.block<kRows, 6>(kGyroBias, kGyroBias) = X.block<kRows, 6>(kGyroBias, kGyroBias);
  constexpr int kMapRotation = kMapPose + 3;
  out.block<kStateDim - kMapPose, 3>(kMapPose, kMapPose) =
      Columns<kMapPose>(step, X).MapTranslation();
  out.block<kStateDim - kMapRotation, 3>(kMapRotation, kMapRotation) =
      Columns<kMapRotation>(step, X).MapRotation();
  out.block<3, 3>(kMapStart, kMapStart) = X.block<3, 3>(kMapStart, kMapStart);
  return out;
}

// Adds the noise of one step to the lower triangle of P. White noise of PSD S along the imu's axes
// adds S dt to the velocity and S dt^3 / 3 to the position.
void AddNoise(const Step& s, const ProcessNoise& noise, ErrorMatrix& P) {
  const double dt = s.increment.dt_s;
  const Vector3 gyro = dt * GyroPsd(noise);
  const Vector3 vel = dt * AccelPsd(noise);
  const Matrix3 vel_by_world = vel.asDiagonal() * s.R1.transpose();
  const Matrix3 vel_world = s.R1 * vel_by_world;
  P.block<3, 3>(kMapPose, kPos) += dt * dt / 3.0 * vel_by_world;
  P.block<3, 3>(kMapPose, kVel) += 0.5 * dt * vel_by_world;
  P.block<3, 3>(kPos, kPos) += dt * dt / 3.0 * vel_world;
  P.block<3, 3>(kVel, kPos) += 0.5 * dt * vel_world;
  P.block<3, 3>(kVel, kVel) += vel_world;
  const auto add_diagonal = [&P](int row, int col, const Vector3& value) {
    for (int i = 0; i < 3; ++i) P(row + i, col + i) += value[i];
  };
  add_diagonal(kMapPose, kMapPose, dt * dt / 3.0 * vel);
  add_diagonal(kRot, kRot, gyro);
  add_diagonal(kMapPose + 3, kMapPose + 3, gyro);
  add_diagonal(kMapPose + 3, kRot, gyro);
  const auto walk = [dt](double density) { return Vector3::Constant(density * density * dt); };
  add_diagonal(kGyroBias, kGyroBias, walk(noise.gyro_bias_walk_density));
  add_diagonal(kAccelBias, kAccelBias, walk(noise.accel_bias_walk_density));
}

}  // namespace

Vector3 GyroPsd(const ProcessNoise& noise) {
  return noise.shown.gyro_psd.cwiseMax(noise.gyro_density * noise.gyro_density);
}

Vector3 AccelPsd(const ProcessNoise& noise) {
  return noise.shown.accel_psd.cwiseMax(noise.accel_density * noise.accel_density);
}

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

void Propagate(Estimate& estimate, const ImuSample& from, const ImuSample& to,
               const ProcessNoise& noise, const Vector3& g_world) {
  const NavState before = estimate.state;
  estimate.state = PropagateState(before, from, to, g_world);
  estimate.stamp = to.stamp;
  const Step step = MakeStep(before, estimate.state, from, to);
  const ErrorMatrix half = TimesTransitionTransposed(step, estimate.cov);  // P F^T
  estimate.cov = LowerTimesTransitionTransposed(step, half.transpose());   // F P F^T
  AddNoise(step, noise, estimate.cov);
  estimate.cov.triangularView<Eigen::StrictlyUpper>() = estimate.cov.transpose();
}

ImuSample InterpolateSample(const ImuSample& a, const ImuSample& b, Timestamp stamp) {
  const double span_s = SecondsBetween(a.stamp, b.stamp);
  const double fraction =
      span_s > 0 ? std::clamp(SecondsBetween(a.stamp, stamp) / span_s, 0.0, 1.0) : 0.0;
  ImuSample sample;
  sample.stamp = stamp;
  sample.w_imu_radps = a.w_imu_radps + fraction * (b.w_imu_radps - a.w_imu_radps);
  sample.f_imu_mps2 = a.f_imu_mps2 + fraction * (b.f_imu_mps2 - a.f_imu_mps2);
  sample.is_rate_saturated = a.is_rate_saturated || b.is_rate_saturated;
  sample.is_force_saturated = a.is_force_saturated || b.is_force_saturated;
  sample.made_up_w_std_radps = std::max(a.made_up_w_std_radps, b.made_up_w_std_radps);
  sample.made_up_f_std_mps2 = std::max(a.made_up_f_std_mps2, b.made_up_f_std_mps2);
  return sample;
}

}  // namespace lio
