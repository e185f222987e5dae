// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does the vehicle stand still? Judged after each matched scan, from the last kWindow_s of inertial
// samples and of scan matching together, because each alone is deceived: a motorway at constant
// speed is calm to the IMU, a ring lock or a bus alongside stands still to the lidar.
//
// At rest all of this holds:
//   - a straight line through where the window's scans were matched is no longer than kMaxShift_m,
//     and no scan lies farther than kMaxScatter_m off it,
//   - rate and force spread by no more than their noise and an idling engine,
//   - mean rate and force are those of rest, as surely as the filter knows tilt and biases.
// A scan that is not held in every direction begins the window anew, since along a tunnel the lidar
// says nothing, and so does one that comes after a gap in the matched scans (kScanGap).
//
// After a start at rest the window counts as full from the first scan on. What goes undetected is a
// creep of about kMaxShift_m / kWindow_s that begins without being felt.
#pragma once

#include <deque>
#include <vector>

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// A matched scan, with the inertial samples of its sweep.
struct ZeroVelocityScan {
  Timestamp stamp;
  Vector3 position_map_m = Vector3::Zero();
  std::vector<ImuSample> samples;
};

class ZeroVelocityDetector {
 public:
  static constexpr double kWindow_s = 1.5;
  static constexpr double kMaxShift_m = 0.02;
  static constexpr double kMaxScatter_m = 0.05;

  explicit ZeroVelocityDetector(const ImuRig& imu) : imu_(imu) {}

  void Add(ZeroVelocityScan scan);
  void Forget();
  // The next scan finds the vehicle at rest.
  void BeginAtRest();

  // As of the last scan, whose time is the estimate's.
  bool Judge(const Estimate& estimate, const Vector3& g_world);

 private:
  double Span_s() const;
  bool IsInPlace() const;
  bool IsStillToImu(const Estimate& estimate, const Vector3& g_world) const;

  ImuRig imu_;
  std::deque<ZeroVelocityScan> scans_;  // by stamp; reaches back kWindow_s at least, when full
  bool stands_ = false;                 // as of the scan before
};

}  // namespace lio
