// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does the vehicle stand still? Judged after each matched scan, from the last kWindow_s of inertial
// samples and of scan matching together, because each alone is deceived: a motorway at constant
// speed is calm to the IMU, a ring lock or a bus alongside stands still to the lidar.
//
// At rest all of this holds:
//   - no two scans of the window were matched more than kMaxShift_m apart,
//   - rate and force spread by no more than their noise and an idling engine,
//   - mean rate and force are those of rest, as surely as the filter knows tilt and biases.
// A scan that is not matched, or not held in every direction, begins the window anew: along a
// tunnel the lidar says nothing.
//
// What goes undetected is a creep of about kMaxShift_m / kWindow_s that begins without being felt.
#pragma once

#include <deque>
#include <vector>

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// A matched scan, with the inertial samples of its sweep.
struct StandstillScan {
  Timestamp stamp;
  Vector3 position_map_m = Vector3::Zero();
  std::vector<ImuSample> samples;
};

class Standstill {
 public:
  static constexpr double kWindow_s = 1.5;
  static constexpr double kMaxShift_m = 0.02;

  explicit Standstill(const ImuRig& imu) : imu_(imu) {}

  void Add(StandstillScan scan);
  void Forget() { scans_.clear(); }

  // As of the last scan, whose time is the estimate's.
  bool Holds(const Estimate& estimate, const Vector3& g_world) const;

 private:
  bool IsInPlace() const;

  ImuRig imu_;
  std::deque<StandstillScan> scans_;  // by stamp; reaches back kWindow_s at least, when full
};

}  // namespace lio
