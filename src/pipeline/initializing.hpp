// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the mode before the first state is known. To build it is the reset: nothing of an earlier
// try is left but the handover.
//
// Does, over sweeps that it keeps and looks back on:
//   1. velocity seed: correlative alignment of the first sweeps' bird's-eye views (FindVelocity),
//   2. coarse track: the same sweeps are matched by a constant-velocity model, with the gyro's
//      rates where they are trusted; once the motion is clear, again from the first one on, with
//      the motion as a prior, since the first sweeps were skewed by a motion that was not known,
//   3. align: at rest from a second of inertial samples, in motion by least squares over the coarse
//      track and the samples (moving_start.hpp).
// Meanwhile ImuConventionMonitor judges units and axes. Without an IMU the motion of step 2 is all
// that is asked for.
//
// Ends with a transition: kStarted, kNoImu, kRetry, kSegmentStarts, kImuAppeared or
// kContradicted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/imu/moving_start.hpp"
#include "pipeline/mode_context.hpp"
#include "pipeline/transition.hpp"

namespace lio {

// A start that looks back longer begins later, and is surer.
struct InitializingParameters {
  // s. Shaken, but not moved for this long, counts as rest. Chosen: StartOptions::rest_s and four
  // sweeps; an idling truck shakes as much as a slow ride.
  double max_rest_wait_s = 1.4;
  // m/s^2. A body that is shaken by more does not stand, whatever the scans show: it walks between
  // hedges. Chosen: idling trucks and tractors stay below 1 m/s^2, walkers are beyond 2.
  double max_shaken_mps2 = 1.5;
  // s. An initialization looks back this far at most; the inertial buffer holds more. Chosen: the
  // longest StartOptions::moving_window_s and half a second.
  double max_window_s = 3.5;
  // A scan leaves a level direction open whose standard deviation is larger, and the way is unseen
  // where more than this share of scans does. Chosen: a degenerate direction within 45 deg of level
  // has 70 m (DegeneracyParameters::kDegenerateStd_m), one that a bird's-eye view holds 0.2 m;
  // half.
  double open_std_m = 70.0;
  double max_open_share = 0.5;
  // s. The gyro tells how far the body has turned since the last pose, back to this before a new
  // start. Chosen: a way is lost for half of it before a start begins anew. The buffer holds more
  // even while sweeps wait, so that latency does not show.
  double max_turn_back_s = 6.0;
  // A turn of which more is over before its first chunk comes, as where a log begins, is no scan to
  // begin a map with. Chosen: a scan of a third of the turn was matched by those that followed, one
  // of a sixth was not.
  double max_share_before = 0.5;
  std::size_t min_scans_at_rest = 3;  // chosen: two steps between them say that it does not move
  int min_samples_at_rest = 3;        // chosen: fewer have no spread
  // The motion may be known after the first number of scans; lidar-only odometry begins anyway
  // after the second. Chosen: the first ones are skewed by a motion that is not known; waiting
  // longer loses them.
  std::size_t min_scans_for_motion = 4;
  std::size_t max_scans_for_motion = 8;
  // The motion is known when it is surer than this. Chosen: it skews a sweep of 0.1 s by 10 cm.
  double motion_velocity_std_mps = 1.0;
  // The track starts from rest if no velocity is clear after so many scans. Measured against five:
  // docs/experiments/starts_in_motion.md.
  std::size_t max_scans_for_velocity = 8;
  // rad/s, 1 sigma. The bias of a gyro that was right before the way was lost may have jumped by
  // this. Chosen: 3 deg/s, beyond what shock or heat leave in one that still works.
  double jumped_gyro_bias_std_radps = 0.05;
  // m/s^2. The speed may have changed by this since views from above told it. Chosen: a car that
  // brakes hard.
  double max_accel_mps2 = 4.0;
  // s. Buildings that contradicted a track have to confirm one for so long. Chosen: a tenth of a
  // kilometre and more, over which traffic and houses change.
  double in_traffic_s = 20.0;
  std::ptrdiff_t num_steps_of_speed = 5;  // the track's speed is over these; chosen: half a second
  // m. A scan whose place in the map is less sure would blur the map. Chosen: a third of a cell.
  double max_insert_std_m = 0.3;
};

inline constexpr InitializingParameters kInitializing;

class Initializing {
 public:
  // `since` is the first sweep of an earlier try whose waiting time goes on.
  Initializing(const ModeContext& context, Handover handover,
               std::optional<Timestamp> since = std::nullopt);

  // Whether a map may begin with this sweep.
  static bool MayBeginWith(const Sweep& sweep) {
    return sweep.share_before <= kInitializing.max_share_before;
  }
  // Index into context.sweeps of the sweep to match next; those before are looked back on.
  std::size_t next_sweep() const { return scans_.size(); }
  [[nodiscard]] MatchJob MakeJob(const SweepPtr& sweep);
  // Takes the outcome of that job. `insert` gets the pose for the map where the scan grows it.
  [[nodiscard]] std::optional<Transition> FinishJob(const MatchOutcome& outcome,
                                                    InsertTask& insert);
  [[nodiscard]] Transition StartSegment(const SegmentStarts& segment);
  [[nodiscard]] Transition TakeImu(const ImuAppeared& event);
  // A track by the rates of a gyro is of no use without it.
  [[nodiscard]] std::optional<Transition> TakeImuAbsent() const;
  // No more sweeps come: without an IMU what is known of the motion must do.
  [[nodiscard]] std::optional<Transition> EndStream();
  void TakeClockStep(const AmbiguousClockStep& step);

