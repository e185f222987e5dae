// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The world frame that poses are published in: level, and steady.
//
// The filter's own T_world_imu is the best guess of where gravity points, and keeps changing its
// mind while tilt and accelerometer bias are told apart: by tenths of a degree, which at a hundred
// metres from the origin are decimetres of height. A path that is bent after the fact is of little
// use, so poses are published as T_world_map * T_map_imu with a T_world_map that stays put: it
// follows the filter only while a start in motion still finds its level, or when it is off by more
// than kTolerance_rad and surely so; then it turns slowly about the vehicle. The covariance says
// what that costs.
#pragma once

#include <optional>

#include "lio/filter/nav_state.hpp"

namespace lio {

class SteadyWorld {
 public:
  static constexpr double kTolerance_rad = 0.0087;  // half a degree

  // kFromRest: level as well as it will be for long. kFromMotion: follows the filter until the tilt
  // is known. kFollow: the filter's own world at all times.
  enum class Mode { kFromRest, kFromMotion, kFollow };
  explicit SteadyWorld(Mode mode) : mode_(mode) {}

  // After each fused scan.
  void Update(const Estimate& estimate);

  struct Published {
    Pose T_world_imu;
    Vector3 v_world_imu = Vector3::Zero();
    NavCov cov = NavCov::Zero();
  };
  Published Publish(const Estimate& estimate) const;

 private:
  Mode mode_;
  std::optional<Pose> T_world_map_;
};

}  // namespace lio
