// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shakes sensors on a car's roof as its engine and its wheels do: tones, besides the broadband part
// of the IMU's data file.
//
// The engine is a four-cylinder one with a gearbox and a start-stop system: it fires twice a turn,
// stops when the car has stood for a while, and starts again just before it drives off, which rocks
// the body for half a second. A car that never moves idles, with pauses. Wheels are unbalanced,
// each by its own, and turn at slightly different rates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lio/sim/trajectory.hpp"

namespace lio::sim {

struct CarVibrationParameters {
  // Amplitudes of acceleration; idling cars have 0.05 to 0.15 m/s^2 rms at floor and seat rail, and
  // starts 0.3 to 1 m/s^2 (usual figures of the noise and vibration literature; chosen within).
  double idle_mps2 = 0.08;
  double running_mps2 = 0.05;           // at rest in gear; driving adds to it
  double running_mps2_per_mps = 0.005;  // per m/s of speed
  double start_mps2 = 0.5;
  double stop_mps2 = 0.3;
  double start_decay_s = 0.35;
  double crank_hz = 8.3;         // firing rate while a starter turns the engine, 250 rpm
  double idle_hz = 26.7;         // firing rate at 800 rpm
  double stops_after_s = 1.5;    // after standing this long
  double starts_before_s = 1.0;  // driving off
  double idles_s = 25.0;         // in a car that stays parked: this long
  double pauses_s = 15.0;
  // An unbalance of 20 g at the rim, 0.2 m from the axle, pulls with 4.2 N at 10 m/s; a quarter of
  // a car weighs 375 kg.
  double wheel_mps2_at_10_mps = 0.011;
  double wheel_radius_m = 0.31;
  double wheel_hop_hz = 11.0;  // resonance of the unsprung mass on its tyre
  double wheel_hop_quality = 3.0;
  // The roof lies this far above the axis that the body rocks about, which turns each tone into a
  // rotation.
  double lever_m = 1.5;
};
inline constexpr CarVibrationParameters kCarVibration;

class CarVibration {
 public:
  // Holds what is added to specific force and angular rate.
  struct Shake {
    Vector3 f_imu_mps2 = Vector3::Zero();
    Vector3 w_imu_radps = Vector3::Zero();
  };

  // Looks through the whole trajectory for the times at which the engine runs.
  CarVibration(const Trajectory& trajectory, std::uint64_t seed);

  // Times must ascend from call to call: phases are integrated.
  [[nodiscard]] Shake At(double t_s, double speed_mps);
  [[nodiscard]] bool EngineRunsAt(double t_s) const;

 private:
  static constexpr std::size_t kNumWheels = 4;
  struct Span {
    double begin_s = 0.0;
    double end_s = 0.0;
  };
  [[nodiscard]] Shake Engine(double t_s, double speed_mps, double dt_s);
  [[nodiscard]] Shake Wheels(double speed_mps, double dt_s);
  [[nodiscard]] Shake Rock(double t_s) const;
  [[nodiscard]] Shake Tone(double amplitude_mps2, double frequency_hz, double phase_rad) const;

  std::vector<Span> engine_;  // ascending
  Vector3 direction_;         // in which the engine shakes, imu
  Vector3 axis_;              // about which the body rocks, imu
  std::array<double, kNumWheels> wheel_phase_rad_{};
  std::array<double, kNumWheels> wheel_scale_{};  // factor on the unbalance of each wheel
  std::array<double, kNumWheels> wheel_rate_{};   // turns relative to the mean wheel
  double engine_phase_rad_ = 0.0;
  double last_s_ = 0.0;
  bool has_last_ = false;
};

// Returns the firing rate [Hz] of the engine at a speed; gears are changed in steps.
[[nodiscard]] double FiringRate(double speed_mps);

}  // namespace lio::sim
