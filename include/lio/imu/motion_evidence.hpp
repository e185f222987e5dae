// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares poses from scan matching with the inertial samples between them, over the last 10 s, and
// scores how badly an IMU convention contradicts the poses.
//
//   turns   phi_k = Log(R_k-1^T R_k)           against  s R w_k dt + bias,
//   bends   second difference of positions     against  the mean of R_map_imu s R f + g.
//
// Here w and f are the means as sent, R a turn of their axes, s a unit, and g a vector of known
// length and free direction for each map. Scores are chi-squares. A second difference of positions
// is exactly the mean acceleration under a triangular weight over its three positions, so vibration
// does not disturb it. Constants: MotionEvidenceParameters. Nothing throws.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

class MotionEvidence {
 public:
  // Poses to come are in another map; evidence after `from` is discarded.
  void BeginMap(Timestamp from);
  // Adds a matched pose, later than the one before, and the samples since that pose, as sent.
  void AddPose(const StampedPose& T_map_imu, std::span<const ImuSample> sent);

  // Holds the motion from one pose to the next.
  struct Step {
    int map = 0;
    StampedPose from, to;    // T_map_imu
    Vector3 turn_rad;        // by the poses, imu
    Vector3 w_sent, f_sent;  // means, in the messages' units and axes
    Matrix3 R_map_imu;       // at the middle of the step
    double span_s() const { return SecondsBetween(from.stamp, to.stamp); }
    // Returns the turn by the rates minus the turn by the poses, rad, imu.
    Vector3 TurnError(const Matrix3& R_imu_sent, double rate_scale) const;
  };
  // Holds the acceleration of the path at one pose, by positions and by forces.
  struct Bend {
    int map = 0;
    double weight = 0.0;  // below 1, because neighbouring bends share positions
    Vector3 a_map_mps2 = Vector3::Zero();
    // Mean over the steps of (column r of R_map_imu) f_sent^T, r = 0..2.
    Matrix3 force_in_map[3] = {Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
    // The mean force in map for axes turned by R_imu_sent, in the messages' unit.
    Vector3 ForceInMap(const Matrix3& R_imu_sent) const;
  };

  const std::vector<Step>& steps() const { return steps_; }
  // Returns the evidence with samples taken `num_steps` later, as if the clocks differed by so
  // much.
  MotionEvidence Shifted(double num_steps) const;
  std::vector<Bend> FindBends() const;
  bool HasMoved() const;  // over the last recent_steps steps

  // Returns the chi-square of the turns, minimized over the gyro bias.
  double RateScore(const Matrix3& R_imu_sent, double rate_scale) const;
  // Chi-square of the bends, minimized over the direction of gravity in each map.
  static double ForceScore(std::span<const Bend> bends, const Matrix3& R_imu_sent,
                           double force_scale, double gravity_mps2);

  // Returns the root mean square error of rates, and of forces, that a score stands for.
  double RateError_radps(double score) const;
  static double ForceError_mps2(std::span<const Bend> bends, double score);

 private:
  std::optional<Bend> BendAbout(std::size_t k) const;

  int map_ = 0;
  std::optional<StampedPose> last_;  // in the current map
  std::vector<Step> steps_;
};

}  // namespace lio
