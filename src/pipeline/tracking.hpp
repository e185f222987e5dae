// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The mode that this program is for: the error-state filter propagates with the IMU and fuses the
// pose of each scan, matched against the map. Zero-velocity updates, the clock-offset filter and
// the watch on the IMU convention stand beside it. A gap of the inertial stream or a step of its
// clock is carried over; a state that is lost, or contradicted by matching, and samples that come
// no more end the mode.
#pragma once

#include <optional>
#include <string>

#include "lio/pipeline/keyframe_policy.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/health.hpp"
#include "pipeline/imu_agreement.hpp"
#include "pipeline/mode_context.hpp"
#include "pipeline/motion_trend.hpp"
#include "pipeline/outage.hpp"
#include "pipeline/segment_jump.hpp"
#include "pipeline/transition.hpp"
#include "pipeline/zero_velocity_updater.hpp"

namespace lio {

class Tracking {
 public:
  // Begins at start.estimate with the samples in the stream's buffer, in an empty map unless the
  // handover says that the map is kept.
  Tracking(const ModeContext& context, Handover handover, const StartState& start, bool is_at_rest);

  void AddImu(const ImuReady& event);
  void AddSweep(const Sweep& sweep);  // the queue before it must be empty
  void TakeClockStep(const AmbiguousClockStep& step);
  // Carries the state over a gap or a step of the clock, unsure of what happened in between.
  void StartSegment(const SegmentStarts& segment);

  // The place in the map is lost: the next scans begin a new one.
  void BeginNewMap();

  // The map so far was found in the initial one: goes on there, from the sweep that was found.
  void EnterMap(const FoundPlace& place, const Sweep& sweep);

  // Goes on without the IMU, in the same world and map.
  [[nodiscard]] Transition TakeImuAbsent(const ImuAbsent& event) const;

  std::size_t next_sweep() const { return 0; }
  [[nodiscard]] MatchJob MakeJob(const SweepPtr& sweep) const;
  [[nodiscard]] std::optional<Transition> FinishJob(const MatchOutcome& outcome,
                                                    InsertTask& insert);

  TrackingStatus status() const { return health_.status(outage_.is_running()); }
  Timestamp begin() const { return history_.start_stamp(); }

 private:
  // Holds what is known of a scan as it comes back from matching.
  struct MatchedScan {
    const MatchOutcome& outcome;
    ImuNoise noise = {};         // at its end
    bool is_sought = false;      // its place is being looked for
    bool is_keyframe = false;    // the map may grow by it
    bool is_place_sure = false;  // all scans just before it were matched
    bool is_stale = false;       // it shows what the scan before did, but the body has moved

    [[nodiscard]] Timestamp middle() const { return outcome.sweep->middle(); }
    [[nodiscard]] Timestamp end() const { return outcome.sweep->end; }
    [[nodiscard]] bool starts_map() const { return outcome.match.status == MatchStatus::kEmptyMap; }
  };

  bool FeelsGravity() const { return !g_world_.isZero(); }
  HistoryOptions HistoryOptionsAt(Timestamp stamp) const;
  // The same for a history that takes the place of this one.
  HistoryOptions LearnedOptionsAt(Timestamp stamp) const;

  // Take a scan on its way, in this order.
  [[nodiscard]] MatchedScan Look(const MatchOutcome& outcome) const;
  // Takes one that shows something new, while the place is known or sought.
  [[nodiscard]] std::optional<Transition> TakeScan(const MatchedScan& scan, InsertTask& insert,
                                                   std::int64_t begin_ns);
  bool IsRigKnown() const;
  // Takes a last match into account that was beyond the gate.
  void GuessFromGated(MatchJob& job) const;
  void NoteIfGated(const MatchedScan& scan, const ScanReport& report);
  ScanReport FuseWithTrend(const MatchedScan& scan);
  ScanReport Fuse(const MatchedScan& scan);
  void Examine(const MatchOutcome& outcome) const;
  void RememberForHandover(const MatchedScan& scan, bool is_fused);
  void RememberFix(const MatchedScan& scan, bool is_fused);
  void GrowMap(const MatchedScan& scan, const ScanReport& report, bool rebases_map,
               InsertTask& insert);
  void UpdateBesides(const MatchedScan& scan, bool is_fused);
  void Publish(const MatchedScan& scan, ScanReport report, const Estimate& at_end,
               std::int64_t begin_ns);
  [[nodiscard]] std::optional<Transition> JudgeSelf(Timestamp sweep_end, bool restarts);
  // Matching from the prediction finds the scan, if it is there.
  bool IsPriorSure(Timestamp middle) const;
  // Nothing that is older than the sweeps that wait is asked for.
  void KeepHistoryForQueue();
  void PublishAtImuRate();
  ReportContext MakeReportContext() const;

