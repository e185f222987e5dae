// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/trajectory.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace lio::sim {
namespace {

constexpr int kNumChannels = 7;  // the six axes in the order of BodyAxis, then liveliness
using Channels = std::array<Jet, kNumChannels>;
using JetVector = std::array<Jet, 3>;
using JetMatrix = std::array<JetVector, 3>;  // rows

// Returns the weights of six neighbouring knots at u in [0, 1) with their derivatives by u: a
// uniform quintic B-spline, see de Boor, "A Practical Guide to Splines", ch. X.
std::array<Jet, 6> SplineWeights(double u) {
  std::array<Jet, 6> weights;
  // N(x) = 1/120 sum_k (-1)^k C(6, k) max(x - k, 0)^5 on its support [0, 6]; knot j is at x = u + 5
  // - j.
  constexpr std::array<double, 6> kBinomial = {1, -6, 15, -20, 15, -6};
  for (int j = 0; j < 6; ++j) {
    const double x = u + 5.0 - j;
    Jet& weight = weights[static_cast<std::size_t>(j)];
    for (int k = 0; k <= 5 - j; ++k) {
      const double d = x - k;
      const double c = kBinomial[static_cast<std::size_t>(k)] / 120.0;
      weight.value += c * d * d * d * d * d;
      weight.rate += 5.0 * c * d * d * d * d;
      weight.accel += 20.0 * c * d * d * d;
    }
  }
  return weights;
}

std::array<double, kNumChannels> ChannelValues(const BodyKnot& knot) {
  return {knot.position_m.x(), knot.position_m.y(), knot.position_m.z(), knot.yaw_rad,
          knot.pitch_rad,      knot.roll_rad,       knot.liveliness};
}

Channels EvaluateSpline(const MotionPlan& plan, double t_s) {
  const double h = plan.knot_interval_s;
  const auto last = static_cast<std::int64_t>(plan.knots.size()) - 1;
  const double x = std::clamp(t_s / h, -3.0, static_cast<double>(last) + 3.0);
  const auto base = static_cast<std::int64_t>(std::floor(x));
  const std::array<Jet, 6> weights = SplineWeights(x - static_cast<double>(base));
  Channels channels;
  for (std::int64_t j = 0; j < 6; ++j) {
    const std::int64_t index = std::clamp<std::int64_t>(base - 2 + j, 0, last);
    const auto values = ChannelValues(plan.knots[static_cast<std::size_t>(index)]);
    const Jet& w = weights[static_cast<std::size_t>(j)];
    const Jet weight = {w.value, w.rate / h, w.accel / (h * h)};
    for (std::size_t c = 0; c < kNumChannels; ++c) channels[c] = channels[c] + values[c] * weight;
  }
  return channels;
}

JetMatrix RotationJets(const Jet& yaw, const Jet& pitch, const Jet& roll) {
  const SinCos z = SinCosOf(yaw);
  const SinCos y = SinCosOf(pitch);
  const SinCos x = SinCosOf(roll);
  const Jet sin_y_sin_x = y.sin * x.sin;
  const Jet sin_y_cos_x = y.sin * x.cos;
  return {
      {{z.cos * y.cos, z.cos * sin_y_sin_x - z.sin * x.cos, z.cos * sin_y_cos_x + z.sin * x.sin},
       {z.sin * y.cos, z.sin * sin_y_sin_x + z.cos * x.cos, z.sin * sin_y_cos_x - z.cos * x.sin},
       {-1.0 * y.sin, y.cos * x.sin, y.cos * x.cos}}};
}

Quaternion RotationOf(double yaw, double pitch, double roll) {
  return Quaternion(Eigen::AngleAxisd(yaw, Vector3::UnitZ()) *
                    Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
                    Eigen::AngleAxisd(roll, Vector3::UnitX()));
}

// Returns the angular rate of the body relative to world, in body axes, from the rates of R = Rz Ry
// Rx.
Vector3 BodyRate(const Jet& yaw, const Jet& pitch, const Jet& roll) {
  const double sin_roll = std::sin(roll.value);
  const double cos_roll = std::cos(roll.value);
  const double sin_pitch = std::sin(pitch.value);
  const double cos_pitch = std::cos(pitch.value);
  return {roll.rate - sin_pitch * yaw.rate, cos_roll * pitch.rate + sin_roll * cos_pitch * yaw.rate,
          -sin_roll * pitch.rate + cos_roll * cos_pitch * yaw.rate};
}

}  // namespace

struct Trajectory::BodyJets {
  JetVector position;
  Jet yaw;
  Jet pitch;
  Jet roll;
};

Trajectory::Trajectory(MotionPlan plan) : plan_(std::move(plan)) {
  if (plan_.knots.size() < 2 || !(plan_.knot_interval_s > 0.0)) {
    throw std::invalid_argument(
        "Trajectory: at least two knots and a positive interval between them are needed");
  }
}

double Trajectory::duration_s() const {
  return plan_.knot_interval_s * static_cast<double>(plan_.knots.size() - 1);
}

Trajectory::BodyJets Trajectory::BodyAt(double t_s) const {
  Channels channels = EvaluateSpline(plan_, t_s);
  const Jet liveliness = channels[kNumChannels - 1];
  if (liveliness.value != 0.0 || liveliness.accel != 0.0) {
    for (const Oscillation& wave : plan_.oscillations) {
      const double omega = 2.0 * std::numbers::pi * wave.frequency_hz;
      const SinCos phase = SinCosOf({omega * t_s + wave.phase_rad, omega, 0.0});
      Jet& channel = channels[static_cast<std::size_t>(wave.axis)];
      channel = channel + wave.amplitude * (liveliness * phase.sin);
    }
  }
  return {{channels[0], channels[1], channels[2]}, channels[3], channels[4], channels[5]};
}

Kinematics Trajectory::At(double t_s) const {
  const BodyJets body = BodyAt(t_s);
  const JetMatrix rotation = RotationJets(body.yaw, body.pitch, body.roll);
  const Vector3& lever = plan_.T_body_imu.translation;
  Kinematics out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Jet imu = body.position[i] + lever.x() * rotation[i][0] + lever.y() * rotation[i][1] +
                    lever.z() * rotation[i][2];
    const auto row = static_cast<Eigen::Index>(i);
    out.T_world_imu.translation[row] = imu.value;
    out.v_world_mps[row] = imu.rate;
    out.a_world_mps2[row] = imu.accel;
  }
  const Quaternion& body_imu = plan_.T_body_imu.rotation;
  out.T_world_imu.rotation =
      (RotationOf(body.yaw.value, body.pitch.value, body.roll.value) * body_imu).normalized();
  out.w_imu_radps = body_imu.conjugate() * BodyRate(body.yaw, body.pitch, body.roll);
  return out;
}

Pose Trajectory::BodyPoseAt(double t_s) const {
  const BodyJets body = BodyAt(t_s);
  return {RotationOf(body.yaw.value, body.pitch.value, body.roll.value),
          {body.position[0].value, body.position[1].value, body.position[2].value}};
}

}  // namespace lio::sim
