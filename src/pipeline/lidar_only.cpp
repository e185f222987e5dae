// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/lidar_only.hpp"

#include <algorithm>
#include <utility>

#include "lio/filter/estimate_change.hpp"
#include "pipeline/coarse_tracking.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/gravity_check.hpp"
#include "pipeline/outage.hpp"
#include "pipeline/prior_error.hpp"
#include "pipeline/scan_fusion.hpp"

namespace lio {
namespace {

// Adds what a body may have done that nothing has followed for so long: it turned, which leads its
// way of `v_mps` aside, and its velocity changed by `dv_mps`.
void AddUnseen(double since_s, const Vector3& v_mps, const Vector3& dv_mps, Matrix6& pose_cov) {
  const double turn_std_rad = UnseenTurnStd_rad(since_s);
  const double aside_std_m = std::min(turn_std_rad, 1.0) * since_s * v_mps.norm();
  const double along_std_m = since_s * dv_mps.norm();
  pose_cov.diagonal().head<3>().array() += aside_std_m * aside_std_m + along_std_m * along_std_m;
  pose_cov.diagonal().tail<3>().array() += turn_std_rad * turn_std_rad;
}

void TellImuFollows(Timestamp end, const ModeContext& context) {
  context.outputs.Notify(end, Notice::Severity::kWarning,
                         "the IMU follows the motion again that scans show: the filter goes on "
                         "with it, and nothing need be done");
}

TrackerOptions OptionsOfTrack(const MotionSeed& seed, const ModeContext& context) {
  TrackerOptions options;
  options.span_s = context.options.filter.history_s;
  options.nis_limit = context.nis_limit;
  options.seed = seed;
  options.follows_turns = true;
  return options;
}

}  // namespace

Estimate BeginWithoutImu(const Transition& transition, Timestamp stamp,
                         const ModeContext& context) {
  TrackerOptions options = OptionsOfTrack(transition.seed, context);
  options.goes_on_from = transition.start.value().estimate;
  ConstantVelocityTracker tracker(options.goes_on_from->stamp, options);
  tracker.AdvanceTo(stamp);
  return tracker.history().At(stamp);
}

LidarOnly::LidarOnly(const ModeContext& context, Handover handover, const MotionSeed& seed,
                     std::optional<StartState> inertial)
    : context_(context),
      handover_(std::move(handover)),
      seed_(seed),
      health_(false, TrackingStatus::kInit, handover_.last_fused, context.counters),
      inertial_(std::move(inertial)) {
  handover_.keeps_map = false;
  if (inertial_) g_world_ = inertial_->g_world;
  if (inertial_ && handover_.doubts_imu()) imu_back_since_ = inertial_->estimate.stamp;
}

MatchJob LidarOnly::MakeJob(const SweepPtr& sweep) {
  const bool is_first = !tracker_;
  if (is_first && inertial_) {
    GoOn();
  } else if (is_first) {
    BeginTrack(*sweep);
  } else {
    FollowClockBack(*sweep, *tracker_, handover_.last_located);
  }
  if (tracker_->has_gyro()) AddRates(sweep->end);
  tracker_->AdvanceTo(sweep->end);
  MatchJob job = MakeCoarseJob(sweep, *tracker_, handover_.last_located, up_map_);
  job.bends_scan = !tracker_->has_gyro();
  CorrectPrior(trend_.Expected(), job);
  if (!inertial_ && num_scans_ < kLidarOnly.warm_up_scans) job.map_action = MapAction::kWarmUp;
  if (!inertial_ && is_first) job.map_action = MapAction::kClear;
  if (handover_.last_located) {
    job.task = Relocalize{std::get<Track>(job.task), {SearchRegion::kAnywhere, {}}};
  }
  return job;
}

void LidarOnly::BeginTrack(const Sweep& sweep) {
  handover_.last_located.reset();
  TrackerOptions options = OptionsOfTrack(seed_, context_);
  const Timestamp start = TrackStart(sweep, seed_);
  options.first_rate_radps = RateAt(start);
  if (options.first_rate_radps && options.seed.motion) {
    options.seed.motion->gyro_bias = handover_.imu_doubt->biases.gyro;
  }
  if (handover_.doubts_imu()) imu_back_since_ = sweep.start;
  if (handover_.origin != Handover::Origin::kNone) StartAtLastFix(start, options);
  handover_.was_level |= handover_.origin == Handover::Origin::kInertial;
  handover_.is_placed = false;
  tracker_.emplace(start, options);
  handover_.origin = Handover::Origin::kLidar;
  handover_.last_fix = MakeFix(start, tracker_->history().head(), Vector3::Zero());
  context_.convention.BeginMap(sweep.start);
  context_.blind_axis.Reset();
  up_map_ = handover_.was_level ? Vector3::UnitZ()
                                : options.T_world_start.rotation * MeanUp({}, context_.options.rig);
}

// The world and the map are the inertial filter's.
void LidarOnly::GoOn() {
  TrackOn(inertial_->estimate, RateAt(inertial_->estimate.stamp));
  handover_.origin = Handover::Origin::kLidar;
  handover_.was_level = !g_world_.isZero();
  up_map_ = InMap(inertial_->estimate.state, Vector3::UnitZ());
}

// The estimate may be the tracker's that ends here, so it is a copy.
void LidarOnly::TrackOn(Estimate estimate, const std::optional<Vector3>& rate_radps) {
  TrackerOptions options = OptionsOfTrack(seed_, context_);
  options.goes_on_from = std::move(estimate);
  options.first_rate_radps = rate_radps;
  tracker_.emplace(options.goes_on_from->stamp, options);
}

// The published path goes on: the new map begins where the motion before and after the scans that
// were not located leads.
void LidarOnly::StartAtLastFix(Timestamp start, TrackerOptions& options) const {
  const LastFix& fix = handover_.last_fix;
  const double since_s = CoastedSince_s(fix, start);
  const bool is_lost = handover_.origin == Handover::Origin::kLostLidar;
  const double turned_s = is_lost ? std::min(since_s, kLidarOnly.turn_unseen_for_s) : 0.0;
  const Vector3 turn = turned_s * handover_.w_imu_radps;
  const Quaternion rotation = fix.T_world_imu.rotation * ExpSo3(turn);
  Vector3 v_world_mps = fix.v_world_imu;
  if (seed_.motion) {
    const Vector3 v_imu_mps =
        seed_.motion->T_world_imu.rotation.conjugate() * seed_.motion->v_world_imu;
    v_world_mps = 0.5 * (v_world_mps + rotation * v_imu_mps);
  }
  options.T_world_start = {rotation, fix.T_world_imu.translation + since_s * v_world_mps};
  Vector6 least;
  least << Vector3::Constant(kPlacedStd_m * kPlacedStd_m),
      Vector3::Constant(kPlacedStd_rad * kPlacedStd_rad);
  options.start_cov = is_lost ? handover_.pose_cov : fix.pose_cov;
  options.start_cov.diagonal() += least;
  if (!is_lost) {
    AddUnseen(since_s, v_world_mps, v_world_mps - fix.v_world_imu, options.start_cov);
  }
}

bool LidarOnly::IsPlaceSure(const MatchOutcome& outcome) const {
  return health_.num_unmatched_in_a_row() == 0 && !outcome.is_relocalized;
}

std::optional<Transition> LidarOnly::FinishJob(const MatchOutcome& outcome, InsertTask& insert) {
  const std::int64_t begin_ns = context_.NowNs();
  const Timestamp middle = outcome.sweep->middle();
  const bool starts_map = outcome.match.status == MatchStatus::kEmptyMap;
  const bool is_place_sure = IsPlaceSure(outcome);
  const bool is_keyframe = keyframes_.IsKeyframe(outcome.match.T_map_imu) && is_place_sure &&
                           !context_.place.is_map_locked();
  const Pose T_map_imu_predicted = tracker_->history().At(middle).state.T_map_imu;
  ScanReport report = Fuse(outcome, is_keyframe);
  trend_.Forget();
  if (starts_map) BeginMap(middle);
  const Estimate estimate = tracker_->history().At(middle);
  const bool is_located = report.fused || starts_map;
  if (report.fused && !outcome.is_relocalized) {
    NoteError(T_map_imu_predicted, estimate.state.T_map_imu, middle);
  }
  if (starts_map || (report.fused && is_keyframe)) {
    insert.T_map_imu = estimate.state.T_map_imu;
    keyframes_.Accept(estimate.state.T_map_imu);
  }
  ++num_scans_;
  const Health::Verdict verdict =
      health_.AddScan(outcome.sweep->end, outcome.match, outcome.num_used, report.fused);
  if (verdict.is_newly_lost) NotifyLost(outcome.sweep->end, context_.outputs);
  if (is_located) Remember(*outcome.sweep);
  handover_.last_fused = health_.last_fused();
  if (report.fused && is_place_sure) handover_.last_fix = MakeFix(middle, estimate, g_world_);
  CompleteTimes(outcome.stage_ns, context_.NowNs() - begin_ns, report);
  Publish(outcome, report);
  context_.EndSweep(is_located);
  if (handover_.doubts_imu()) CompareWithImu(outcome, report.fused);
  if (auto transition = TryReturn(outcome, report.fused && is_place_sure)) return transition;
  if (verdict.restarts) return RestartWhenLost(outcome.sweep->end);
  return std::nullopt;
}

void LidarOnly::BeginMap(Timestamp middle) {
  context_.sensor_errors.BeginMap();
  if (tracker_->history().AddRebase(middle) != EventOutcome::kApplied) {
    ++context_.counters.num_scans_late;
  }
}

void LidarOnly::Remember(const Sweep& located) {
  handover_.last_located = located.middle();
  handover_.last_seq = located.scan_seq;
}

// The pose that was fused: where a match sees nothing it has the error that was expected, which
// would confirm itself from scan to scan.
void LidarOnly::NoteError(const Pose& T_map_imu_predicted, const Pose& T_map_imu_fused,
                          Timestamp middle) {
  trend_.Add(T_map_imu_predicted, T_map_imu_fused);
  if (!handover_.last_located) return;
  const double since_s = SecondsBetween(*handover_.last_located, middle);
  if (since_s > 0.0) tracker_->NoteTurnError(trend_.error().tail<3>().norm(), since_s);
}

ScanReport LidarOnly::Fuse(const MatchOutcome& outcome, bool is_keyframe) {
  ScanReport report = MakeScanReport(outcome);
  if (!outcome.match.IsUsable()) return report;
  FusionSettings settings;
  settings.grows_map = is_keyframe;
  settings.is_inertial = false;
  FuseScan(outcome, settings, context_, tracker_->history(), health_, report);
  return report;
}

void LidarOnly::Publish(const MatchOutcome& outcome, const ScanReport& report) {
  const Timestamp end = outcome.sweep->end;
  const Estimate at_end = report.fused
                              ? tracker_->AtEnd(outcome.sweep->middle(), end, outcome.turn_rate)
                              : tracker_->history().At(end);
  const ReportContext context{.options = context_.options,
                              .g_world = g_world_,
                              .last_seq = handover_.last_seq,
                              .status = health_.status(),
                              .imu = nullptr,
                              .clocks = context_.clocks,
                              .extrinsic = context_.extrinsic,
                              .yaw_doubt = handover_.yaw_doubt};
  context_.outputs.Add(
      ScanOutput{MakeFilterReport(at_end, report, context), report, context_.examiner.trust()});
}

Transition LidarOnly::RestartWhenLost(Timestamp sweep_end) const {
  const Estimate estimate = tracker_->history().At(sweep_end);
  Handover handover = handover_;
  handover.origin = Handover::Origin::kLostLidar;
  handover.w_imu_radps = tracker_->w_imu_radps();
  handover.pose_cov = estimate.cov.topLeftCorner<6, 6>();
  context_.outputs.Notify(
      sweep_end, Notice::Severity::kWarning,
      "lost: scans see enough but match the map nowhere, so the map begins "
      "anew at the last pose that was found; if it happens often, an IMU helps");
  return {.trigger = Trigger::kLost, .handover = std::move(handover)};
}

std::optional<Transition> LidarOnly::TakeImu(const ImuAppeared& event) {
  if (inertial_ && tracker_) {
    imu_back_since_ = event.first;
    context_.outputs.Notify(event.first, Notice::Severity::kWarning,
                            "inertial samples come again: the next scan that matches goes on with "
                            "them, and nothing need be done");
    return std::nullopt;
  }
  context_.outputs.Notify(event.first, Notice::Severity::kWarning,
                          "inertial samples have come: initialization begins again, with them, and "
                          "nothing need be done");
  return InitializeAgain();
}

Transition LidarOnly::InitializeAgain() const {
  Handover handover = handover_;
  handover.origin = Handover::Origin::kLidar;
  handover.is_map_by_lidar = true;
  handover.BelieveImu();
  return {.trigger = Trigger::kImuAppeared, .handover = std::move(handover)};
}

std::optional<Transition> LidarOnly::TryReturn(const MatchOutcome& outcome, bool is_sure) const {
  const Timestamp end = outcome.sweep->end;
  if (!imu_back_since_ || SecondsBetween(*imu_back_since_, end) < kGravityCheck.window_s) {
    return std::nullopt;
  }
  if (handover_.doubts_imu() && !FollowsAgain(outcome.sweep->middle())) return std::nullopt;
  if (!inertial_) {
    TellImuFollows(end, context_);
    return InitializeAgain();
  }
  if (IsMisled(end)) return ReturnInNewMap(outcome);
  return is_sure ? std::optional(ReturnToImu(outcome)) : std::nullopt;
}

// Scans alone tell no tilt, and where they show little they may turn the path over.
bool LidarOnly::IsMisled(Timestamp sweep_end) const {
  if (g_world_.isZero()) return false;
  const Timestamp from = sweep_end - Duration::FromSeconds(kGravityCheck.window_s);
  const NavState& before = inertial_->estimate.state;
  return GravityContradicts(context_.stream.imu().Between(from, sweep_end),
                            tracker_->history().At(from), tracker_->history().At(sweep_end),
                            g_world_, {before.gyro_bias, before.accel_bias});
}

// Nothing that was found since the inertial samples ended is believed.
Transition LidarOnly::ReturnInNewMap(const MatchOutcome& outcome) const {
  StartState start = *inertial_;
  Handover handover = handover_;
  handover.origin = Handover::Origin::kInertial;
  handover.keeps_map = true;
  handover.last_fix = MakeFix(start.estimate.stamp, start.estimate, g_world_);
  start.estimate = AcrossOutage(start.estimate, outcome.sweep->middle());
  context_.outputs.Notify(outcome.sweep->end, Notice::Severity::kWarning,
                          "lost: gravity contradicts the motion that scans alone led to, so "
                          "nothing is believed of the time without inertial samples");
  return {.trigger = Trigger::kImuReturned,
          .handover = std::move(handover),
          .start = std::move(start),
          .needs_new_map = true};
}

// The pose and the velocity are the scan's; biases are as before, but an IMU that was off may have
// others.
Transition LidarOnly::ReturnToImu(const MatchOutcome& outcome) const {
  const ImuRig& imu = context_.options.rig.imu;
  StartState start = *inertial_;
  const NavState before = start.estimate.state;
  start.estimate = tracker_->history().At(outcome.sweep->middle());
  start.estimate.state.gyro_bias = before.gyro_bias;
  start.estimate.state.accel_bias = before.accel_bias;
  ForgetBiases(start.estimate);
  const auto set = [&](int at, double std) {
    start.estimate.cov.diagonal().segment<3>(at).setConstant(std * std);
  };
  set(kGyroBias, imu.gyro_bias_std_radps);
  set(kAccelBias, imu.accel_bias_std_mps2);
  Handover handover = handover_;
  if (handover_.doubts_imu()) {
    handover.BelieveImu();
    TellImuFollows(outcome.sweep->end, context_);
  }
  handover.origin = Handover::Origin::kInertial;
  handover.keeps_map = true;
  return {
      .trigger = Trigger::kImuReturned, .handover = std::move(handover), .start = std::move(start)};
}

}  // namespace lio
