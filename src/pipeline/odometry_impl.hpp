// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The state machine behind Odometry, in nine files: odometry.cpp takes data in,
// odometry_stretch.cpp across gaps and steps of the clock, odometry_start.cpp finds the first
// state, odometry_reading.cpp what the inertial messages mean, odometry_scan.cpp matches and fuses,
// odometry_lidar_only.cpp goes without an IMU, odometry_standstill.cpp and odometry_clock.cpp look
// for rest and for the clocks' offset, odometry_output.cpp tells the state.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lio/filter/clock_offset.hpp"
#include "lio/filter/filter_history.hpp"
#include "lio/filter/published_estimate.hpp"
#include "lio/imu/imu_classifier.hpp"
#include "lio/imu/moving_start.hpp"
#include "lio/imu/start_state.hpp"
#include "lio/pipeline/constant_velocity_tracker.hpp"
#include "lio/pipeline/keyframe_policy.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "lio/pipeline/zero_velocity_detector.hpp"
#include "lio/sensor/sample_lookup.hpp"
#include "lio/stream/clock_step_arbiter.hpp"
#include "lio/stream/imu_preprocessor.hpp"
#include "lio/stream/saturation_detector.hpp"
#include "lio/stream/scan_assembler.hpp"
#include "lio/stream/scan_gate.hpp"

namespace lio {

class Odometry::Impl {
 public:
  Impl(const Options& options, ClockNs clock);

  void AddImu(const ImuSample& sample);
  void AddRawChunk(ScanChunk chunk, std::int64_t decode_ns);  // by the lidar's clock
  void AddChunk(ScanChunk chunk, std::int64_t decode_ns);     // by the IMU's
  void Flush();
  std::optional<MatchJob> NextJob();
  InsertTask FinishJob(MatchOutcome outcome);
  void ShedLoad();
  std::vector<Output> TakeOutputs() { return std::exchange(outputs_, {}); }

  const Counters& counters() const { return counters_; }
  TrackingStatus status() const { return status_; }

 private:
  // kScouting: sweeps are matched by a constant-velocity model until the first second says whether
  // the vehicle rests or moves. kRunning: the filter runs.
  enum class Phase { kScouting, kRunning };

  // --- odometry.cpp: intake
  void Accept(const ImuSample& sent);
  bool Keep(const ImuSample& sent);
  ImuSample Marked(ImuSample sent);
  void BridgeTo(Timestamp stamp);
  void AddHeld(Timestamp stamp);
  bool HasWork() const;
  void OpenGate();
  void Admit(SweepPtr sweep);
  bool TellIfClocksApart(Timestamp imu, Timestamp lidar);
  void GoLidarOnly(const std::string& why);
  std::optional<Timestamp> NewestImu() const;
  // How far a scan may still be moved in time before it is matched.
  Duration ClockMargin() const {
    return Duration::FromSeconds(clock_offset_ ? ClockOffset::kMax_s : 0.0);
  }
  HistoryOptions MakeHistoryOptions() const;
  void Say(Timestamp stamp, Notice::Severity severity, std::string text);
  std::int64_t Now() const { return clock_ == nullptr ? 0 : clock_(); }

  // --- odometry_stretch.cpp
  bool IsBetweenStretches() const { return !new_stretch_.accepted.empty(); }
  void TakeStep(ImuPreprocessor::Result result);
  ClockStep ClockStepNow() const;
  void HoldSample(const ImuSample& sample);
  void HoldChunk(ScanChunk chunk, std::int64_t decode_ns);
  void GoOnShifted(Timestamp after_by_lidar);
  void GoOn();
  void EndStretch();
  void ResumeAfterStretch();
  void GoOnWith(const std::vector<ImuSample>& samples);
  void BeginNewStretch(const ImuSample& first, ImuPreprocessor::Step step);
  void SetTimesBy(Duration by);
  bool IsAfterStepInDoubt(const Sweep& sweep) const;
  std::optional<Pose> GuessIfClockSet(const Sweep& sweep, const Pose& T_map_imu_predicted);
  void SettleStepInDoubt(const MatchOutcome& outcome);

