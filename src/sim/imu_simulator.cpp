// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/imu_simulator.hpp"

#include <algorithm>
#include <cmath>

#include "lio/base/angle.hpp"

namespace lio::sim {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;  // "1 g" as data sheets define it

// Converts a sample to the units and axes in which the variant's driver sends it.
void Disguise(ImuVariant variant, const Vector3& g_imu, ImuSample& sample) {
  Vector3& w = sample.w_imu_radps;
  Vector3& f = sample.f_imu_mps2;
  const bool is_in_g = variant == ImuVariant::kInG || variant == ImuVariant::kInGAndDeg;
  const bool is_in_deg = variant == ImuVariant::kInDeg || variant == ImuVariant::kInGAndDeg;
  if (variant == ImuVariant::kGravityRemoved) f += g_imu;
  if (is_in_g) f /= kStandardGravity_mps2;
  if (is_in_deg) w *= kDegPerRad;
  if (variant == ImuVariant::kZDown) {
    w = Vector3(w.x(), -w.y(), -w.z());
    f = Vector3(f.x(), -f.y(), -f.z());
  } else if (variant == ImuVariant::kTurned) {
    w = Vector3(-w.y(), w.x(), w.z());
    f = Vector3(-f.y(), f.x(), f.z());
  }
}

}  // namespace

ImuSimulator::Triad::Triad(const InertialModel& model, double dt_s, const Streams& streams)
    : model_(model), dt_s_(dt_s), random_(streams.random), vibration_(streams.vibration) {
  turn_on_ = Noise(model.turn_on_bias_std);
  slow_ = Noise(model.bias_instability);
  bias_ = turn_on_ + slow_;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const double std = r == c ? model.scale_std_ratio : model.misalignment_std_rad;
      coupling_(r, c) += std * random_.Gaussian();
    }
  }
  Random field = streams.field;
  per_kelvin_ = Noise(field, model.bias_per_kelvin_std);
  per_vibration_ = Noise(field, model.bias_per_vibration_std);
  for (int c = 0; c < 3; ++c) g_sensitivity_.col(c) = Noise(field, model.bias_per_force_std);
}

Vector3 ImuSimulator::Triad::Noise(Random& random, double sigma) {
  const double x = random.Gaussian();
  const double y = random.Gaussian();
  return sigma * Vector3(x, y, random.Gaussian());
}

Vector3 ImuSimulator::Triad::Measure(const Vector3& truth, const Stress& stress) {
  bias_ = turn_on_ + walk_ + slow_ + stress.warmer_kelvin * per_kelvin_ +
          stress.element_var_mps4 * per_vibration_;
  Vector3 out = coupling_ * truth + bias_ + Noise(model_.noise_density / std::sqrt(dt_s_));
  out += Noise(vibration_, model_.vibration_std_per_mps * stress.vibrating_mps);
  out += g_sensitivity_ * stress.force_imu_mps2;
  walk_ += Noise(model_.bias_walk_density * std::sqrt(dt_s_));
  const double decay = std::exp(-dt_s_ / model_.bias_instability_time_s);
  slow_ = decay * slow_ + Noise(model_.bias_instability * std::sqrt(1.0 - decay * decay));
  for (double& axis : out) {
    if (model_.full_scale > 0.0) axis = std::clamp(axis, -model_.full_scale, model_.full_scale);
    if (model_.step > 0.0) axis = model_.step * std::round(axis / model_.step);
  }
  return out;
}

ImuSimulator::Streams ImuSimulator::StreamsOf(std::uint64_t seed, std::uint64_t triad) {
  return {Random(seed, Purpose::kImu, triad), Random(seed, Purpose::kVibration, triad),
          Random(seed, Purpose::kImuField, triad)};
}

ImuSimulator::ImuSimulator(const ImuSetup& setup, const Trajectory& trajectory)
    : setup_(setup),
      trajectory_(&trajectory),
      gyro_(setup.model.gyro, 1.0 / setup.model.rate_hz, StreamsOf(setup.seed, 1)),
      accel_(setup.model.accel, 1.0 / setup.model.rate_hz, StreamsOf(setup.seed, 2)) {
  if (setup.effects.has_engine) car_.emplace(trajectory, setup.seed);
}

ImuSimulator::Stress ImuSimulator::StressAt(double t_s, const Kinematics& truth,
                                            const Vector3& f_imu) {
  const ImuEffects& effects = setup_.effects;
  const double speed_mps = truth.v_world_mps.norm();
  if (!switched_on_s_) switched_on_s_ = t_s;
  Stress stress;
  if (effects.vibrates) stress.vibrating_mps = speed_mps;
  if (effects.rectifies) {
    const double at_element =
        kElementVibrationRatio * setup_.model.accel.vibration_std_per_mps * speed_mps;
    stress.element_var_mps4 = at_element * at_element;
  }
  if (effects.warms_up) {
    const double since_s = t_s - *switched_on_s_;
    stress.warmer_kelvin =
        setup_.model.warm_up_kelvin * (1.0 - std::exp(-since_s / setup_.model.warm_up_time_s));
  }
  if (effects.is_g_sensitive) stress.force_imu_mps2 = f_imu;
  return stress;
}

SimulatedImu ImuSimulator::Sample(std::int64_t t_ns) {
  SimulatedImu out;
  const double t_s = static_cast<double>(t_ns) * 1e-9;
  out.truth = trajectory_->At(t_s);
  const Vector3 g_world(0.0, 0.0, -setup_.gravity_mps2);
  const Quaternion R_imu_world = out.truth.T_world_imu.rotation.conjugate();
  Vector3 f_imu = R_imu_world * (out.truth.a_world_mps2 - g_world);
  Vector3 w_imu = out.truth.w_imu_radps;
  if (car_) {
    const CarVibration::Shake shake = car_->At(t_s, out.truth.v_world_mps.norm());
    f_imu += shake.f_imu_mps2;
    w_imu += shake.w_imu_radps;
  }
  const Stress stress = StressAt(t_s, out.truth, f_imu);
  out.sample.stamp = {t_ns};
  out.sample.w_imu_radps = gyro_.Measure(w_imu, stress);
  // An accelerometer's sensitivity to force is its scale.
  out.sample.f_imu_mps2 = accel_.Measure(f_imu, stress);
  out.gyro_bias_radps = gyro_.bias();
  out.accel_bias_mps2 = accel_.bias();
  Disguise(setup_.variant, R_imu_world * g_world, out.sample);
  return out;
}

double NormalGravity(double latitude_rad, double altitude_m) {
  const double s = std::sin(latitude_rad) * std::sin(latitude_rad);
  const double sea_level =
      9.7803253359 * (1.0 + 0.00193185265241 * s) / std::sqrt(1.0 - 0.00669437999013 * s);
  return sea_level - 3.086e-6 * altitude_m;
}

}  // namespace lio::sim
