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
// instability). M is I + scale and misalignment errors. Vibration of a moving body adds white noise
// that grows with its speed. The Earth's rotation (15 deg/h) is left out.
#pragma once

#include <cstdint>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sim/imu_model.hpp"
#include "lio/sim/random.hpp"
#include "lio/sim/trajectory.hpp"

namespace lio::sim {

// The units and axes in which the IMU's driver sends its samples; see docs/simulator.md.
enum class ImuVariant {
  kNormal,          // specific force in m/s^2, rates in rad/s, axes as in the rig
  kGravityRemoved,  // gravity is removed with the true attitude
  kInG,             // accelerations in units of 9.80665 m/s^2
  kInDeg,           // rates in deg/s
  kInGAndDeg,
  kZDown,   // x forward, y right, z down, while the rig has x forward, y left, z up
  kTurned,  // x right, y forward, z up
};

struct ImuSetup {
  ImuModel model;
  ImuVariant variant = ImuVariant::kNormal;
  double gravity_mps2 = 9.80665;
  bool vibrates = false;  // with the model's vibration while the body moves
  std::uint64_t seed = 1;
};

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
  SimulatedImu Sample(std::int64_t t_ns);

 private:
  // Draws the errors of three equal axes.
  class Triad {
   public:
    Triad(const InertialModel& model, double dt_s, Random random, Random vibration);
    // `vibrating_mps`: the speed that shakes the sensor.
    Vector3 Measure(const Vector3& truth, double vibrating_mps);
    const Vector3& bias() const { return bias_; }

   private:
    static Vector3 Noise(Random& random, double sigma);
    Vector3 Noise(double sigma) { return Noise(random_, sigma); }

    InertialModel model_;
    double dt_s_;
    Random random_;
    Random vibration_;
    Matrix3 coupling_ = Matrix3::Identity();
    Vector3 turn_on_ = Vector3::Zero();
    Vector3 walk_ = Vector3::Zero();
    Vector3 slow_ = Vector3::Zero();
    Vector3 bias_ = Vector3::Zero();
  };

  ImuSetup setup_;
  const Trajectory* trajectory_;
  Triad gyro_;
  Triad accel_;
};

// Returns normal gravity [m/s^2] at sea level and above (WGS 84, Somigliana's formula with free-air
// correction).
double NormalGravity(double latitude_rad, double altitude_m);

}  // namespace lio::sim