  TrackingStatus status() const { return TrackingStatus::kInit; }

 private:
  // Samples come, and they are believed.
  bool HasImu() const { return context_.stream.has_imu() && !handover_.doubts_imu(); }
  struct Scan {
    MatchedPose pose;  // T_map_imu
    bool is_matched = false;
  };

  void BeginTrack(const Sweep& sweep);
  void FinishVelocitySearch(const MatchOutcome& outcome);
  void AddScan(const MatchOutcome& outcome, InsertTask& insert);
  bool IsMotionKnown(Timestamp sweep_end, const Estimate& estimate) const;
  bool IsLastScan() const;
  // How calm the IMU is tells how much the scans must show before the body counts as moved.
  enum class Calm {
    kStill,   // calmer than any ride
    kSways,   // it turns, as in a hand, but nothing pushes it
    kShaken,  // as on a ride
  };
  bool HasMovedSince(std::size_t first, Calm calm) const;
  Calm CalmOf(Timestamp stamp) const;
  void ForgetOldestScan();

  // These are in initializing_convention.cpp.
  bool IsInDoubt(Timestamp stamp) const;
  [[nodiscard]] std::optional<Transition> JudgeConvention(Timestamp stamp);
  // A force that is not accepted is waited for, unless it ends this mode.
  struct ForceCheck {
    bool is_accepted = false;
    std::optional<Transition> transition = {};
  };
  [[nodiscard]] ForceCheck CheckForceAtRest(const Vector3& mean_f_mps2, Timestamp stamp);
  [[nodiscard]] std::optional<Transition> CheckGravity(bool is_there, const std::string& evidence,
                                                       Timestamp stamp) const;
  [[nodiscard]] Transition SetConvention(const ImuConvention& found, const std::string& evidence,
                                         Timestamp stamp);
  void TurnHandover(const ImuConvention& found);
  [[nodiscard]] Transition Reject(Timestamp stamp, const std::string& why) const;

  // These are in initializing_start.cpp.
  [[nodiscard]] std::optional<Transition> TryStart(Timestamp stamp);
  [[nodiscard]] std::optional<Transition> TryStartAsItMoves(Timestamp stamp);
  [[nodiscard]] std::optional<Transition> TryStartAtRest(std::size_t first, Timestamp stamp);
  [[nodiscard]] std::optional<Transition> TryStartInMotion(Timestamp stamp);
  [[nodiscard]] bool IsWayUnseen() const;
  struct SpeedThen {
    Timestamp stamp;
    double mps = 0.0;
  };
  struct SpeedsThen {
    Timestamp stamp;
    std::optional<SpeedRange> speeds;
  };
  // Returns how fast the track was from that time on, or from its first scan on; nothing of fewer
  // than two scans.
  [[nodiscard]] std::optional<SpeedThen> SpeedOfTrackAt(Timestamp stamp) const;
  // Things that are higher than any vehicle show how fast the body was as the track began.
  enum class BuildingsSay {
    kNothing,    // nothing is so high, or it allows the track's speed and rest
    kItMoves,    // as fast as the track
    kOtherwise,  // at another speed than the track
  };
  [[nodiscard]] BuildingsSay WhatBuildingsSay() const;
  // May the track follow traffic that goes along, and is most of what is seen? It does where
  // buildings say otherwise; and it may where they did a while ago and do not confirm it, unless
  // the body is calm.
  [[nodiscard]] bool MayFollowTraffic(Timestamp stamp, bool is_calm);
  [[nodiscard]] Transition RetryWithNextSweep();
  [[nodiscard]] std::optional<Transition> AlignInMotion(Timestamp begin, Timestamp stamp);
  [[nodiscard]] MovingStart Align(Timestamp begin, Timestamp stamp, bool has_gravity) const;
  void TurnByGyro(const Estimate& now, LastFix& earlier, YawDoubt& doubt) const;
  [[nodiscard]] Transition StartFrom(StartState start, std::size_t first_sweep, bool is_at_rest);

  [[nodiscard]] Transition Retry() const;
  [[nodiscard]] Transition TryLidarOnly(Timestamp stamp);
  [[nodiscard]] Transition GoLidarOnly() const;

  ModeContext context_;
  Handover handover_;
  std::optional<Timestamp> since_;  // start of the first sweep that was tracked
  bool has_velocity_seed_ = false;  // the search for it is over
  SpeedsThen by_buildings_;         // as the first scans show them
  MotionSeed seed_;
  std::optional<ConstantVelocityTracker> tracker_;
  std::vector<Scan> scans_;            // one each of the front ones of context.sweeps
  Vector3 up_map_ = Vector3::UnitZ();  // roughly
};

}  // namespace lio
