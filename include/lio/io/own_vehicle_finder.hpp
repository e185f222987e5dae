// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the returns of the vehicle that carries the lidar: in nearly every sweep, at one range in
// the lidar's frame, wherever the vehicle is. Walls, hedges and racks alongside a lane, and the
// floor, are as steady. They go on into the distance, where a vehicle ends: neighbouring directions
// of one surface belong together, and a surface that reaches beyond kFarthest_m is no vehicle.
#pragma once

#include <optional>
#include <vector>

#include "lio/sensor/rig.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

class OwnVehicleFinder {
 public:
  // A vehicle reaches no farther [m] that carries its lidar on top.
  static constexpr float kFarthest_m = 2.5f;

  // Returns that the rig knows to be the vehicle's, and too near ones, are left out.
  explicit OwnVehicleFinder(const LidarRig& rig);

  // A sweep begins of which points are added.
  void BeginSweep();
  void Add(const LidarPoint& point);

  struct Found {
    int num_directions = 0;
    OwnVehicleBox box;
  };
  // Absent where too few sweeps were added, or nothing is steady.
  [[nodiscard]] std::optional<Found> Find() const;

 private:
  // Near returns in one direction, as the lidar sees it.
  struct Cell {
    int last_sweep = 0;
    int num_sweeps = 0;  // in which it had a return
    double sum_m = 0.0;  // in the last of them
    int num_points = 0;
    double means_m = 0.0, means_sq_m2 = 0.0;  // sums over those before it

    double Mean_m() const { return means_m / (num_sweeps - 1); }
  };

  [[nodiscard]] bool IsSteady(const Cell& cell) const;
  [[nodiscard]] std::vector<float> FollowedRanges() const;

  LidarRig rig_;
  std::vector<Cell> cells_;
  int num_sweeps_ = 0;
};

}  // namespace lio
