// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fuses the pose of a scan as the filter does: with the inflation that the poses before it have
// shown, and beyond the gate where that is asked for. The update itself is in pose_update.hpp.
#pragma once

#include <cstdint>
#include <limits>

#include "lio/filter/pose_update.hpp"

namespace lio {

// Inflates covariances by NIS: it holds factors (1 or more) on the translation and rotation blocks
// of a pose's covariance, from the NIS of about the last ten poses. Errors that persist (a clock
// offset, a loose mount, a wrong extrinsic) make registration's covariances too small; inflation
// weighs such poses less instead of gating every other one. docs/filter.md, Pose update.
struct CovarianceInflation {
  double translation = 1.0;
  double rotation = 1.0;
};

// A body is at most so far from where the inertial samples have it, because they miss a part of the
// motion or are put together with the scans by a rig that is wrong.
struct UnseenMotion {
  double translation_m = std::numeric_limits<double>::infinity();
  double rotation_rad = std::numeric_limits<double>::infinity();
};

// The motion that was predicted up to a pose.
enum class PredictedMotion : std::int8_t {
  kKept,
  kTakenBack,  // the stamps jumped but no time has passed; the velocity stays
  kReplaced,   // nothing is known of it: the estimate is moved to the pose first (MoveTo)
};

struct PoseEvent {
  PoseMeasurement measurement;
  // Fuses the pose even beyond the gate, with the covariance or the unseen motion that explains it.
  bool force = false;
  // A pose that is farther off, beyond errors of registration, is wrong: force does not fuse it.
  UnseenMotion max_unseen;
  PredictedMotion motion = PredictedMotion::kKept;
};

// Fuses the pose into `estimate` and lets `inflation` go on to the next one. Without force a pose
// whose NIS exceeds `nis_limit` is refused.
[[nodiscard]] UpdateResult FusePoseEvent(const PoseEvent& event, double nis_limit,
                                         const CovarianceInflation& max_inflation,
                                         CovarianceInflation& inflation, Estimate& estimate);

}  // namespace lio
