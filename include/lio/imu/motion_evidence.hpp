// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What poses from scan matching say of the inertial samples between them, kept for the last 10 s,
// and how badly a way of reading the samples contradicts it.
//
//   turns   phi_k = Log(R_k-1^T R_k)           against  s R w_k dt + bias,
//   bends   second difference of positions     against  the mean of R_map_imu s R f + g,
//
// with w and f as sent, R a turn of their axes, s a unit, g a vector of its own for each map, of
// known length. Scores are chi-squares. A second difference is the mean acceleration under a
// triangle over its three positions, exactly, so vibration does no harm.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lio/imu/imu_convention.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

class MotionEvidence {
 public:
  // The poses to come are in another map, and tell anew of the time from `from` on.
  void BeginMap(Timestamp from);
  // A matched pose, later than the one before, and the samples since that, as sent.
  void AddPose(const StampedPose& T_map_imu, std::span<const ImuSample> sent);

  // From one pose to the next.
  struct Step {
    int map = 0;
    StampedPose from, to;    // of imu, in the map
    Vector3 turn_rad;        // by the poses, in imu
    Vector3 w_sent, f_sent;  // means, in the messages' units and axes
    Matrix3 R_map_imu;       // at its middle
    double span_s() const { return SecondsBetween(from.stamp, to.stamp); }
    // What rates say of the turn, less what the poses say.
    Vector3 TurnError(const Matrix3& R_imu_sent, double rate_scale) const;
  };
  // How the path bent about a pose, and what forces say of it.
  struct Bend {
    int map = 0;
    double weight = 0.0;  // below 1, as neighbours share positions
    Vector3 a_map_mps2 = Vector3::Zero();
    Matrix3 force_in_map[3] = {Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
    Vector3 ForceInMap(const Matrix3& R_imu_sent) const;
  };

  const std::vector<Step>& steps() const { return steps_; }
  // The same with readings that were taken `num_steps` later, as if the clocks were off by so much.
  MotionEvidence Shifted(double num_steps) const;
  std::vector<Bend> FindBends() const;
  bool HasMoved() const;  // over the last ten steps

  double RateScore(const Matrix3& R_imu_sent, double rate_scale) const;
  static double ForceScore(std::span<const Bend> bends, const Matrix3& R_imu_sent,
                           double force_scale, double gravity_mps2);

  // How far rates are off by a score, root mean square; and forces.
  double RateError_radps(double score) const;
  static double ForceError_mps2(std::span<const Bend> bends, double score);

  static constexpr std::ptrdiff_t kRecentSteps = 10;

 private:
  std::optional<Bend> BendAbout(std::size_t k) const;

  int map_ = 0;
  std::optional<StampedPose> last_;  // in the map of now
  std::vector<Step> steps_;
};

}  // namespace lio
