// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs lidar odometry by a model of constant velocity and turn rate, built from the filter itself:
// inertial samples without gravity, wide process noise. In lidar-only operation the velocity is
// constant in the imu's axes, and the samples read the force that turns it; in the first seconds
// before the inertial filter starts it is constant in the world, and they read none. The turn rate
// is either estimated like the velocity, as the negative gyro bias, or that of the gyro.
#pragma once

#include <optional>

#include "lio/filter/filter_history.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

// The chosen ones are from the ways in which cars, robots and walkers move.
struct ConstantVelocityParameters {
  // After a longer time the clock was set, or all is new. Chosen: no guess holds so long.
  Duration max_unseen{10'000'000'000};
  // The velocity turns with the body for so long without a sweep, then it is constant in the world:
  // nobody walks in circles. Chosen: a turn of a walker or of a car at a crossing is half done.
  Duration follows_turn_for{500'000'000};
  Duration step{10'000'000};  // propagation step; chosen: a tenth of a sweep at 10 Hz
  // Process noise. Chosen: a vehicle's velocity changes by 0.5 m/s in a sweep of 0.1 s, 1 sigma; a
  // walker's does. The turn rate walks as the drive shows, within these bounds: a car's changes by
  // 0.3 rad/s, that of what a hand holds by 1.3 rad/s. Measured: the bounds and the factor keep the
  // NEES near 1 (docs/experiments/quick_turns.md).
  double accel_density = 1.5;           // m/s^2/sqrt(Hz)
  double min_turn_accel_density = 1.0;  // rad/s^2/sqrt(Hz)
  double max_turn_accel_density = 4.0;
  double start_turn_accel_density = 3.0;  // before a turn was seen; chosen: nearer to the larger
  // The density is this times the root mean square of turn error / (time since the last
  // scan)^(3/2). A rate that walks at random would give 0.7; bodies turn smoothly, so that errors
  // of the model last.
  double density_per_error = 4.4;
  double turn_error_rate = 0.02;  // weight of a scan in the mean; chosen: 5 s at 10 Hz
  // Nothing is known. Chosen: a vehicle in a city, one that turns.
  double start_velocity_std_mps = 15.0;
  double start_turn_rate_std_radps = 1.0;
  // A velocity seed is good to a metre per second or so (velocity_search.hpp). Measured at nine
  // starts on a motorway: with 4 m/s matching strayed from the right velocity.
  double velocity_seed_std_mps = 1.5;
  // An earlier tracker's motion, some seconds old, errs by this. Chosen: a car brakes by as much in
  // a second.
  double known_velocity_std_mps = 2.0;
  double known_turn_rate_std_radps = 0.3;
  // A time of unknown length without sweeps. Chosen: it is taken for half a second, over which a
  // body that stood moves by 1 m, and any body turns by 0.2 rad.
  double unseen_s = 0.5;
  double unseen_shift_m = 1.0;
  double unseen_turn_rad = 0.2;
  // A gyro's density also stands for errors of its scale and of its time stamps. Chosen: five times
  // ImuRig's.
  double gyro_density = 5.0e-3;       // rad/s/sqrt(Hz)
  double gyro_bias_std_radps = 0.02;  // chosen: consumer units, 1 deg/s
};

inline constexpr ConstantVelocityParameters kConstantVelocity;

// Holds the motion as far as it is known before anything is matched.
struct MotionSeed {
  // The velocity seed comes from correlative alignment of bird's-eye views, in the imu's axes
  // [m/s].
  std::optional<Vector3> v_imu_mps;
  // The motion prior is velocity and, without a gyro, turn rate of an earlier tracker's state.
  std::optional<NavState> motion;
};

struct TrackerOptions {
  double span_s = HistoryOptions{}.span_s;        // length of its history
  double nis_limit = HistoryOptions{}.nis_limit;  // gate of poses
  // A gyro's rate at the start, as it reads: the turn rate then comes from AddRate().
  std::optional<Vector3> first_rate_radps;
  // The velocity turns with the body, and the turn rate walks as the drive shows. Not while the
  // first scans tell what the rig is: there the simplest model shows best that something is wrong.
  bool follows_turns = false;
  MotionSeed seed;
  // The track and its map begin at this pose; the covariance is that of the pose in the world.
  Pose T_world_start;
  Matrix6 start_cov = Matrix6::Zero();
  // Goes on from this estimate instead, in world and in map: with its gyro bias, or without a gyro
  // with the turn rate of the seed's motion.
  std::optional<Estimate> goes_on_from = {};
};

class ConstantVelocityTracker {
 public:
  // Without a known motion it begins at rest, but very unsure of that.
  ConstantVelocityTracker(Timestamp start, const TrackerOptions& options);

  // A gyro's reading, with a gyro only. Samples not after the newest are left out.
  void AddRate(const ImuSample& sample);
  // Fills the time up to `stamp`, the end of a sweep; with a gyro its last rate holds. Far ahead it
  // continues there as by SetClock().
  void AdvanceTo(Timestamp stamp);
  // Fuses what matching found at the middle of a sweep, without a gate. A usable match moves the
  // estimate; an empty map begins at the estimate. Returns false when the match tells nothing, and
  // when its time lies before the history, which then stays as it is.
  [[nodiscard]] bool AddMatch(Timestamp middle, const MatchResult& match);
  // Returns the covariance that AddMatch() would fuse the match with: its own, and what the errors
  // of its blind directions make of a motion that the estimate does not know.
  [[nodiscard]] Matrix6 MatchCov(Timestamp middle, const MatchResult& match) const;
  // The turn of a scan was predicted with this error, so long after the last one that was located.
  void NoteTurnError(double error_rad, double since_s);
  // The estimate at the end of a sweep whose middle is the newest match's, by the turn rate that
  // the sweep itself shows, if it does. The filter does not use that rate: its systematic errors
  // would enter the next sweeps' deskew and, with them, the map, and grow.
  Estimate AtEnd(Timestamp middle, Timestamp end, const std::optional<TurnRate>& shown) const;
  // Continues at another time, unsure of the velocity and of what happened in between.
  void SetClock(Timestamp stamp);
  bool has_gyro() const { return has_gyro_; }
  // rad/s: by the gyro, or as the scans show it.
  Vector3 w_imu_radps() const { return last_rate_ - history_.head().state.gyro_bias; }
  FilterHistory& history() { return history_; }
  const FilterHistory& history() const { return history_; }

 private:
  // The sample that holds from the head on.
  [[nodiscard]] ImuSample SampleNow() const;

  HistoryOptions history_options_;
  bool has_gyro_;
  bool follows_turns_;
  Vector3 last_rate_ = Vector3::Zero();  // rad/s; stays zero without a gyro
  double turn_error_var_;                // rad^2/s^3, running mean
  FilterHistory history_;
};

}  // namespace lio
