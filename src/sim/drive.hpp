// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Plans the speed along a path for a driver or walker who keeps to limits of speed and of
// longitudinal and lateral acceleration and stops where asked, and the motion of the body that
// follows.
#pragma once

#include <vector>

#include "lio/sim/path.hpp"
#include "lio/sim/trajectory.hpp"

namespace lio::sim {

struct DriveLimits {
  double speed_mps = 10.0;
  double accel_mps2 = 1.5;
  double brake_mps2 = 2.0;
  double lateral_mps2 = 2.0;  // bounds the speed in bends to sqrt(lateral * radius)
};

struct Stop {
  double distance_m = 0.0;
  double rest_s = 3.0;
};

// Holds the distance along the path, sampled evenly in time.
class Drive {
 public:
  // The drive rests for `start_rest_s` at distance 0, then goes to the path's end and rests there.
  // Stops must ascend. Throws std::invalid_argument when a limit is not positive.
  Drive(const Path& path, const DriveLimits& limits, const std::vector<Stop>& stops,
        double start_rest_s);

  [[nodiscard]] double duration_s() const;  // time at which the end of the path is reached, at rest
  [[nodiscard]] double DistanceAt(double t_s) const;

 private:
  std::vector<double> distances_m_;
};

// Describes how a body pitches and rolls under acceleration and on uneven ground.
struct BodyResponse {
  double lean_rad_per_mps2 = 0.004;  // roll outward in bends
  double dive_rad_per_mps2 = 0.004;  // nose-down pitch on braking
  double half_wheelbase_m = 1.35;    // 0: the body stays upright on any ground
  double half_track_m = 0.78;
  double lively_speed_mps = 8.0;  // oscillations have their full strength from this speed on
};

// Returns the knots of a body that follows `drive` on ground of `height`, until shortly after
// `duration_s`.
[[nodiscard]] std::vector<BodyKnot> FollowDrive(const Path& path, const Drive& drive,
                                                const HeightFunction& height,
                                                const BodyResponse& response,
                                                double knot_interval_s, double duration_s);

// Returns what springs, tyres and road do to a car: heave, pitch and roll at 1 to 2 Hz and wheel
// hop at 8 to 12 Hz.
[[nodiscard]] std::vector<Oscillation> CarOscillations(std::uint64_t seed);
// Returns the motion of a hand-held sensor: steps at 1.8 Hz with sway at half that frequency.
[[nodiscard]] std::vector<Oscillation> WalkOscillations(std::uint64_t seed);

}  // namespace lio::sim
