// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/tracking.hpp"

#include <utility>

#include "lio/filter/map_bend.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "lio/relocalization/relocalizer.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/lidar_only.hpp"
#include "pipeline/prior_error.hpp"
#include "pipeline/scan_fusion.hpp"

namespace lio {

namespace {

Estimate WithMapStart(Estimate estimate) {
  MarkMapStart(estimate);
  return estimate;
}

}  // namespace

Tracking::Tracking(const ModeContext& context, Handover handover, const StartState& start,
                   bool is_at_rest)
    : context_(context),
      handover_(std::move(handover)),
      g_world_(start.g_world),
      history_(HistoryOptionsAt(start.estimate.stamp), WithMapStart(start.estimate),
               SampleAt(context.stream.imu().samples(), start.estimate.stamp)),
      health_(true, TrackingStatus::kOk, start.estimate.stamp, context.counters),
      zero_velocity_(context.options.rig.imu, is_at_rest),
      is_first_scan_(!std::exchange(handover_.keeps_map, false)) {
  if (is_first_scan_) context_.blind_axis.Reset();
  history_.KeepFrom(start.estimate.stamp);
  AddSamplesAfter(start.estimate.stamp);
}

HistoryOptions Tracking::HistoryOptionsAt(Timestamp stamp) const {
  const ImuRig& imu = context_.options.rig.imu;
  HistoryOptions history;
  history.noise = {imu.gyro_noise_density, imu.accel_noise_density, imu.gyro_bias_walk_density,
                   imu.accel_bias_walk_density, context_.stream.imu().NoiseAt(stamp)};
  history.g_world = g_world_;
  history.span_s = context_.options.filter.history_s;
  history.nis_limit = context_.nis_limit;
  return history;
}

HistoryOptions Tracking::LearnedOptionsAt(Timestamp stamp) const {
  HistoryOptions options = HistoryOptionsAt(stamp);
  options.rate_error = history_.rate_error();
  return options;
}

void Tracking::AddImu(const ImuReady& event) {
  if (history_.AddImu(event.sample) == EventOutcome::kTooOld) {
    ++context_.counters.num_imu_late;
    if (!event.is_made_up) {
      context_.counters.ledgers.samples.Move(SampleFate::kUsed, SampleFate::kLate);
    }
  }
  if (!event.is_made_up) PublishAtImuRate();
}

void Tracking::PublishAtImuRate() {
  const Estimate& head = history_.head();
  const auto& last = handover_.last_published;
  if (is_first_scan_ || (last && head.stamp <= *last)) return;
  handover_.last_published = head.stamp;
  NavOutput nav = MakeNav(head, MakeReportContext());
  nav.source = OdometrySource::kImuPropagated;
  context_.outputs.Add(nav);
}

ReportContext Tracking::MakeReportContext() const {
  return {.options = context_.options,
          .g_world = g_world_,
          .last_seq = handover_.last_seq,
          .status = status(),
          .imu = &context_.stream.imu(),
          .clocks = context_.clocks,
          .extrinsic = context_.extrinsic,
          .yaw_doubt = handover_.yaw_doubt,
          .gate_doubt = gate_doubt_};
}

void Tracking::AddSweep(const Sweep& sweep) {
  history_.KeepFrom(sweep.start);
}

MatchJob Tracking::MakeJob(const SweepPtr& sweep) const {
  MatchJob job = MakeTrackingJob(sweep, history_, handover_.last_located);
  job.bends_scan = job.refines_deskew;
  if (job.bends_scan) {
    CorrectPrior(trend_.Expected(), job);
  } else if (IsRigKnown()) {
    job.doubts_gyro = true;
    GuessFromGated(job);
  }
  if (is_first_scan_) job.map_action = MapAction::kClear;
  const NavState& predicted = history_.At(sweep->middle()).state;
  job.prior.up_map = InMap(predicted, Vector3::UnitZ());
  if (outage_.is_running()) {
    outage_.SetTask(PoseIfClockSet(*sweep, predicted.T_map_imu), job);
  } else if (handover_.last_located && handover_.clock_step.IsAbout(*sweep)) {
    job.task = Relocalize{std::get<Track>(job.task),
                          {SearchRegion::kObservable, PoseIfClockSet(*sweep, predicted.T_map_imu)}};
  } else if (handover_.last_located && !is_map_rebased_) {
    job.task = Relocalize{std::get<Track>(job.task), {SearchRegion::kTracked, {}}};
  }
  return job;
}

// Until the drive has shown the rig, a scan that has turned otherwise than the gyro says may tell
// of a wrong extrinsic or of another convention, which are found elsewhere.
bool Tracking::IsRigKnown() const {
  const std::optional<RigBounds>& bounds = context_.examiner.bounds();
  return bounds && bounds->rotation_rad.norm() < kImuAgreement.rotation_error_rad;
}

void Tracking::GuessFromGated(MatchJob& job) const {
  if (gate_doubt_ && !outage_.is_running()) {
    CorrectPrior(gate_doubt_->At(job.sweep->middle()), job);
  }
}

std::optional<Transition> Tracking::FinishJob(const MatchOutcome& outcome, InsertTask& insert) {
  const std::int64_t begin_ns = context_.NowNs();
  const MatchedScan scan = Look(outcome);
  last_middle_ = scan.middle();
  // A scan that comes too late for the filter's window comes too late to set its noise.
  (void)history_.AddNoise(scan.end(), scan.noise);
  if (outage_.stage() == OutageRecovery::Stage::kFindVelocity) {
    AddScanAfterOutage(outcome, false);
    Publish(scan, MakeScanReport(outcome), history_.At(scan.end()), begin_ns);
    return std::nullopt;
  }
  if (scan.is_stale) {
    PassOver(scan, begin_ns);
    return std::nullopt;
  }
  if (auto transition = DoubtImu(scan)) {
    // The prediction follows the samples that are in doubt.
    Publish(scan, MakeScanReport(outcome), BeginWithoutImu(*transition, scan.end(), context_),
            begin_ns);
    return transition;
  }
  return TakeScan(scan, insert, begin_ns);
}

std::optional<Transition> Tracking::TakeScan(const MatchedScan& scan, InsertTask& insert,
                                             std::int64_t begin_ns) {
  const MatchOutcome& outcome = scan.outcome;
  if (scan.starts_map()) context_.examiner.record().BeginMap();
  const ScanReport report = FuseWithTrend(scan);
  UpdateBesides(scan, report.fused);
  const Health::Verdict verdict =
      health_.AddScan(scan.end(), outcome.match, outcome.num_used, report.fused);
  // An initial map is not of this path, so it never goes on from a prediction; nor does a map from
  // one that may be anywhere.
  const bool rebases_map = verdict.rebases_map && !scan.is_sought && !context_.place.is_inside() &&
                           IsPriorSure(scan.middle());
  GrowMap(scan, report, rebases_map, insert);
  AddScanAfterOutage(outcome, report.fused);
  if (rebases_map || report.fused) is_map_rebased_ = rebases_map;
  is_first_scan_ = false;
  RememberForHandover(scan, report.fused);
  if (verdict.is_newly_lost) TellLost(scan.end());
  RememberFix(scan, report.fused);
  Publish(scan, report, history_.At(scan.end()), begin_ns);
  LookAtRig(scan.end());
  return JudgeSelf(scan.end(), verdict.restarts);
}

Tracking::MatchedScan Tracking::Look(const MatchOutcome& outcome) const {
  MatchedScan scan{.outcome = outcome};
  scan.noise = context_.stream.imu().NoiseAt(scan.end());
  scan.is_sought = outage_.stage() == OutageRecovery::Stage::kSeek ||
                   outage_.stage() == OutageRecovery::Stage::kCheck;
  scan.is_keyframe = !scan.is_sought && !context_.place.is_map_locked() &&
                     keyframes_.IsKeyframe(outcome.match.T_map_imu);
  scan.is_place_sure = health_.num_unmatched_in_a_row() == 0 && !outcome.is_relocalized;
  scan.is_stale = outcome.is_repeated && !is_first_scan_ && HasMovedUntil(scan.middle());
  return scan;
}

ScanReport Tracking::FuseWithTrend(const MatchedScan& scan) {
  const Pose T_map_imu_predicted = history_.At(scan.middle()).state.T_map_imu;
  ScanReport report = Fuse(scan);
  trend_.Forget();
  if (report.fused && !scan.outcome.is_relocalized) {
    trend_.Add(T_map_imu_predicted, history_.At(scan.middle()).state.T_map_imu);
  }
  NoteIfGated(scan, report);
  return report;
}

void Tracking::NoteIfGated(const MatchedScan& scan, const ScanReport& report) {
  gate_doubt_.reset();
  const MatchResult& match = scan.outcome.match;
  const bool is_gated = !report.fused && report.nis > 0.0;
  if (!is_gated || match.HasSlid() || !handover_.last_located) return;
  const Estimate predicted = history_.At(scan.middle());
  const Vector6 by = LogSe3(predicted.state.T_map_imu.Inverse() * match.T_map_imu);
  const Matrix3 turn_cov =
      predicted.cov.block<3, 3>(kMapPose + 3, kMapPose + 3) + match.cov.bottomRightCorner<3, 3>();
  const Vector3 turn = by.tail<3>();
  const bool has_turned = turn.dot(turn_cov.ldlt().solve(turn)) > context_.nis_limit;
  const GateDoubt doubt{by, scan.middle(), *handover_.last_located};
  if (has_turned || doubt.IsWithinReachOfForces()) gate_doubt_ = doubt;
}

void Tracking::RememberForHandover(const MatchedScan& scan, bool is_fused) {
  if (!is_fused && !scan.starts_map()) return;
  handover_.last_fused = scan.end();
  handover_.last_located = scan.middle();
  handover_.last_seq = scan.outcome.sweep->scan_seq;
}

void Tracking::RememberFix(const MatchedScan& scan, bool is_fused) {
  if (!is_fused || !scan.is_place_sure) return;
  handover_.last_fix = MakeFix(scan.middle(), history_.At(scan.middle()), g_world_);
}

bool Tracking::IsPriorSure(Timestamp middle) const {
  return IsWithinConvergenceBasin(history_.At(middle).cov.block<6, 6>(kMapPose, kMapPose));
}

// Gives the scan's row and takes it off the queue.
void Tracking::Publish(const MatchedScan& scan, ScanReport report, const Estimate& at_end,
                       std::int64_t begin_ns) {
  const Timestamp end = scan.end();
  CompleteTimes(scan.outcome.stage_ns, context_.NowNs() - begin_ns, report);
  FilterReport filter = MakeFilterReport(at_end, report, MakeReportContext());
  filter.imu_noise = NoiseRatiosOf(scan.noise, context_.options.rig.imu);
  if (const auto news = context_.imu_noise.Add(filter.imu_noise)) {
    context_.outputs.Notify(end, Notice::Severity::kInfo, *news);
  }
  if (const auto news = context_.imu_rate.Add(context_.stream.imu().samples(), end)) {
    context_.outputs.Notify(end, Notice::Severity::kInfo, *news);
  }
  context_.outputs.Add(ScanOutput{std::move(filter), report, context_.examiner.trust()});
  context_.EndSweep(report.fused || scan.starts_map());
  KeepHistoryForQueue();
}

void Tracking::KeepHistoryForQueue() {
  const auto& sweeps = context_.sweeps;
  history_.KeepFrom(sweeps.empty() ? std::nullopt : std::optional(sweeps.front()->start));
}

ScanReport Tracking::Fuse(const MatchedScan& scan) {
  const MatchOutcome& outcome = scan.outcome;
  ScanReport report = MakeScanReport(outcome);
  if (!outcome.match.IsUsable()) return report;
  context_.convention.AddPose({outcome.sweep->middle(), outcome.match.T_map_imu});
  Examine(outcome);
  FusionSettings settings;
  settings.gyro_density = RaisedTo(scan.noise, context_.options.rig.imu).gyro_noise_density;
  settings.alike_factor = zero_velocity_.match_cov_factor();
  settings.grows_map = scan.is_keyframe;
  settings.is_level = FeelsGravity();
  settings.is_map_unproved = is_map_rebased_;
  settings.replaces_motion = outage_.stage() == OutageRecovery::Stage::kSeek;
  FuseScan(outcome, settings, context_, history_, health_, report);
  return report;
}

// Records the match as it is, before the filter.
void Tracking::Examine(const MatchOutcome& outcome) const {
  MotionRecord& record = context_.examiner.record();
  if (outcome.match.degenerate_mask != 0 || outcome.is_relocalized) return record.Interrupt();
  const Timestamp middle = outcome.sweep->middle();
  const Duration correction = outcome.sweep->clock_correction;
  const Timestamp since = record.last_stamp().value_or(middle);
  record.Add({middle, outcome.match.T_map_imu}, correction,
             SamplesAbout(context_.stream.imu(), since, middle));
}

// Updates the filters that stand beside this one.
void Tracking::UpdateBesides(const MatchedScan& scan, bool is_fused) {
  const MatchOutcome& outcome = scan.outcome;
  if (is_fused) {
    SettleClockStep(outcome);
    if (context_.options.filter.use_zero_velocity &&
        zero_velocity_.AddFusedScan(outcome, g_world_, history_)) {
      ++context_.counters.num_standstills;
    }
  }
  const double gyro_density = RaisedTo(scan.noise, context_.options.rig.imu).gyro_noise_density;
  if (const auto news = context_.clocks.AddScan(outcome, history_, gyro_density)) {
    context_.outputs.Notify(scan.end(), Notice::Severity::kInfo, *news);
  }
}

// The map is grown at the predicted pose if it has nothing to match against.
void Tracking::GrowMap(const MatchedScan& scan, const ScanReport& report, bool rebases_map,
                       InsertTask& insert) {
  const Timestamp middle = scan.middle();
  const bool begins_map = scan.starts_map() || rebases_map;
  if (begins_map) context_.sensor_errors.BeginMap();
  if (begins_map && history_.AddRebase(middle) != EventOutcome::kApplied) {
    ++context_.counters.num_scans_late;
  }
  if (!begins_map && !(report.fused && scan.is_keyframe)) return;
  const NavState state = history_.At(middle).state;
  insert.T_map_imu = begins_map || !FeelsGravity() ? state.T_map_imu : LevelMapPose(state, 1.0);
  keyframes_.Accept(*insert.T_map_imu);
}

std::optional<Transition> Tracking::JudgeSelf(Timestamp sweep_end, bool restarts) {
  const bool is_contradicted = context_.convention.IsContradicted(
      {sweep_end, health_.num_unmatched_in_a_row(), health_.NumGatedLately(),
       history_.head().state.gyro_bias});
  if (is_contradicted) {
    context_.clocks.Restart();  // the offset was found with wrong rates
    return Restart(Trigger::kConventionDoubted, sweep_end,
                   "scan matching and the IMU disagree: initialization begins again to find out "
                   "whether the IMU's units or axes are others");
  }
  if (!restarts) return std::nullopt;
  return Restart(Trigger::kLost, sweep_end,
                 "lost: scans see enough but match the map nowhere, so initialization begins "
                 "again at the last pose that was found; if it happens often, check the rig and "
                 "the IMU");
}

Transition Tracking::Restart(Trigger trigger, Timestamp stamp, const std::string& why) const {
  context_.outputs.Notify(stamp, Notice::Severity::kWarning, why);
  Handover handover = handover_;
  handover.origin = Handover::Origin::kInertial;
  return {.trigger = trigger, .handover = std::move(handover)};
}

StartState Tracking::KnownAt(Timestamp stamp) const {
  StartState known;
  known.estimate = history_.At(stamp);
  known.g_world = g_world_;
  return known;
}

Transition Tracking::GoLidarOnly(Trigger trigger, StartState known,
                                 const Vector3& w_imu_radps) const {
  Transition transition{.trigger = trigger, .handover = handover_};
  transition.handover.keeps_map = true;
  transition.seed.motion = known.estimate.state;
  transition.seed.motion->gyro_bias = -w_imu_radps;
  transition.start = std::move(known);
  return transition;
}

Transition Tracking::TakeImuAbsent(const ImuAbsent& event) const {
  if (is_first_scan_) {  // there is no map yet
    return {.trigger = Trigger::kImuAbsent, .handover = handover_};
  }
  StartState known = KnownAt(event.begin);
  const Vector3 w_imu_radps = event.w_imu_radps - known.estimate.state.gyro_bias;
  return GoLidarOnly(Trigger::kImuAbsent, std::move(known), w_imu_radps);
}

}  // namespace lio
