// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the analytic motion of a body: pose, velocity, acceleration and angular rate at any time,
// each the exact derivative of the other.
//
// Position and yaw, pitch, roll of the body are uniform quintic B-splines in time (C4). Sinusoids
// are added to them (suspension, road roughness, a walker's gait), whose common strength is a
// B-spline, too. The body frame lies on the ground below the vehicle or walker: x forward, y left,
// z up; R_world_body = Rz(yaw) Ry(pitch) Rx(roll), pitch within +-80 deg. World is z up. B-spline
// curves stay near their knots without passing through them; equal knots mean rest.
#pragma once

#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sim/jet.hpp"

namespace lio::sim {

// A knot is a control point of the spline. `liveliness` scales the oscillations: 0 at rest, 1 in
// full motion.
struct BodyKnot {
  Vector3 position_m = Vector3::Zero();
  double yaw_rad = 0.0;  // unwrapped
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double liveliness = 0.0;
};

enum class BodyAxis { kX, kY, kZ, kYaw, kPitch, kRoll };

struct Oscillation {
  BodyAxis axis = BodyAxis::kZ;  // kX, kY: along world axes
  double amplitude = 0.0;        // m or rad
  double frequency_hz = 1.0;
  double phase_rad = 0.0;
};

struct MotionPlan {
  double knot_interval_s = 0.25;
  std::vector<BodyKnot> knots;  // at least two; the first holds at t = 0
  std::vector<Oscillation> oscillations;
  Pose T_body_imu;
};

// Holds position, velocity and acceleration a of the IMU's origin in world, and the angular rate w
// of imu relative to world, at one instant.
struct Kinematics {
  Pose T_world_imu;
  Vector3 v_world_mps = Vector3::Zero();
  Vector3 a_world_mps2 = Vector3::Zero();
  Vector3 w_imu_radps = Vector3::Zero();
};

class Trajectory {
 public:
  // Throws std::invalid_argument when the plan has fewer than two knots or an interval that is not
  // positive.
  explicit Trajectory(MotionPlan plan);

  // Accepts any t; before the first and after the last knot the body rests there. It is safe from
  // any thread.
  [[nodiscard]] Kinematics At(double t_s) const;
  // Returns the pose of the body frame on the ground, which surrounding traffic and the carrier's
  // shape follow.
  [[nodiscard]] Pose BodyPoseAt(double t_s) const;

  [[nodiscard]] double duration_s() const;
  [[nodiscard]] const Pose& T_body_imu() const { return plan_.T_body_imu; }

 private:
  struct BodyJets;
  [[nodiscard]] BodyJets BodyAt(double t_s) const;

  MotionPlan plan_;
};

}  // namespace lio::sim
