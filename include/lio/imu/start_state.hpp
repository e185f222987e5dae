// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter's first state, from a second of rest; moving_start.hpp has the other way. Both give an
// estimate with an honest covariance, correlations included: position zero and yaw zero by
// definition; tilt, velocity and biases as well as the data say.
#pragma once

#include <span>
#include <string>

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// Mean and spread of a stretch of inertial data.
struct ImuStatistics {
  int num_samples = 0;
  double span_s = 0.0;
  Vector3 mean_w_radps = Vector3::Zero();
  Vector3 mean_f_mps2 = Vector3::Zero();
  double gyro_std_radps = 0.0;  // the largest of the three axes
  double accel_std_mps2 = 0.0;
};
ImuStatistics Summarise(std::span<const ImuSample> samples);

// What shakes a body: of each of the three axes, 1 sigma.
struct VibrationLevel {
  double gyro_std_radps = 0.0;
  double accel_std_mps2 = 0.0;
};
// Is the spread no more than this vibration and the sensors' noise make, which is the more the
// faster they are read?
bool IsCalm(const ImuStatistics& statistics, const ImuRig& imu, const VibrationLevel& vibration);

// Is gravity in the accelerometer's reading? `automatic` goes by the mean's length at rest or in
// smooth motion: nearer to g than to zero.
bool GravityPresent(const ImuStatistics& statistics, const Rig& rig);

struct StartState {
  Estimate estimate;
  Vector3 g_world = Vector3::Zero();  // zero when the accelerometer's reading has none
  std::string how;                    // for people
};

// The vehicle stood still over all of `samples`; the state is for `stamp`.
StartState StartAtRest(std::span<const ImuSample> samples, Timestamp stamp, const Rig& rig);

// Where the body was, and how fast.
struct LastFix {
  Timestamp stamp;
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();  // m/s
  Pose T_map_imu;
  Matrix6 pose_cov = Matrix6::Zero();  // position in world, right rotation error
};
// A start anew is off by this at least.
inline constexpr double kPlacedStd_m = 0.5;
inline constexpr double kPlacedStd_rad = 0.05;
// How long ago that was; no longer than the body may be thought to have gone straight on.
double CoastedSince_s(const LastFix& earlier, Timestamp now);
// The point in a world that is level by what is known now: `R_level_imu`, of any yaw, is the
// attitude there. Yaw, position and map stay.
void Level(const Quaternion& R_level_imu, LastFix& point);
// Turns and moves the world of an estimate so that it goes on from an earlier point: with its yaw,
// without gravity its whole attitude, and from its position by the mean of both velocities. The map
// goes on by the same motion. Position and yaw are as unsure as they were, and some more.
void PlaceInWorld(const LastFix& earlier, bool has_gravity, Estimate& estimate);

// The rotation from imu to world that takes `up_imu` to world's z, without turning about it more
// than needed, and with the imu's x axis at yaw zero.
Quaternion LevelledRotation(const Vector3& up_imu);

// For people: "started <how>: imu tilted by ...".
std::string DescribeStart(const char* how, const Estimate& estimate, bool has_gravity);

}  // namespace lio
