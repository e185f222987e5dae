// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the offset between the clocks of lidar and IMU while driving, from the turns between
// neighbouring scans: registration and gyro agree on them only at the right offset.
//
// Model. Let d be the offset (imu clock = lidar clock + d), a_k the correction that scan k's stamp
// already has, and w_k the rate at the corrected stamp. The turn from scan k-1 to k by registration
// differs from the gyro's between the corrected stamps by
//   r = Log(dR_gyro^-1 dR_matched) = w_k (d - a_k) - dR^T w_k-1 (d - a_k-1).
// The model is linear in d. Two oscillators differ by some parts in a million, so d drifts: a
// Kalman filter of two states, d and its rate (docs/filter.md).
//
// It is no state of the error-state filter because the map is built with the same clock: under a
// steady motion the map absorbs the offset, and the two are told apart only as well as the map's
// noise is known. Turns between neighbouring scans depend neither on the map's drift nor on
// velocity. The information in the translations is not used. The error of a turn beyond what is
// claimed is learned from the innovations' component across the change of rate.
//
// Limits. A turn whose rate hardly changes holds no information and is left out: on a straight road
// the estimate goes on at the rate that was found before. The estimate stays within kMax_s of zero.
// Neighbouring turns share a scan's error with opposite signs; they are treated as independent,
// which overstates the variance.
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "lio/filter/clock_estimate.hpp"
#include "lio/filter/filter_parameters.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Holds what is known of d and its rate at one time: (s, s/s).
struct ClockBelief {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  // Nothing but what clocks are like.
  Eigen::Matrix2d cov = Eigen::Vector2d(kFilterParameters.clock_offset.max_std_s,
                                        kFilterParameters.clock_offset.rate_std)
                            .cwiseAbs2()
                            .asDiagonal();
};

class ClockOffset {
 public:
  explicit ClockOffset(const ClockBelief& belief = {});

  static constexpr double kMax_s = kFilterParameters.clock_offset.max_offset_s;

  struct Scan {
    Timestamp stamp;                                // corrected, IMU clock
    double moved_by_s = 0.0;                        // the correction in `stamp`
    Quaternion R_map_imu = Quaternion::Identity();  // by registration
    double rotation_var = 0.0;                      // variance of R_map_imu, rad^2 per axis
    Vector3 gyro_bias = Vector3::Zero();            // rad/s, imu
    double gyro_density = 0.0;                      // noise, rad/s/sqrt(Hz)
  };
  // Adds the next scan in time. `samples` are the inertial samples of its sweep, ascending.
  void Add(const Scan& scan, std::span<const ImuSample> samples);
  // Call when a scan was not matched: the turn to the next scan is then not used.
  void Interrupt();

  double offset_s() const { return belief_.mean(kOffset); }  // the estimate of d
  double std_s() const;                                      // its standard deviation
  // These return how fast d grows, s per second, and its standard deviation, to tests.
  double rate() const { return belief_.mean(kRate); }
  double rate_std() const;
  // The correction to add to the next scan's stamps. It follows the estimate by at most 2 ms a
  // scan, from when the standard deviation is below 2 ms or the offset is three of them.
  double move_by_s() const { return move_by_s_; }
  // Returns what the scans so far tell of the first of them; nothing new where no stamps would be
  // moved by it.
  ClockBelief AtFirstScan() const;
  // Returns what is known after the last scan, once stamps are moved by it.
  std::optional<ClockEstimate> Found() const;

 private:
  enum StateIndex { kOffset, kRate };
  // A turn between neighbouring scans gives this measurement.
  struct Turn {
    Vector3 rate_change_radps = Vector3::Zero();
    double rate_change_std_radps = 0.0;
    Vector3 innovation_rad = Vector3::Zero();  // at the estimated offset
    double claimed_var = 0.0;  // the innovation's, as matching and gyro claim it, rad^2
  };

  void Predict(Timestamp now);
  void Update(const Scan& scan);
  void Fuse(const Turn& turn);
  void LearnUnclaimed(const Turn& turn);
  // Has the offset surely been found, if it is known like this? `beyond_s`: and not this.
  static bool IsSure(double offset_s, double std_s, double beyond_s);
  void Follow();

  ClockBelief belief_;
  std::optional<Timestamp> as_of_;  // belief_ holds at this time
  double age_s_ = 0.0;              // from the first scan to then
  double move_by_s_ = 0.0;
  int num_turns_ = 0;      // turns fused so far
  bool is_found_ = false;  // stamps are moved
  // A turn varies by this beyond what is claimed, rad^2 per axis.
  double unclaimed_var_ =
      kFilterParameters.clock_offset.turn_std_rad * kFilterParameters.clock_offset.turn_std_rad;
  std::optional<Scan> last_;
  std::deque<ImuSample> samples_;  // since the beginning of the last scan's turn
};

}  // namespace lio
