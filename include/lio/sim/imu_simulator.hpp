// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates an IMU that moves along a trajectory: it measures specific force and angular rate at
// its sample instants, with the errors of its model.
//
//   gyro  = clip(round(M_g w + b_g + n_g)),   accel = clip(round(M_a f + b_a + n_a)),
//   f = R_imu_world (a - g_world)
//
// A sample of white noise n has sigma density / sqrt(dt), and a random walk steps by density
// sqrt(dt). The bias b is turn-on bias + random walk + a first-order Gauss-Markov process (bias
// instability). M is I + scale and misalignment errors. The Earth's rotation (15 deg/h) is left
// out.
//
// On a vehicle, effects are added that data sheets leave to the user: vibration of a moving body,
// white noise that grows with its speed; tones of engine and wheels (car_vibration.hpp); biases
// that shift with vibration (rectification) and with the unit's temperature; and rates that a gyro
// shows under acceleration (g-sensitivity). They draw from random streams of their own.
#pragma once

#include <cstdint>
#include <optional>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sim/car_vibration.hpp"
#include "lio/sim/imu_model.hpp"
#include "lio/sim/random.hpp"
#include "lio/sim/trajectory.hpp"

namespace lio::sim {

// Names the units and axes in which the IMU's driver sends its samples; see docs/simulator.md.
enum class ImuVariant {
  kNormal,          // specific force in m/s^2, rates in rad/s, axes as in the rig
  kGravityRemoved,  // gravity is removed with the true attitude
  kInG,             // accelerations in units of 9.80665 m/s^2
  kInDeg,           // rates in deg/s
  kInGAndDeg,
  kZDown,   // x forward, y right, z down, while the rig has x forward, y left, z up
  kTurned,  // x right, y forward, z up
};

struct ImuEffects {
  bool vibrates = false;    // broadband, with the model's vibration while the body moves
  bool has_engine = false;  // tones of engine and wheels
  bool rectifies = false;   // vibration shifts the biases
  bool is_g_sensitive = false;
  bool warms_up = false;  // the temperature, and with it the biases, drift after switching on
};

struct ImuSetup {
  ImuModel model;
  ImuVariant variant = ImuVariant::kNormal;
  double gravity_mps2 = 9.80665;
  ImuEffects effects;
  std::uint64_t seed = 1;
};

// Rectification takes place at the sensing element, which feels vibration up to about 1 kHz, while
// samples show what the unit's low-pass filter of about 50 Hz leaves: of white acceleration, a root
// mean square 4.5 times as large. Chosen: 5, which on a car at 10 m/s is 0.6 m/s^2 (Xsens).
inline constexpr double kElementVibrationRatio = 5.0;

// Holds one instant's measurement and its true values.
struct SimulatedImu {
  ImuSample sample;  // stamp is trajectory time; units are not SI in some variants
  Kinematics truth;
  Vector3 gyro_bias_radps = Vector3::Zero();
  Vector3 accel_bias_mps2 = Vector3::Zero();
};

class ImuSimulator {
 public:
  // Keeps a reference to the trajectory, which must outlive the simulator.
  ImuSimulator(const ImuSetup& setup, const Trajectory& trajectory);

  // Returns the sample at a trajectory time; times must ascend by the model's period.
  [[nodiscard]] SimulatedImu Sample(std::int64_t t_ns);

 private:
  // Holds what a vehicle does to the unit at one instant; all zero: nothing.
  struct Stress {
    double vibrating_mps = 0.0;                // the speed that shakes the sensor
    double element_var_mps4 = 0.0;             // vibration of the sensing elements
    double warmer_kelvin = 0.0;                // than when it was switched on
    Vector3 force_imu_mps2 = Vector3::Zero();  // to which a gyro is sensitive
  };

  struct Streams {
    Random random;
    Random vibration;
    Random field;
  };

  // Draws the errors of three equal axes.
  class Triad {
   public:
    Triad(const InertialModel& model, double dt_s, const Streams& streams);
    [[nodiscard]] Vector3 Measure(const Vector3& truth, const Stress& stress);
    const Vector3& bias() const { return bias_; }

   private:
    [[nodiscard]] static Vector3 Noise(Random& random, double sigma);
    [[nodiscard]] Vector3 Noise(double sigma) { return Noise(random_, sigma); }

    InertialModel model_;
    double dt_s_;
    Random random_;
    Random vibration_;
    Matrix3 coupling_ = Matrix3::Identity();
    Matrix3 g_sensitivity_ = Matrix3::Zero();
    Vector3 per_kelvin_ = Vector3::Zero();
    Vector3 per_vibration_ = Vector3::Zero();
    Vector3 turn_on_ = Vector3::Zero();
    Vector3 walk_ = Vector3::Zero();
    Vector3 slow_ = Vector3::Zero();
    Vector3 bias_ = Vector3::Zero();
  };

  [[nodiscard]] static Streams StreamsOf(std::uint64_t seed, std::uint64_t triad);
  [[nodiscard]] Stress StressAt(double t_s, const Kinematics& truth, const Vector3& f_imu);

  ImuSetup setup_;
  const Trajectory* trajectory_;
  std::optional<CarVibration> car_;
  std::optional<double> switched_on_s_;  // time of the first sample
  Triad gyro_;
  Triad accel_;
};

// Returns normal gravity [m/s^2] at sea level and above (WGS 84, Somigliana's formula with free-air
// correction).
[[nodiscard]] double NormalGravity(double latitude_rad, double altitude_m);

}  // namespace lio::sim
