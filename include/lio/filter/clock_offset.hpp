// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The offset between the clocks of lidar and IMU, followed while driving: what makes the turns
// between neighbouring scans agree with those of the gyro.
//
// With d the offset (imu clock = lidar clock + d), a_k what scan k's stamp was moved by already,
// and w_k the rate at the moved stamp, the turn from scan k-1 to k by matching differs from the
// gyro's between the moved stamps by
//   r = Log(dR_gyro^-1 dR_matched) = w_k (d - a_k) - dR^T w_k-1 (d - a_k-1),
// linear in d: a Kalman filter of one state. It stands beside the error-state filter, not in it,
// because there the map, which is built by the same clock, takes up what a steady motion makes of
// d, and tells it from drift only as well as the map's own noise is known; turns of neighbouring
// scans have neither map drift nor velocity in them. What is lost is the translation's say.
//
// A turn whose rate hardly changes says nothing of d and is left out: on a straight road the
// estimate stands still. It stays within kMax_s of zero. Errors of neighbouring turns share a scan
// and have opposite signs; counted as independent, d is surer than it says.
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

class ClockOffset {
 public:
  static constexpr double kMax_s = 0.05;

  explicit ClockOffset(const ImuRig& imu) : imu_(imu) {}

  struct Scan {
    Timestamp stamp;                                // moved already
    double moved_by_s = 0.0;                        // what it was moved by
    Quaternion R_map_imu = Quaternion::Identity();  // as matched
    double rotation_var = 0.0;                      // of it, rad^2 an axis
    Vector3 gyro_bias = Vector3::Zero();            // rad/s
  };
  // `samples`: the inertial ones of its sweep. The next scan in time.
  void Add(const Scan& scan, std::span<const ImuSample> samples);
  // A scan was not matched: the next turn is not measured.
  void Interrupt();

  double offset_s() const { return offset_s_; }
  double std_s() const;
  // To be added to the next scan's stamps: follows the offset slowly once that is known.
  double move_by_s() const { return move_by_s_; }

 private:
  void Update(const Scan& scan);
  void Follow();

  ImuRig imu_;
  double offset_s_ = 0.0;
  double var_s2_ = 0.02 * 0.02;
  double move_by_s_ = 0.0;
  std::optional<Scan> last_;
  std::deque<ImuSample> samples_;  // since the last scan's sweep
};

}  // namespace lio
