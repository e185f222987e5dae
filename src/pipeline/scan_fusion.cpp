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

UnseenMotion MaxUnseenMotion(const MatchOutcome& outcome, bool is_blind,
                             const FusionSettings& settings, const ModeContext& context,
                             const FilterHistory& history) {
  if (outcome.is_relocalized || outcome.is_clock_set || settings.replaces_motion) return {};
  if (!settings.is_inertial) return {};
  const Timestamp until = outcome.sweep->end;
  const Duration window = Duration::FromSeconds(kUnseenMotion.lasts_s);
  const std::vector<ImuSample> samples = context.stream.imu().Between(until - window, until);
  if (IsMotionHidden(samples)) return {};
  const std::optional<RigBounds>& bounds = context.examiner.bounds();
  if (bounds) {
    return MotionByRigErrors(*bounds, samples, history.At(until).state.v_world_imu.norm());
  }
  // Nothing is known of the rig yet: a match that sees all directions is believed.
  return is_blind ? UnseenMotion{0.0, 0.0} : UnseenMotion{};
}

}  // namespace

void FuseScan(const MatchOutcome& outcome, FusionSettings settings, const ModeContext& context,
              FilterHistory& history, Health& health, ScanReport& report) {
  const FilterOptions& filter = context.options.filter;
  if (outcome.is_relocalized) context.blind_axis.Reset();
  const BlindAxis::Answer answer = context.blind_axis.Judge(outcome.match);
  settings.match_cov = answer.cov;
  settings.sensor_error_cov = context.sensor_errors.CovPerReplacement(outcome.match);
  const std::optional<Timestamp> last_fused = health.last_fused();
  const bool is_contradicted_by_guess =
      !answer.is_blind && last_fused &&
      IsMotionGuessed(*last_fused, outcome.sweep->end, settings, context);
  // A map of one scan is of rings, which hold a body back: it cannot overrule the inertial samples.
  const bool is_insisted_on =
      health.MustForce(filter.max_gated_in_a_row) && !settings.is_map_unproved;
  settings.force = is_contradicted_by_guess || outcome.is_relocalized || is_insisted_on;
  if (settings.force)
    settings.max_unseen = MaxUnseenMotion(outcome, answer.is_blind, settings, context, history);
  const EventOutcome fused = FuseMatch(outcome, settings, filter, history, report.nis);
  health.AddFusion(fused);
  report.fused = fused == EventOutcome::kApplied;
  if (report.fused && settings.grows_map) context.sensor_errors.Add(outcome.match);
}

}  // namespace lio
