// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// An outage: for seconds nothing tells the motion. Stamps of all sensors went forward, and either
// nothing was received meanwhile (a suspended host, a switch) and the body moved unseen, or the
// clocks were set and it did not; or clocks were set back; or samples came and no scans; or the map
// was given up. The covariance holds all of it, and the estimator is lost until scans tell:
//
//   kSeek           the scan is sought near the old place and where the motion before leads to
//   kCheck          the scans after it must match as well as those before the outage did
//   kFindVelocity   found nowhere: the map is cleared, bird's-eye views give the velocity
//   kBeginMap       the next scan begins a new map, at the predicted pose
//   kConfirm        until a scan has matched it
#pragma once

#include <cstdint>
#include <optional>

#include "lio/filter/filter_parameters.hpp"
#include "lio/filter/nav_state.hpp"
#include "lio/pipeline/constant_velocity_tracker.hpp"
#include "lio/pipeline/match_job.hpp"
#include "pipeline/yaw_doubt.hpp"

namespace lio {

struct OutageParameters {
  // Who stood or crawled before may go on as fast as this. Chosen: a runner, a car that drives off.
  double min_speed_mps = 5.0;
  // A road climbs by at most this in its length. Chosen: but for a few streets none is steeper.
  double slope = 0.2;
  // Roll and pitch change by this, 1 sigma. Chosen: that slope, halved as it is seldom met.
  double tilt_std_rad = 0.1;
  // The turn rate is unknown by this while unseen, 1 sigma, as in a gap, ...
  double turn_rate_std_radps = kFilterParameters.imu_outage.gap_gyro_std_radps;
  // ... but a yaw that is anywhere has pi / sqrt(3). Statistics: a uniform distribution.
  double max_yaw_std_rad = 1.8138;
  // A yaw that is less sure than this stands beside the filter when the map is left. Chosen: below
  // it the second order of a turn is a twentieth of the first.
  double known_yaw_std_rad = 0.1;
  // Nothing is known of the velocity.
  double velocity_std_mps = kConstantVelocity.start_velocity_std_mps;
  // Beyond this standard deviation, numbers in double precision would leave too few digits for the
  // millimetres of the next match. Arithmetic: 1e8 m^2 beside 1e-6 m^2.
  double max_std_m = 1e4;
  // So many scans are sought before the map is given up. Chosen: with three for the velocity, less
  // than a second passes at 10 Hz.
  int max_scans_sought = 4;
  // The scan that is found is matched with large cells, which any ground and any wall fit. Those
  // after it must match as many points, and as many in the finest cells, as this share of the
  // number before the outage. Measured: 0.7 and more at the right place, 0.53 and 0.05 at most on a
  // motorway 138 m off (docs/experiments/outages.md).
  double min_share_matched = 0.6;
  int num_checks = 2;         // scans that must; chosen: one may match by chance
  int max_scans_checked = 4;  // among so many; chosen: half may be hidden by traffic
  // Found nearer to the old place than this, it stayed there. Chosen: less than any drive of 3 s.
  double stayed_m = 2.0;
  // Then the new map begins without a velocity. Chosen: as many as a start has
  // (InitializingParameters::max_scans_for_velocity).
  int max_scans_for_velocity = 8;
  double found_velocity_std_mps = kConstantVelocity.velocity_seed_std_mps;  // by bird's-eye views
};

inline constexpr OutageParameters kOutage;

// Returns how far a body may have turned in a time that nothing shows, 1 sigma per axis.
[[nodiscard]] double UnseenTurnStd_rad(double unseen_s);

// Returns the state at `now`, driven on as before, with a covariance that holds a body that
// stopped, that drove on or turned, and clocks that were set. Clocks that were set back tell as
// little of the time that passed as clocks that were set forward by as much.
[[nodiscard]] Estimate AcrossOutage(Estimate before, Timestamp now);

// Takes a yaw that is less sure than kOutage.known_yaw_std_rad out of an estimate that begins a new
// map, and adds it to the doubt. Returns false where the yaw is known, and changes nothing.
bool MoveUnsureYaw(Estimate& estimate, YawDoubt& doubt);

class OutageRecovery {
 public:
  enum class Stage : std::int8_t { kNone, kSeek, kCheck, kFindVelocity, kBeginMap, kConfirm };

  // Takes a scan that was fused while nothing is lost: what later ones are compared with.
  void NoteMatch(const MatchResult& match) { last_match_ = match; }
  // `before`: the estimate to which a place that turns out to be wrong falls back.
  // `T_map_imu_seen`: where the last scan was matched. No search is believed in a scene that did
  // not hold all directions: a new map begins at once.
  void Begin(const Estimate& before, const Pose& T_map_imu_seen);
  // No search is believed: a new map begins at once.
  void BeginNewMap(const Estimate& before);
  Stage stage() const { return stage_; }
  bool is_running() const { return stage_ != Stage::kNone; }
  // The present stage asks this of matching. `T_map_imu_if_set` is the pose if no time passed.
  void SetTask(const std::optional<Pose>& T_map_imu_if_set, MatchJob& job) const;

  enum class Event : std::int8_t {
    kNone,
    kConfirmed,     // the place that was found, by the scans after it
    kContradicted,  // by them: the place is given up, and the map with it
    kFoundNowhere,  // the map is given up
  };
  // A scan of the present stage was dealt with. `sees_enough`: it has points to be found by.
  [[nodiscard]] Event AddScan(const MatchOutcome& outcome, bool is_fused, bool sees_enough);

  const Estimate& before() const { return before_; }
  // The clock was set: what is remembered is as long ago by the new one.
  void ShiftTimesBy(Duration by) { before_.stamp = before_.stamp + by; }
  // Returns the distance of the scan that was found from the last one that was matched before.
  double moved_m() const { return moved_m_; }

 private:
  void Enter(Stage stage);
  Event AddSought(const MatchOutcome& outcome, bool is_fused);
  Event AddChecked(const MatchOutcome& outcome, bool is_fused);
  bool MatchesAsBefore(const MatchResult& match) const;

  Stage stage_ = Stage::kNone;
  int num_scans_ = 0;  // since the stage began
  int num_checked_ = 0;
  MatchResult last_match_;
  Estimate before_;
  Pose T_map_imu_seen_;
  double moved_m_ = 0.0;
};

}  // namespace lio
