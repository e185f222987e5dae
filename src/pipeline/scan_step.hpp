// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the two steps of a scan that every mode shares: the job that matches it, predicted by a
// filter, and the fusion of what matching found. They are pure functions of their arguments.
#pragma once

#include <optional>

#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/match_job.hpp"
#include "lio/pipeline/options.hpp"

namespace lio {

struct ScanStepParameters {
  // A sweep with missing inertial samples may be bent by more than this after the deskew: it is
  // deskewed again along the motion that the match found. Chosen: 10 cm at 20 m; used in
  // docs/experiments/imu_gaps.md.
  double unsure_turn_rad = 0.005;
  // A shift since the last located scan that is less sure than this is beyond what matching
  // reaches: correlative alignment betters the prior. Chosen: two of it leave the cells of 1 m.
  double align_prior_from_std_m = 0.7;
  // A prior counts as having run free for this time at least, so that rates by it stay finite.
  // Chosen: a tenth of a sweep at 10 Hz.
  double min_since_last_fix_s = 0.01;
  // The distance of a gated match from its prediction foretells that of the next one, grown by this
  // factor at most. Chosen: the first scan that is gated is about one sweep after the last
  // fix, and the next one two.
  double max_growth_of_gated = 2.2;
  // An accelerometer that is off by more is not told from a wrong match. Chosen: 3 g, near the
  // smallest ranges of accelerometers; with half of it a simulated warehouse is lost
  // (docs/experiments/dead_imu.md).
  double max_force_error_mps2 = 30.0;
};

inline constexpr ScanStepParameters kScanStep;

// Makes a job that tracks the sweep from the filter's prediction for its middle. `last_located` is
// the middle of the last sweep that was located, if there is one.
[[nodiscard]] MatchJob MakeTrackingJob(const SweepPtr& sweep, const FilterHistory& history,
                                       std::optional<Timestamp> last_located);

// How a mode wants its matches to be fused.
struct FusionSettings {
  double gyro_density = 0.0;  // rad/s/sqrt(Hz); zero without a gyro
  // The covariance of matches is scaled by this, for errors that are alike from scan to scan.
  double alike_factor = 1.0;
  bool grows_map = false;        // the scan will be inserted
  bool is_level = false;         // ... level, with the map's bend taken back (map_bend.hpp)
  bool is_map_unproved = false;  // it began anew, and no scan has been fused with it yet
  bool replaces_motion = false;  // nothing is known of the motion since the last fused scan
  bool is_inertial = true;       // the prediction follows the inertial samples
};

// How wrong one match may be.
struct MatchJudgement {
  Matrix6 match_cov;                           // right error of T_map_imu [m; rad]
  Matrix6 sensor_error_cov = Matrix6::Zero();  // SensorFixedErrors::CovPerReplacement()
  bool force = false;                          // fuse even beyond the gate
  UnseenMotion max_unseen = {};                // as PoseEvent's
};

struct FusedMatch {
  EventOutcome outcome = EventOutcome::kGated;
  double nis = 0.0;  // normalised innovation squared
};

// Fuses a usable match at the sweep's middle. The measurement's covariance is that of the match and
// of what errors of the motion within the sweep leave in the deskewed scan.
[[nodiscard]] FusedMatch FuseMatch(const MatchOutcome& outcome, const MatchJudgement& judgement,
                                   const FusionSettings& settings, const FilterOptions& filter,
                                   FilterHistory& history);

// Returns the report of the matching for registration.csv: all but the filter's part.
[[nodiscard]] ScanReport MakeScanReport(const MatchOutcome& outcome);

// Adds the filter's time to the stage times, and their total.
void CompleteTimes(const StageTimes& stage_ns, std::int64_t filter_ns, ScanReport& report);

}  // namespace lio
