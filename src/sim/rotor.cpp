// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/rotor.hpp"

#include <cmath>
#include <numbers>

#include "lio/base/angle.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

// The controller hunts slowly, and disturbances pass within a few turns. Chosen.
constexpr std::array<std::array<double, 2>, 2> kWobble_hz = {{{0.2, 0.6}, {1.0, 3.0}}};

Matrix3 AboutZ(double heading_rad) {
  return Eigen::AngleAxisd(heading_rad, Vector3::UnitZ()).toRotationMatrix();
}

// Small deflections in different directions add up.
Matrix3 DeflectedBy(const Rosette& rosette, double middle_rad, double t_s) {
  double left_rad = middle_rad;
  double up_rad = 0.0;
  for (const double prism_hz : rosette.prism_hz) {
    left_rad += rosette.deflection_rad * std::cos(kTurn_rad * prism_hz * t_s);
    up_rad += rosette.deflection_rad * std::sin(kTurn_rad * prism_hz * t_s);
  }
  return AboutZ(left_rad) * Eigen::AngleAxisd(-up_rad, Vector3::UnitY()).toRotationMatrix();
}

}  // namespace

Rotor::Rotor(const LidarModel& model, const RotorErrors& errors, std::uint64_t seed, double begin_s)
    : rotation_hz_(model.rotation_hz),
      column_period_s_(model.column_period_s),
      cut_azimuth_rad_(model.cut_azimuth_rad),
      begin_s_(begin_s),
      view_azimuth_rad_(model.view_azimuth_rad),
      rosette_(model.rosette),
      wobbles_(errors.speed_std_ratio > 0.0) {
  Random random(seed, Purpose::kRotor);
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    Wave& wave = waves_[i];
    wave.frequency_hz = random.Uniform(kWobble_hz[i][0], kWobble_hz[i][1]);
    wave.phase_rad = random.Uniform(0.0, kTurn_rad);
    // Two waves of this amplitude in speed have that spread together.
    wave.amplitude_turns = errors.speed_std_ratio * rotation_hz_ / (kTurn_rad * wave.frequency_hz);
  }
  encoder_rad_ = std::numbers::sqrt2 * errors.encoder_std_rad;
  encoder_phase_rad_ = random.Uniform(0.0, kTurn_rad);
}

double Rotor::ColumnTime(std::int64_t column) const {
  return begin_s_ + static_cast<double>(column) * column_period_s_;
}

double Rotor::TurnsAt(double t_s) const {
  double turns = (t_s - begin_s_) * rotation_hz_;
  if (!wobbles_) return turns;
  for (const Wave& wave : waves_) {
    const double angle = kTurn_rad * wave.frequency_hz * (t_s - begin_s_) + wave.phase_rad;
    turns += wave.amplitude_turns * (std::sin(angle) - std::sin(wave.phase_rad));
  }
  return turns;
}

double Rotor::HeadingAt(double t_s) const {
  const double turns = TurnsAt(t_s);
  return cut_azimuth_rad_ - kTurn_rad * (turns - std::floor(turns));
}

double Rotor::ReportedHeadingAt(double t_s) const {
  const double heading = HeadingAt(t_s);
  if (encoder_rad_ == 0.0) return heading;
  return heading + encoder_rad_ * std::sin(heading + encoder_phase_rad_);
}

Matrix3 Rotor::OrientationAt(double t_s) const {
  return rosette_ ? DeflectedBy(*rosette_, view_azimuth_rad_, t_s - begin_s_)
                  : AboutZ(HeadingAt(t_s));
}

Matrix3 Rotor::ReportedOrientationAt(double t_s) const {
  return rosette_ ? DeflectedBy(*rosette_, view_azimuth_rad_, t_s - begin_s_)
                  : AboutZ(ReportedHeadingAt(t_s));
}

std::int64_t Rotor::FirstColumnOf(std::int64_t turn) const {
  const double per_turn = 1.0 / (rotation_hz_ * column_period_s_);
  // The margin keeps exact divisors exact.
  auto column = static_cast<std::int64_t>(std::ceil(static_cast<double>(turn) * per_turn - 1e-6));
  if (!wobbles_ || turn <= 0) return column;
  const auto wanted = static_cast<double>(turn);
  while (TurnsAt(ColumnTime(column)) < wanted) ++column;
  while (TurnsAt(ColumnTime(column - 1)) >= wanted) --column;
  return column;
}

TurnColumns Rotor::ColumnsOf(std::int64_t turn) const {
  TurnColumns columns;
  columns.first = FirstColumnOf(turn);
  columns.num = FirstColumnOf(turn + 1) - columns.first;
  columns.begin_s = ColumnTime(columns.first);
  columns.end_s = ColumnTime(columns.first + columns.num);
  return columns;
}

}  // namespace lio::sim