  // --- odometry_start.cpp
  void FinishScouting(const MatchOutcome& outcome, InsertTask& insert);
  void BeginScouting(const Sweep& sweep);
  void BeginScoutingAnew();
  void FinishSeeking(const MatchOutcome& outcome);
  bool IsLastScouted() const { return is_flushed_ && scouted_.size() == ready_.size(); }
  Vector3 UpInMap(const NavState& state) const;  // about
  void AdvanceScout(Timestamp stamp);
  void TryStart(Timestamp stamp);
  void TryStartAsItMoves(Timestamp stamp);
  void ForgetOldestScouted();
  void TryStartAtRest(Timestamp begin, Timestamp stamp);
  void TryStartInMotion(Timestamp stamp);
  bool HasMovedSince(std::size_t first, bool is_calm) const;
  bool IsVeryCalm(Timestamp stamp) const;
  void SayWaiting(Timestamp stamp, const std::string& text);
  void ScoutAgain(Timestamp stamp, const std::string& why);
  void StartAnew(Timestamp stamp, const std::string& why);
  void StartAnewWhenLost(Timestamp stamp);
  LastFix MakeFix(Timestamp stamp, const Estimate& estimate) const;
  void TurnResumption(const ImuConvention& found);
  void TurnByGyro(const Estimate& now, LastFix& earlier) const;
  void StartFrom(StartState start, std::size_t first_sweep);
  std::vector<ImuSample> SamplesBetween(Timestamp from, Timestamp to) const;

  // --- odometry_reading.cpp
  std::optional<ImuSample> Read(const ImuSample& sent);
  void ClassifyAnew();
  void TellClassifier(const StampedPose& T_map_imu);
  bool JudgeWhileScouting(Timestamp stamp);
  void JudgeWhileRunning(Timestamp stamp);
  bool IsGyroMisleading(const ImuVerdict& verdict) const;
  bool IsGyroWild(Timestamp stamp) const;
  bool IsDoubtful() const;
  bool IsInDoubt(Timestamp stamp) const;
  void ScoutWithoutGyro();
  bool MayBeDegrees(std::span<const ImuSample> samples) const;
  bool AcceptRatesAtRest(std::span<const ImuSample> samples, Timestamp stamp);
  bool AcceptForceAtRest(const Vector3& mean_f_mps2, Timestamp stamp);
  std::optional<bool> GravityInMotion(const Vector3& mean_f_mps2) const;
  bool AcceptGravity(bool is_there, const std::string& evidence, Timestamp stamp);
  void Adopt(const ImuConvention& found, const std::string& evidence, Timestamp stamp);
  void ReadAnewAs(const ImuConvention& found);
  void Refuse(Timestamp stamp, const std::string& why);

  // --- odometry_scan.cpp
  FilterHistory& history() { return scout_ ? scout_->history() : *history_; }
  MatchJob MakeJob(const SweepPtr& sweep, bool clear_map);
  std::optional<SearchRequest> MakeSearch(const Sweep& sweep, const Pose& T_map_imu_predicted);
  InsertTask TakeOutcome(MatchOutcome outcome);
  void FinishRunning(MatchOutcome& outcome, InsertTask& insert);
  Matrix6 DeskewCov(const Sweep& sweep);
  bool Fuse(const MatchOutcome& outcome, bool grows_map, ScanReport& report);
  void UpdateStatus(const MatchOutcome& outcome, bool fused);

  // --- odometry_lidar_only.cpp
  void RunLidarOnly();
  bool IsMapYoung() const;
  bool IsPlaceSure(const MatchOutcome& outcome) const;
  void StartAnewByLidar(Timestamp stamp);
  void GoOnFromLoss(Timestamp stamp, TrackerOptions& scouting);
  void TakeLateImu(const ImuSample& sample);
  void GoInertial(Timestamp first);

  // --- odometry_standstill.cpp
  void FuseStandstill(const MatchOutcome& outcome, bool is_fused);

  // --- odometry_clock.cpp
  // The sweep, its stamps moved by the offset between the clocks as known now.
  SweepPtr MovedByClockOffset(const SweepPtr& sweep);
  void FollowClockOffset(const MatchOutcome& outcome);

  // --- odometry_output.cpp
  FilterReport MakeFilterReport(const Estimate& estimate, const ScanReport& report) const;
  WorldEstimate InPublishedWorld(const Estimate& estimate) const;
  NavOutput MakeNav(const Estimate& estimate) const;
  double RateVariance(Timestamp stamp) const;
  void EmitImuRate();

  Options options_;
  ClockNs clock_;
  Counters counters_;
  std::vector<Output> outputs_;
  TrackingStatus status_ = TrackingStatus::kInit;
  double nis_limit_ = 0.0;

