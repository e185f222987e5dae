// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The motion of a drive as matching and the inertial samples show it, kept scan by scan for
// rig_fit.hpp. Matched poses are raw: before the filter, gated ones included, and by the clocks as
// they are configured.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>

#include "lio/sensor/gap.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

struct MotionRecordParameters {
  // s. A longer step between poses skipped too many sweeps: left out.
  double max_step_s = kScanGap.unjoined.Seconds();
  // The steps that are kept, the last ones: four minutes at 10 Hz, 0.7 MB. Chosen.
  std::size_t max_steps = 2400;
  // s. Half of the time over which rate and force at a stamp are averaged. Chosen: four samples at
  // 100 Hz, so that their noise is halved.
  double instant_s = 0.02;
  // s. Neighbouring steps make one track while the estimated clock offset moves stamps by the same
  // amount within this. Chosen: 2 cm at 20 m/s, as much as a match is off.
  double max_correction_change_s = 0.001;
};

inline constexpr MotionRecordParameters kMotionRecord;

// From one matched pose to the next. Rates and forces as measured, biases included.
struct MotionStep {
  int map = 0;              // whose frame the poses are in
  int track = 0;            // neighbours of one track share a pose
  StampedPose from, to;     // T_map_imu by matching
  Vector3 turn_rad;         // by the gyro, as a rotation vector in imu
  Vector3 rate_gain_radps;  // rate at `to` less that at `from`, in imu at `to`
  // The forces add this to velocity and position, in imu at the step's middle, without gravity.
  Vector3 velocity_mps, position_m;
  Vector3 jerk_mps3;          // mean change of the specific force, in imu
  double clock_correction_s;  // added to both stamps by the estimated clock offset
  double span_s() const { return SecondsBetween(from.stamp, to.stamp); }
};

class MotionRecord {
 public:
  // The poses to come are in another map.
  void BeginMap();
  // The rates and forces so far were read in other units or axes.
  void Clear();
  // Adds a matched pose, later than the one before, to whose stamp an estimated clock offset has
  // added `clock_correction`. `samples`: from the last pose to this one at least, ascending.
  void Add(const StampedPose& T_map_imu, Duration clock_correction,
           std::span<const ImuSample> samples);
  // Returns the time that the estimated clock offset adds to stamps now.
  Duration clock_correction() const { return clock_correction_; }
  // The poses so far and those to come are of another imu, which has this pose in the one so far.
  void SetImu(const Pose& T_old_new);
  // A scan was not matched soundly: no step leads to the next pose.
  void Interrupt() { last_.reset(); }

  std::optional<Timestamp> last_stamp() const;
  const std::deque<MotionStep>& steps() const { return steps_; }

 private:
  int map_ = 0;
  int track_ = 0;
  Duration clock_correction_;
  std::optional<StampedPose> last_;  // by the clock correction of now
  std::deque<MotionStep> steps_;
};

}  // namespace lio
