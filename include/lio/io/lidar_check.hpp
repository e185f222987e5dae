// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks at the sweeps of a whole run for what the estimator does not notice: a lidar of another
// model than the rig's, returns of the vehicle itself, and points without times of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lio/io/lidar_guess.hpp"
#include "lio/io/own_vehicle_finder.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

class LidarCheck {
 public:
  explicit LidarCheck(const Options& options);

  void Add(const ScanChunk& chunk);
  // The causes that were found come last, since they seldom cost accuracy; of a kind that the
  // verdict names already there is none.
  void AddTo(Verdict& verdict) const;
  // Returns the causes that were found, none of which takes more trust than `leaves` says. The
  // vehicle's own returns can only be told from the surroundings after a way of some length.
  [[nodiscard]] std::vector<Cause> Find(double path_m) const;

 private:
  void BeginScan(const ScanChunk& chunk);
  [[nodiscard]] std::optional<Cause> FindModel() const;
  [[nodiscard]] std::optional<Cause> FindOwnVehicle() const;
  [[nodiscard]] std::optional<Cause> FindPointTime() const;

  LidarRig rig_;
  bool uses_imu_;
  RingElevations elevations_;
  OwnVehicleFinder own_vehicle_;
  std::optional<std::int32_t> scan_;
  std::optional<Timestamp> scan_begin_;
  double span_s_ = 0.0;         // time from the first to the last point of the present sweep
  std::vector<double> shares_;  // share of the time between sweeps that each one's points span
  int num_scans_ = 0;
};

}  // namespace lio