  bool use_imu_;
  ImuConvention reading_;  // of all samples that come
  ImuClassifier classifier_;
  bool is_reading_settled_ = false;  // beyond doubt
  bool is_force_unit_told_ = false;  // by gravity, at rest
  bool is_refused_ = false;          // the configuration contradicts the data
  std::optional<bool> has_gravity_in_motion_;
  Timestamp classified_until_;
  int num_poses_to_judge_ = 0;
  std::uint32_t gated_scans_ = 0;  // a bit a matched scan, the newest lowest
  bool has_doubted_ = false;       // the start was begun anew with this reading
  ImuPreprocessor intake_;
  SaturationDetector clip_watch_;
  std::deque<ImuSample> sent_;  // accepted, as they came, by stamp, of the last seconds
  std::deque<ImuSample> imu_;   // the same as they are read, but what no gyro can turn
  std::optional<ImuSample> mean_before_hole_;  // as sent; while the stream has one
  std::optional<Timestamp> cut_;  // samples up to here come too late: a scan has used them
  ImuPreprocessor::Result
      new_stretch_;  // after a step, until it is judged and all before it is matched
  bool is_step_judged_ = true;
  Timestamp newest_held_;  // of the inertial stream since the step
  // Stamps of all sensors went forth: did time pass, or was the clock set?
  struct StepInDoubt {
    ClockStep stamps;
    std::optional<Pose> T_map_before;  // absent: the history still has it
  };
  std::optional<StepInDoubt> step_in_doubt_;
  int feed_depth_ = 0;
  Duration imu_clock_shift_;  // of a clock that stepped alone
  Timestamp newest_chunk_;
  ClockStepArbiter arrivals_;
  struct HeldMessage {
    ImuSample sample;
    std::optional<ScanChunk> chunk;  // absent: it is the sample
    std::int64_t decode_ns = 0;
  };
  std::deque<HeldMessage> held_;     // what came since new_stretch_ did
  std::vector<ImuSample> late_imu_;  // the first ones, where the lidar has begun alone
  bool is_flushed_ = false;
  ScanAssembler assembler_{counters_};
  ScanGate gate_{counters_};
  std::deque<SweepPtr> ready_;  // covered by inertial data, not yet done with

  Phase phase_ = Phase::kScouting;
  std::optional<ConstantVelocityTracker> scout_;  // while scouting, or for good without an IMU
  struct Scouted {
    MatchedPose pose;  // T_map_imu
    bool is_matched = false;
  };
  std::vector<Scouted> scouted_;  // one a sweep of ready_
  bool has_sought_ = false;       // the first scans' velocity, over a wide range
  std::optional<Vector3> sought_v_imu_mps_;
  std::optional<NavState> glance_;  // the motion that the first scans showed
  bool scouts_with_gyro_ = true;
  Vector3 scout_up_map_ = Vector3::UnitZ();  // about
  struct Resumption {
    Pose T_world_start, T_map_start;  // in the axes that were believed
    LastFix last_fix;
    bool is_by_lidar = false;  // alone: in a world that was not level
  };
  std::optional<Resumption> resumption_;  // a start made anew goes on from here
  struct Loss {                           // of the way, lidar-only
    LastFix last_fix;
    Vector3 w_imu_radps = Vector3::Zero();
    Matrix6 pose_cov = Matrix6::Zero();  // when the map was given up
  };
  std::optional<Loss> loss_;  // a map begun anew goes on from here
  int num_scans_in_map_ = 0;  // lidar-only: run since its beginning
  Pose T_world_start_, T_map_start_;
  bool is_map_by_lidar_ = false;  // it began lidar-only: no reading of the inertial axes is in it
  LastFix last_fix_;              // as published
  std::optional<Timestamp> scouting_since_;
  Timestamp last_wait_notice_;
  std::optional<FilterHistory> history_;  // while running with an IMU
  Vector3 g_world_ = Vector3::Zero();

  std::optional<ClockOffset> clock_offset_;
  double moved_by_s_ = 0.0;  // the stamps of the sweep in flight
  bool has_told_clock_offset_ = false;
  ZeroVelocityDetector standstill_;
  std::optional<Timestamp> last_standstill_;  // middle of the last sweep that was taken at rest
  KeyframePolicy keyframes_;
  SweepPtr in_flight_;          // the sweep whose job is out
  bool is_first_scan_ = true;   // of the running phase
  std::int64_t last_seq_ = -1;  // the last scan that was fused
  int num_gated_in_a_row_ = 0;
  int num_unmatched_in_a_row_ = 0;       // of scans that see enough
  std::optional<Timestamp> last_fused_;  // end of the last sweep that was fused
  std::optional<Timestamp> last_found_;  // middle of the last sweep whose pose was found
  std::optional<Timestamp> last_published_;
  std::int64_t filter_ns_ = 0;  // CPU time of the filter since the last job
};

}  // namespace lio
