// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Initialization at rest: the filter's first state from about a second of inertial samples;
// moving_start.hpp is the initialization in motion. Both give an estimate with its covariance and
// correlations: position and yaw are zero by definition; tilt, velocity and biases are as uncertain
// as the data leave them. State order and frames: filter/nav_state.hpp. Constants:
// initialization_parameters.hpp.
// Also here: how a new initialization continues the path that was published before it.
#pragma once

#include <span>
#include <string>

#include "lio/filter/nav_state.hpp"
#include "lio/imu/initialization_parameters.hpp"
#include "lio/imu/matched_pose.hpp"
#include "lio/imu/rest.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// Returns true when the measured forces contain gravity. The setting `automatic` decides by the
// mean force at rest or in smooth motion: whether its length is nearer to g than to zero.
bool GravityPresent(const ImuStatistics& statistics, const Rig& rig);

struct StartState {
  Estimate estimate;
  Vector3 g_world = Vector3::Zero();  // m/s^2; zero when the measured forces contain no gravity
  std::string how;                    // for messages to users
};

// Returns the state at `stamp`; the vehicle must have stood still during all of `samples`. Tilt
// comes from the mean force, the gyro bias from the mean rate; velocity and bias are unsure by what
// scans show of a motion meanwhile. Throws std::invalid_argument without samples.
[[nodiscard]] StartState StartAtRest(std::span<const ImuSample> samples, Timestamp stamp,
                                     const Rig& rig, const ShownMotion& shown = {});

// Holds the last known position, attitude and velocity of the body.
struct LastFix {
  Timestamp stamp;
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();  // m/s
  Pose T_map_imu;
  Matrix6 pose_cov = Matrix6::Zero();  // position (m, world), right rotation error (rad)
};
// The pose at which a new initialization continues is uncertain by this at least, 1 sigma per axis.
inline constexpr double kPlacedStd_m = kInitializationParameters.at_rest.continued_std_m;
inline constexpr double kPlacedStd_rad = kInitializationParameters.at_rest.continued_std_rad;
// Returns the time since the fix, in seconds, limited to how long a velocity may be extrapolated.
double CoastedSince_s(const LastFix& earlier, Timestamp now);
// Rotates the fix into a level world: its roll and pitch become those of `R_level_imu`, a rotation
// from imu to any level frame, and its velocity turns along. Yaw, position and T_map_imu stay.
void Level(const Quaternion& R_level_imu, LastFix& point);
// Rotates and moves the world of `estimate` so that it continues from the earlier fix: with its
// yaw, or its whole attitude without gravity, and at its position plus the mean of both velocities
// times the time since. The map continues by the same motion. The covariance of position and yaw is
// the fix's plus kPlacedStd and the error of the extrapolation.
void PlaceInWorld(const LastFix& earlier, bool has_gravity, Estimate& estimate);

// Returns the rotation from imu to world that takes `up_imu` to world's z axis by the shortest way
// and then makes the yaw of imu's x axis zero.
Quaternion LevelledRotation(const Vector3& up_imu);

// Returns a message to users: "started <how>: imu tilted by ...".
std::string DescribeStart(const char* how, const Estimate& estimate, bool has_gravity);

}  // namespace lio