  // Ways out of this mode.
  [[nodiscard]] Transition Restart(Trigger trigger, Timestamp stamp, const std::string& why) const;
  // The motion as it was known at that time, gravity included.
  [[nodiscard]] StartState KnownAt(Timestamp stamp) const;
  // Lidar-only odometry goes on in the same map from `known`, turning at that rate.
  [[nodiscard]] Transition GoLidarOnly(Trigger trigger, StartState known,
                                       const Vector3& w_imu_radps) const;

  // These are in tracking_imu.cpp.
  [[nodiscard]] bool has_followed() const { return followed_s_ >= kImuAgreement.min_followed_s; }
  [[nodiscard]] std::optional<ImuContradiction> CompareWithImu(const MatchedScan& scan);
  void CountFollowed(bool is_contradicted, const ImuAgreement::Belief& belief, Timestamp from,
                     Timestamp to);
  [[nodiscard]] std::optional<Transition> DoubtImu(const MatchedScan& scan);
  [[nodiscard]] Transition LeaveStuckImu(const StuckImuDetector::Stuck& stuck, Timestamp end) const;
  [[nodiscard]] Transition LeaveImu(const ImuContradiction& found, const MatchedScan& scan) const;
  [[nodiscard]] Transition GoOnWithoutImu(StartState known, const Vector3& w_imu_radps,
                                          const ImuContradiction& why, Timestamp end) const;

  // These are in tracking_repeats.cpp.
  // Has the body moved since the scan before, as far as the inertial samples know?
  bool HasMovedUntil(Timestamp middle) const;
  void PassOver(const MatchedScan& scan, std::int64_t begin_ns);

  // These are in tracking_extrinsic.cpp.
  void LookAtRig(Timestamp end);
  void CorrectExtrinsicBy(const Pose& T_old_new, Timestamp end);

  // These are in tracking_segment.cpp.
  void CarryOver(const Estimate& before, const SegmentJump& jump, const ImuSample& sample);
  void SeekAfterSetBack(Estimate before, const SegmentStarts& segment);
  std::optional<Pose> PoseIfClockSet(const Sweep& sweep, const Pose& T_map_imu_predicted) const;
  void SettleClockStep(const MatchOutcome& outcome);

  // These are in tracking_outage.cpp.
  void SeekAfterOutage(const Estimate& before, const SegmentStarts& segment,
                       const std::string& why);
  void SeekAfterSilence(Timestamp end);
  void TellLost(Timestamp end);
  void AddScanAfterOutage(const MatchOutcome& outcome, bool is_fused);
  void TakeVelocity(const MatchOutcome& outcome);
  void NotifyFound(Timestamp end);
  void LeaveMap(Timestamp stamp);
  void SetYawAside(Timestamp stamp);
  void BeginHistoryAt(const Estimate& estimate);
  void AddSamplesAfter(Timestamp stamp);

  // This is in tracking_place.cpp.
  void ForgetPoses(Timestamp stamp);

  ModeContext context_;
  Handover handover_;
  Vector3 g_world_;  // zero where no gravity is felt
  FilterHistory history_;
  Health health_;
  KeyframePolicy keyframes_;
  ZeroVelocityUpdater zero_velocity_;
  MotionTrend trend_;  // trend of the motion that the inertial samples miss
  OutageRecovery outage_;
  ImuAgreement imu_agreement_;
  std::optional<Timestamp> last_middle_;  // the scan before has it
  bool is_stale_told_ = false;
  double followed_s_ = 0.0;  // time of scans that showed a motion which the samples followed
  bool has_jumped_ = false;  // the poses did, and the samples had followed them before
  std::optional<GateDoubt> gate_doubt_;  // by the last match, where it was beyond the gate
  bool is_first_scan_;                   // the map is still empty
  bool is_map_rebased_ = false;          // and no scan has matched it yet
};

}  // namespace lio
