// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/car_vibration.hpp"

#include <algorithm>
#include <cmath>

#include "lio/base/angle.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

constexpr double kMoving_mps = 0.1;
constexpr double kLook_s = 0.1;
constexpr double kMinRevs_hz = 1400.0 / 60.0;  // a driver changes up when the next gear has this
constexpr std::array<double, 6> kGears_mps_per_hz = {0.125, 0.225, 0.33, 0.45, 0.58, 0.72};

void Add(CarVibration::Shake& sum, const CarVibration::Shake& part) {
  sum.f_imu_mps2 += part.f_imu_mps2;
  sum.w_imu_radps += part.w_imu_radps;
}

Vector3 UnitVector(Random& random) {
  const double x = random.Gaussian();
  const double y = random.Gaussian();
  return Vector3(x, y, random.Gaussian()).normalized();
}

}  // namespace

double FiringRate(double speed_mps) {
  std::size_t gear = 0;
  while (gear + 1 < kGears_mps_per_hz.size() &&
         speed_mps > kMinRevs_hz * kGears_mps_per_hz[gear + 1]) {
    ++gear;
  }
  return std::max(kCarVibration.idle_hz, 2.0 * speed_mps / kGears_mps_per_hz[gear]);
}

CarVibration::CarVibration(const Trajectory& trajectory, std::uint64_t seed) {
  const CarVibrationParameters& p = kCarVibration;
  Random random(seed, Purpose::kEngine);
  direction_ = UnitVector(random);
  axis_ = UnitVector(random);
  for (std::size_t i = 0; i < kNumWheels; ++i) {
    wheel_phase_rad_[i] = random.Uniform(0.0, kTurn_rad);
    wheel_scale_[i] = random.Uniform(0.3, 1.7);
    wheel_rate_[i] = 1.0 + 0.005 * random.Gaussian();
  }
  const double end_s = trajectory.duration_s();
  for (double t_s = 0.0; t_s <= end_s; t_s += kLook_s) {
    if (trajectory.At(t_s).v_world_mps.norm() < kMoving_mps) continue;
    const Span span{t_s - p.starts_before_s, t_s + p.stops_after_s};
    if (!engine_.empty() && span.begin_s <= engine_.back().end_s) {
      engine_.back().end_s = span.end_s;
    } else {
      engine_.push_back(span);
    }
  }
  if (!engine_.empty()) return;
  for (double t_s = 0.0; t_s <= end_s; t_s += p.idles_s + p.pauses_s) {
    engine_.push_back({t_s, t_s + p.idles_s});
  }
}

bool CarVibration::EngineRunsAt(double t_s) const {
  return std::any_of(engine_.begin(), engine_.end(),
                     [&](const Span& span) { return t_s >= span.begin_s && t_s < span.end_s; });
}

CarVibration::Shake CarVibration::Tone(double amplitude_mps2, double frequency_hz,
                                       double phase_rad) const {
  const double rate_radps = amplitude_mps2 / (kTurn_rad * frequency_hz * kCarVibration.lever_m);
  return {amplitude_mps2 * std::sin(phase_rad) * direction_,
          rate_radps * std::cos(phase_rad) * axis_};
}

CarVibration::Shake CarVibration::Engine(double t_s, double speed_mps, double dt_s) {
  const CarVibrationParameters& p = kCarVibration;
  if (!EngineRunsAt(t_s)) return {};
  const double frequency_hz = FiringRate(speed_mps);
  engine_phase_rad_ = std::fmod(engine_phase_rad_ + kTurn_rad * frequency_hz * dt_s, kTurn_rad);
  const bool is_idle = speed_mps < kMoving_mps;
  const double amplitude =
      is_idle ? p.idle_mps2 : p.running_mps2 + p.running_mps2_per_mps * speed_mps;
  return Tone(amplitude, frequency_hz, engine_phase_rad_);
}

// Returns the body's rocking after the engine has started or stopped.
CarVibration::Shake CarVibration::Rock(double t_s) const {
  const CarVibrationParameters& p = kCarVibration;
  Shake sum;
  const auto add = [&](double event_s, double amplitude) {
    const double since_s = t_s - event_s;
    if (since_s < 0.0 || since_s > 8.0 * p.start_decay_s) return;
    const double left = amplitude * std::exp(-since_s / p.start_decay_s);
    Add(sum, Tone(left, p.crank_hz, kTurn_rad * p.crank_hz * since_s));
  };
  for (const Span& span : engine_) {
    add(span.begin_s, p.start_mps2);
    add(span.end_s, p.stop_mps2);
  }
  return sum;
}

CarVibration::Shake CarVibration::Wheels(double speed_mps, double dt_s) {
  const CarVibrationParameters& p = kCarVibration;
  Shake sum;
  if (speed_mps < kMoving_mps) return sum;
  const double relative = speed_mps / 10.0;
  for (std::size_t i = 0; i < kNumWheels; ++i) {
    const double frequency_hz = wheel_rate_[i] * speed_mps / (kTurn_rad * p.wheel_radius_m);
    wheel_phase_rad_[i] =
        std::fmod(wheel_phase_rad_[i] + kTurn_rad * frequency_hz * dt_s, kTurn_rad);
    const double ratio = frequency_hz / p.wheel_hop_hz;
    const double gain = 1.0 / std::hypot(1.0 - ratio * ratio, ratio / p.wheel_hop_quality);
    const double amplitude = gain * wheel_scale_[i] * p.wheel_mps2_at_10_mps * relative * relative;
    Shake wheel = Tone(amplitude, frequency_hz, wheel_phase_rad_[i]);
    wheel.f_imu_mps2 = amplitude * std::sin(wheel_phase_rad_[i]) * Vector3::UnitZ();
    Add(sum, wheel);
  }
  return sum;
}

CarVibration::Shake CarVibration::At(double t_s, double speed_mps) {
  const double dt_s = has_last_ ? t_s - last_s_ : 0.0;
  last_s_ = t_s;
  has_last_ = true;
  Shake sum = Engine(t_s, speed_mps, dt_s);
  Add(sum, Rock(t_s));
  Add(sum, Wheels(speed_mps, dt_s));
  return sum;
}

}  // namespace lio::sim
