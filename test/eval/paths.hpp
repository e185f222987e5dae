// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes trajectories with known results.
#pragma once

#include <cmath>
#include <functional>

#include "lio/io/trajectory_file.hpp"

namespace lio::test {

inline constexpr std::int64_t kPeriod_ns = 100'000'000;  // 10 Hz

// Brings a path into another world.
inline const Pose kWorldMove{ExpSo3({0.3, -0.5, 2.0}), {10, -20, 30}};

// Makes poses 0.1 s apart, beginning at stamp 1000 s.
inline Trajectory MakeTrajectory(int count, const std::function<Pose(int)>& pose_of) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    trajectory.poses.push_back({Timestamp{1'000'000'000'000 + i * kPeriod_ns}, pose_of(i)});
  }
  return trajectory;
}

// The body moves forward along x by `step_m` per row and faces forward.
inline Trajectory Straight(int count, double step_m) {
  return MakeTrajectory(count, [&](int i) {
    return Pose{Quaternion::Identity(), {step_m * i, 0, 0}};
  });
}

// The path is a climbing curve in all three dimensions; the body faces along its heading.
inline Pose HelixPose(int i) {
  const double angle = 0.02 * i;
  return {ExpSo3({0, 0, angle + M_PI / 2}), {20 * std::cos(angle), 20 * std::sin(angle), 0.01 * i}};
}
inline Trajectory Helix(int count) {
  return MakeTrajectory(count, HelixPose);
}

// Passes every pose through a function.
inline Trajectory Map(Trajectory trajectory, const std::function<Pose(const Pose&)>& change) {
  for (StampedPose& row : trajectory.poses) row.pose = change(row.pose);
  return trajectory;
}

inline Trajectory AsKitti(Trajectory trajectory) {
  trajectory.format = TrajectoryFormat::kKitti;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    trajectory.poses[i].stamp = Timestamp{static_cast<std::int64_t>(i)};
  }
  return trajectory;
}

inline constexpr double kDeg = M_PI / 180;

}  // namespace lio::test
