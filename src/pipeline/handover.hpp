// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// This crosses a change of mode, and nothing else does: where the estimate was last sound, in world
// and in map, and what is remembered of the scans so far. A mode keeps its own up to date, and the
// mode that follows begins with it.
#pragma once

#include <cstdint>
#include <optional>

#include "lio/imu/start_state.hpp"
#include "pipeline/clock_step_doubt.hpp"
#include "pipeline/imu_doubt.hpp"
#include "pipeline/yaw_doubt.hpp"

namespace lio {

struct Handover {
  enum class Origin : std::int8_t {
    kNone,       // nothing has been published yet
    kInertial,   // a start with an IMU, in a level world
    kLidar,      // lidar-only: the world was not level
    kLostLidar,  // the same, and the way was lost
  };
  Origin origin = Origin::kNone;
  LastFix last_fix;                 // the last sound scan, as it was published
  Pose T_world_start, T_map_start;  // at the mode's begin, in the axes that were believed then
  bool was_level = false;           // gravity was felt in this world before it went lidar-only
  bool is_placed = false;           // somebody has said where the body is: at last_fix
  bool keeps_map = false;           // the mode that follows goes on in the map as it is
  bool is_map_by_lidar = false;     // it began lidar-only: no IMU convention is in its axes
  Vector3 w_imu_radps = Vector3::Zero();  // kLostLidar: the turn rate when the map was given up,
  Matrix6 pose_cov = Matrix6::Zero();     // and the covariance of [position; rotation] in world
  YawDoubt yaw_doubt;
  std::int64_t last_seq = -1;               // the last scan that was fused
  std::optional<Timestamp> last_fused;      // end of the last sweep that was fused
  std::optional<Timestamp> last_located;    // middle of the last sweep whose pose was found
  std::optional<Timestamp> last_published;  // at the IMU's rate
  // When buildings contradicted a track: the next one may follow traffic that goes along, too.
  std::optional<Timestamp> in_traffic;
  ClockStepDoubt clock_step;
  std::optional<ImuDoubt> imu_doubt;

  [[nodiscard]] bool doubts_imu() const { return imu_doubt && imu_doubt->is_open; }
  // The unit is believed again, as one that has begun anew.
  void BelieveImu() {
    if (imu_doubt) imu_doubt->is_open = false;
  }
  // The clock was set: all that is remembered is as long ago by the new one.
  void ShiftTimesBy(Duration by) {
    for (std::optional<Timestamp>* stamp : {&last_fused, &last_located, &in_traffic}) {
      if (*stamp) **stamp = **stamp + by;
    }
    last_fix.stamp = last_fix.stamp + by;
    if (imu_doubt) imu_doubt->last = imu_doubt->last + by;
  }
};

}  // namespace lio
