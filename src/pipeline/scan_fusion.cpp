// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/scan_fusion.hpp"

#include "pipeline/unseen_motion.hpp"

namespace lio {
namespace {

// Is the motion between these instants a guess, since the prediction follows no inertial samples or
// they have missed a part of it?
bool IsMotionGuessed(Timestamp from, Timestamp until, const FusionSettings& settings,
                     const ModeContext& context) {
  return !settings.is_inertial || IsMotionHidden(context.stream.imu().Between(from, until));
}

// Returns the samples whose errors are still in the estimate.
std::vector<ImuSample> LastingSamples(Timestamp until, const ModeContext& context) {
  return context.stream.imu().Between(until - Duration::FromSeconds(kUnseenMotion.lasts_s), until);
}

UnseenMotion MaxUnseenMotion(const MatchOutcome& outcome, const FusionSettings& settings,
                             const ModeContext& context, const FilterHistory& history) {
  if (outcome.is_relocalized || outcome.is_clock_set || settings.replaces_motion) return {};
  if (!settings.is_inertial) return {};
  const Timestamp until = outcome.sweep->end;
  const std::vector<ImuSample> samples = LastingSamples(until, context);
  if (IsMotionHidden(samples)) return {};
  const std::optional<RigBounds>& bounds = context.examiner.bounds();
  if (bounds) {
    return MotionByRigErrors(*bounds, samples, history.At(until).state.v_world_imu.norm());
  }
  return {};  // nothing is known of the rig yet
}

// May a match lie wrong because it hangs on few surfaces, while the samples have missed nothing?
bool MayLieWrong(const MatchOutcome& outcome, bool is_blind, const FusionSettings& settings,
                 const ModeContext& context) {
  return is_blind && settings.is_inertial &&
         !IsMotionHidden(LastingSamples(outcome.sweep->end, context));
}

// Must the match be fused even beyond the gate, since the filter itself must be wrong?
bool IsForced(const MatchOutcome& outcome, bool is_blind, const FusionSettings& settings,
              const ModeContext& context, const Health& health) {
  const std::optional<Timestamp> last_fused = health.last_fused();
  const bool is_contradicted_by_guess =
      !is_blind && last_fused &&
      IsMotionGuessed(*last_fused, outcome.sweep->end, settings, context);
  // A map of one scan is of rings, which hold a body back: it cannot overrule the inertial samples.
  const bool is_insisted_on = health.MustForce(context.options.filter.max_gated_in_a_row) &&
                              !settings.is_map_unproved &&
                              !MayLieWrong(outcome, is_blind, settings, context);
  return is_contradicted_by_guess || outcome.is_relocalized || is_insisted_on;
}

// Returns the covariance of the pose before the match. If the lidar is alone it follows from the
// matches themselves, and the pose is taken for sure (docs/experiments/starts_in_motion.md).
Matrix6 PriorCov(const MatchOutcome& outcome, const FusionSettings& settings,
                 const FilterHistory& history) {
  if (!settings.is_inertial || outcome.match.blind_directions.empty()) return Matrix6::Zero();
  return history.At(outcome.sweep->middle()).cov.block<6, 6>(kMapPose, kMapPose);
}

MatchJudgement Judge(const MatchOutcome& outcome, const FusionSettings& settings,
                     const ModeContext& context, const FilterHistory& history,
                     const Health& health) {
  const auto [match_cov, is_blind] =
      context.blind_axis.Judge(outcome.match, PriorCov(outcome, settings, history));
  MatchJudgement judgement{
      .match_cov = match_cov,
      .sensor_error_cov = context.sensor_errors.CovPerReplacement(outcome.match),
      .force = IsForced(outcome, is_blind, settings, context, health)};
  if (judgement.force) {
    judgement.max_unseen = MaxUnseenMotion(outcome, settings, context, history);
  }
  return judgement;
}

}  // namespace

void FuseScan(const MatchOutcome& outcome, const FusionSettings& settings,
              const ModeContext& context, FilterHistory& history, Health& health,
              ScanReport& report) {
  if (outcome.is_relocalized) context.blind_axis.Reset();
  const MatchJudgement judgement = Judge(outcome, settings, context, history, health);
  const FusedMatch fused = FuseMatch(outcome, judgement, settings, context.options.filter, history);
  health.AddFusion(fused.outcome);
  report.nis = fused.nis;
  report.fused = fused.outcome == EventOutcome::kApplied;
  if (report.fused && settings.grows_map) context.sensor_errors.Add(outcome.match);
}

}  // namespace lio
