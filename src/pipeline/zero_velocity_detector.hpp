// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does the vehicle stand still? The detector answers after each matched scan, from the last window
// of inertial samples and of scan matching together, by the limits of imu/rest.hpp.
//
// At rest all of this holds:
//   - a straight line through where the window's scans were matched is short,
//     and no scan lies far off it,
//   - rate and force spread by no more than their noise and an idling engine,
//   - mean rate and force are those of rest, as surely as the filter knows tilt and biases.
// A scan that is not held in every direction begins the window anew, since along a tunnel the lidar
// says nothing, and so does one that comes after a gap in the matched scans (kScanGap).
//
// After a start at rest the window counts as full from the first scan on.
#pragma once

#include <deque>
#include <vector>

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// Holds a matched scan, with the inertial samples of its sweep.
struct ZeroVelocityScan {
  Timestamp stamp;
  Vector3 position_map_m = Vector3::Zero();
  std::vector<ImuSample> samples;
};

class ZeroVelocityDetector {
 public:
  explicit ZeroVelocityDetector(const ImuRig& imu) : imu_(imu) {}

  void Add(ZeroVelocityScan scan);
  void Forget();
  // The next scan finds the vehicle at rest.
  void BeginAtRest();

  // It judges as of the last scan, whose time is the estimate's.
  bool Judge(const Estimate& estimate, const Vector3& g_world);

 private:
  double Span_s() const;
  bool IsInPlace() const;
  bool IsStillToImu(const Estimate& estimate, const Vector3& g_world) const;

  ImuRig imu_;
  std::deque<ZeroVelocityScan> scans_;  // by stamp; reaches back a window at least, when full
  bool stands_ = false;                 // as of the scan before
};

}  // namespace lio
