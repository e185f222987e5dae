// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The mode without an IMU, or with one of which the gyro alone is believed: scans are tracked by
// the constant-velocity model. A path that is lost would go on straight, wherever that leads; so
// after a few scans that match nowhere a new map begins, in the world that was published.
#pragma once

#include <optional>

#include "lio/pipeline/keyframe_policy.hpp"
#include "pipeline/health.hpp"
#include "pipeline/mode_context.hpp"
#include "pipeline/motion_trend.hpp"
#include "pipeline/transition.hpp"

namespace lio {

struct LidarOnlyParameters {
  // So many scans go into a map unthinned. Chosen: with fewer it is thin, and its cells are
  // rank-deficient.
  int warm_up_scans = 10;
  // s. A body that is not seen goes on turning for so long. Chosen: after more the turn may have
  // ended, and the new map would be turned too far (docs/experiments/relocalization.md).
  double turn_unseen_for_s = 0.5;
  // s. An IMU that scans contradicted must follow them for so long, and twice as long after each
  // time that it was believed again. Chosen: longer than a turn or a start takes.
  double doubts_imu_for_s = 5.0;
  int max_doublings = 5;  // chosen: 160 s
};

inline constexpr LidarOnlyParameters kLidarOnly;

// Returns the estimate that this mode begins with after a transition that gives one, carried on to
// `stamp`.
[[nodiscard]] Estimate BeginWithoutImu(const Transition& transition, Timestamp stamp,
                                       const ModeContext& context);

class LidarOnly {
 public:
  // Begins with the first sweep, along the seed's motion; at the handover's last fix, if anything
  // was published or given before.
  // `inertial` is what the inertial filter knew, where this mode goes on in its world and its map.
  LidarOnly(const ModeContext& context, Handover handover, const MotionSeed& seed,
            std::optional<StartState> inertial = std::nullopt);

  std::size_t next_sweep() const { return 0; }
  [[nodiscard]] MatchJob MakeJob(const SweepPtr& sweep);
  [[nodiscard]] std::optional<Transition> FinishJob(const MatchOutcome& outcome,
                                                    InsertTask& insert);
  // The next scan that is found once gravity was felt goes back to the inertial filter, if the way
  // was not lost since it ended; else the start begins anew.
  [[nodiscard]] std::optional<Transition> TakeImu(const ImuAppeared& event);
  void TakeImuAbsent();
  // The inertial stream goes on elsewhere in time.
  void StartSegment(const SegmentStarts& segment);

  TrackingStatus status() const { return health_.status(); }

 private:
  void BeginTrack(const Sweep& sweep);
  void GoOn();
  // The track goes on from this estimate, with a gyro that tells this rate there, or without one.
  void TrackOn(Estimate estimate, const std::optional<Vector3>& rate_radps);
  // Takes the gyro's samples up to `end`.
  void AddRates(Timestamp end);
  // The gyro's rate, where it is believed and has told it.
  [[nodiscard]] std::optional<Vector3> RateAt(Timestamp stamp) const;
  // The gyro does not tell the turns any more.
  void LeaveGyro();
  void StartAtLastFix(Timestamp start, TrackerOptions& options) const;
  // A scan grows the map where its place is beyond doubt: in the first one that was located after
  // some that were not, it is not yet.
  bool IsPlaceSure(const MatchOutcome& outcome) const;
  // A fused scan tells how wrong its prediction was.
  void NoteError(const Pose& T_map_imu_predicted, const Pose& T_map_imu_fused, Timestamp middle);
  ScanReport Fuse(const MatchOutcome& outcome, bool is_keyframe);
  // The map begins with a scan of this instant.
  void BeginMap(Timestamp middle);
  void Remember(const Sweep& located);
  void Publish(const MatchOutcome& outcome, const ScanReport& report);
  [[nodiscard]] Transition RestartWhenLost(Timestamp sweep_end) const;
  // Compares an IMU that is in doubt with the scan.
  void CompareWithImu(const MatchOutcome& outcome, bool is_fused);
  // The accelerometer alone is in doubt.
  [[nodiscard]] bool BelievesGyro() const;
  // Has an IMU that was in doubt followed the scans for long enough?
  [[nodiscard]] bool FollowsAgain(Timestamp middle) const;
  [[nodiscard]] bool IsMisled(Timestamp sweep_end) const;
  [[nodiscard]] std::optional<Transition> TryReturn(const MatchOutcome& outcome,
                                                    bool is_sure) const;
  [[nodiscard]] Transition ReturnToImu(const MatchOutcome& outcome) const;
  [[nodiscard]] Transition ReturnInNewMap(const MatchOutcome& outcome) const;
  // Initialization begins anew, with an IMU.
  [[nodiscard]] Transition InitializeAgain() const;

  ModeContext context_;
  Handover handover_;
  MotionSeed seed_;
  Health health_;
  KeyframePolicy keyframes_;
  MotionTrend trend_;
  std::optional<ConstantVelocityTracker> tracker_;  // from the first sweep on
  Vector3 up_map_ = Vector3::UnitZ();               // roughly
  int num_scans_ = 0;                               // scans tracked so far
  std::optional<StartState> inertial_;  // state of the filter that this mode goes on from
  Vector3 g_world_ = Vector3::Zero();   // its gravity, which levelled the world
  std::optional<Timestamp> imu_back_since_;
  ImuAgreement imu_agreement_;
};

}  // namespace lio
