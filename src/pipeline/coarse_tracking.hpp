// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Initialization and lidar-only odometry share this: sweeps tracked by the constant-velocity model.
#pragma once

#include <span>

#include "lio/pipeline/constant_velocity_tracker.hpp"
#include "lio/pipeline/match_job.hpp"
#include "lio/pipeline/options.hpp"

namespace lio {

struct CoarseTrackingParameters {
  // The cosine between the lidar's axis and up must reach this. Chosen: 45 deg; no lidar leans
  // more.
  double min_up_cosine = 0.7;
};

inline constexpr CoarseTrackingParameters kCoarseTracking;

// A track that begins with this sweep begins at the sweep's start if the motion is known, else at
// its middle, where its first pose will be.
[[nodiscard]] Timestamp TrackStart(const Sweep& sweep, const MotionSeed& seed);

// The result points roughly up in imu, in whatever unit and sign forces come. Forces without
// gravity point anywhere, and the lidar's axis is taken in their place.
[[nodiscard]] Vector3 MeanUp(std::span<const ImuSample> samples, const Rig& rig);

// A sweep that ends before the tracker's newest event means that stamps went back: the tracker goes
// on at the sweep's start, and `last_located` moves there. It changes nothing for a later sweep.
void FollowClockBack(const Sweep& sweep, ConstantVelocityTracker& tracker,
                     std::optional<Timestamp>& last_located);

// A tracking job by the constant-velocity model: the deskew is refined, and degenerate directions
// are held by bird's-eye views.
[[nodiscard]] MatchJob MakeCoarseJob(const SweepPtr& sweep, const ConstantVelocityTracker& tracker,
                                     std::optional<Timestamp> last_located, const Vector3& up_map);

}  // namespace lio
