// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives motions by formulas, and the samples of a perfect IMU along them.
//
// A motion is a pose of imu in world at any instant, several times differentiable; rates and
// accelerations are five-point differences of it, accurate to about 1e-8.
#pragma once

#include <functional>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio::test {

using Motion = std::function<Pose(double t_s)>;

inline const Vector3 kGravity{0, 0, -9.80665};  // g_world

// Tests count seconds from this stamp, which is one that real drives may have.
inline constexpr Timestamp kEpoch{1'700'000'000'000'000'000};
constexpr Timestamp StampAt(double t_s) {
  return kEpoch + Duration::FromSeconds(t_s);
}
constexpr double SecondsOf(Timestamp stamp) {
  return SecondsBetween(kEpoch, stamp);
}

struct MotionState {
  Pose T_world_imu;
  Vector3 v_world_imu;  // m/s
  Vector3 a_world_imu;  // m/s^2
  Vector3 w_imu;        // rad/s, in imu
};
MotionState StateOf(const Motion& motion, double t_s);

// Returns the sample of an IMU without errors.
ImuSample ExactSample(const Motion& motion, double t_s, const Vector3& g_world = kGravity);
std::vector<ImuSample> ExactSamples(const Motion& motion, double from_s, double to_s, double step_s,
                                    const Vector3& g_world = kGravity);

// Returns a motion that swings in all six directions and is never at rest, with metres and radians
// of order one.
Motion Tumble();
// Returns a motion that rests at the origin for `rest_s`, then drives off along a winding road: it
// reaches 8 m/s within 4 s, and the body rolls and pitches by a degree. At rest yaw is zero and the
// body level.
Motion WindingDrive(double rest_s);
// Returns the same motion on a straight road.
Motion StraightDrive(double rest_s);

}  // namespace lio::test
