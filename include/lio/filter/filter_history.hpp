// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the error-state filter over a sliding window of time: it keeps every event (inertial sample,
// pose, zero velocity, velocity, rebase, noise) with the estimate after it, ordered by stamp.
//
// An event that comes late is inserted at its own stamp and all later events are replayed, so the
// result does not depend on the order of arrival. Events of equal stamp are ordered by kind:
// inertial samples, poses, zero velocities, velocities, rebases, noises. Frames, units and error
// conventions: nav_state.hpp. Equations: docs/filter.md; Sola, arXiv 1711.02508. Failures are
// values of EventOutcome; nothing throws. Cost: one event at the end is one propagation step; a
// late event replays those after it.
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "lio/base/chi_square.hpp"
#include "lio/filter/filter_parameters.hpp"
#include "lio/filter/pose_event.hpp"
#include "lio/filter/process_model.hpp"
#include "lio/filter/rate_error.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

enum class EventOutcome {
  kApplied,
  kTooOld,       // the stamp is before the window
  kBeforeStart,  // the stamp is before the state the filter started from
  kDuplicate,    // an event of this kind has the same stamp
  kGated,        // the innovation is beyond the gate: the estimate is unchanged
};

// Holds settings of one history; the defaults of `max_inflation` and `imu_outage` are those of
// filter_parameters.hpp.
struct HistoryOptions {
  ProcessNoise noise;
  // m/s^2; zero when the samples hold no gravity. Standard gravity (CGPM 1901).
  Vector3 g_world = Vector3(0, 0, -9.80665);
  double span_s = 3.0;       // length of the window, s; as FilterOptions::history_s
  double nis_limit = 22.46;  // gate of poses: 99.9 % of chi-square with 6 degrees of freedom
  double zero_velocity_nis_limit = kChiSquare3At999;  // their gate: the same of 3; customary
  // Inflation is bounded by these, as InflationParameters says. A bound of one switches it off: for
  // poses whose errors are white, or whose consistency is checked elsewhere.
  CovarianceInflation max_inflation{kFilterParameters.inflation.max_factor,
                                    kFilterParameters.inflation.max_factor};
  ImuOutageParameters imu_outage = kFilterParameters.imu_outage;
  RateError rate_error = {};  // as an earlier history of the same gyro found it
};

class FilterHistory {
 public:
  // `sample` is the inertial sample that holds at start.stamp.
  FilterHistory(const HistoryOptions& options, const Estimate& start, const ImuSample& sample);

  [[nodiscard]] EventOutcome AddImu(const ImuSample& sample);
  // `result`, when given, is filled under kApplied and kGated. `share_of_last_scan`
  // (Observability): the match tells it of the last scan before that was fused and grew the map. It
  // counts once for each such scan; of one that has left the window, or from before the map began
  // anew, it changes nothing.
  [[nodiscard]] EventOutcome AddPose(
      Timestamp stamp, const PoseEvent& event, UpdateResult* result = nullptr,
      const std::optional<Matrix6>& share_of_last_scan = std::nullopt);
  // Zero-velocity update: v_world_imu is zero with `variance` per axis, (m/s)^2. It is gated like
  // poses.
  [[nodiscard]] EventOutcome AddZeroVelocity(Timestamp stamp, double variance);
  // Forgets the velocity for one that is known in imu, with `variance` per axis, (m/s)^2.
  [[nodiscard]] EventOutcome AddVelocity(Timestamp stamp, const Vector3& v_imu_mps,
                                         double variance);
  // The map is begun anew at the pose of `stamp`: the error of T_map_imu is zero there.
  [[nodiscard]] EventOutcome AddRebase(Timestamp stamp);
  // From `stamp` on the sensor shows this noise.
  [[nodiscard]] EventOutcome AddNoise(Timestamp stamp, const ImuNoise& noise);

  // Keeps events from `stamp` on, and the one before them, even when they leave the window, because
  // a scan of that time is still to come. Without a value only the window is kept.
  void KeepFrom(std::optional<Timestamp> stamp) { keep_from_ = stamp; }

  // The turn acceleration of a body whose gyro bias stands for its rate; for all that is propagated
  // from now on, replays included.
  void SetBiasWalk(double gyro_bias_walk_density) {
    options_.noise.gyro_bias_walk_density = gyro_bias_walk_density;
  }

  const Estimate& head() const { return nodes_.back().posterior; }
  Timestamp start_stamp() const { return start_stamp_; }
  // Returns the estimate at `stamp` after all events up to it; before the window the oldest
  // estimate.
  Estimate At(Timestamp stamp) const;
  // Returns T_world_imu at both stamps and at every event strictly between them.
  StampedPoses Trajectory(Timestamp from, Timestamp to) const;
  // Returns the standard deviation per axis of the gyro's error in proportion to its rate at
  // `stamp`, rad/s.
  double RateErrorStd(Timestamp stamp) const;
  // Returns it as the drive has shown it so far, for another history.
  [[nodiscard]] RateError rate_error() const { return nodes_.back().rate_error.Anew(); }
  // Returns the measured samples with stamps after `from` up to `to`.
  std::vector<ImuSample> SamplesBetween(Timestamp from, Timestamp to) const;

 private:
  enum class Kind { kImu, kPose, kZeroVelocity, kVelocity, kRebase, kNoise };
  struct Node {
    Timestamp stamp;
    Timestamp imu_stamp;  // the last measured sample up to here
    Kind kind = Kind::kImu;
    ImuSample sample;  // measured, or interpolated at the stamp of another event
    PoseEvent pose;
    double velocity_var = 0.0;  // (m/s)^2; of both kinds of velocities
    Vector3 v_imu_mps = Vector3::Zero();
    UpdateResult update;
    ImuNoise new_noise;             // kNoise only
    ImuNoise noise;                 // shown after the event
    CovarianceInflation inflation;  // after the event
    RateError rate_error;           // after the event
    double in_gap_s = 0.0;          // time without samples since a pose was fused, if within a gap
    Estimate posterior;
  };

  std::optional<EventOutcome> Refuse(Timestamp stamp, Kind kind) const;
  // Inserts the node and replays from there, or from `from` where that is earlier; returns the
  // node's index.
  std::size_t Insert(Node node, std::size_t from = std::numeric_limits<std::size_t>::max());
  // Returns the index of the last scan before `stamp` that was fused and grew the map; nothing
  // where the map has begun anew since.
  std::optional<std::size_t> LastGrowingScan(Timestamp stamp) const;
  void Replay(std::size_t from);
  void Step(std::size_t at);
  static void FuseIn(Node& node, const HistoryOptions& options);
  // `before` is the node that the step begins at. `in_gap_s` is that of the node that it ends at;
  // zero outside of gaps.
  void StepTo(Estimate& estimate, const Node& before, const ImuSample& to, double in_gap_s) const;
  // True when `stamp`, just before the node of index `at`, is in a gap between measured samples.
  bool IsInGap(Timestamp stamp, std::size_t at) const;
  // Gives Node::in_gap_s at `stamp`, just before the node of index `at`.
  double InGap_s(Timestamp stamp, std::size_t at) const;
  // Returns the sample at `stamp`, interpolated between the node before index `at` and the first
  // measured sample from `at` on.
  ImuSample SampleAt(Timestamp stamp, std::size_t at) const;
  std::size_t FirstAfter(Timestamp stamp) const;
  void Trim();

  HistoryOptions options_;
  Timestamp start_stamp_;
  std::optional<Timestamp> keep_from_;
  std::deque<Node> nodes_;  // never empty; replays begin at the first one
};

}  // namespace lio
