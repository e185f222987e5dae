// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter over a window of time: every event (inertial sample, pose, standstill, rebase) with
// its posterior, ordered by stamp. An event that comes late is inserted at its own time and
// everything after it is replayed, so the result does not depend on the order of arrival.
//
// Outcomes are values. Equal stamps: inertial samples first, then poses, standstills, rebases.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lio/base/chi_square.hpp"
#include "lio/filter/pose_update.hpp"
#include "lio/filter/process_model.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

enum class EventOutcome {
  kApplied,
  kTooOld,       // before the window
  kBeforeStart,  // before the state the filter started from
  kDuplicate,    // an event of the kind is already there at this stamp
  kGated,        // too far off to be believed
};

// Factors on the covariance of poses.
struct Misfit {
  double translation = 1.0;
  double rotation = 1.0;
};

struct HistoryOptions {
  ProcessNoise noise;
  Vector3 g_world = Vector3(0, 0, -9.80665);
  double span_s = 3.0;
  double nis_limit = 22.46;  // 99.9 % of chi-square with 6 degrees of freedom
  double standstill_nis_limit = kChiSquare3At999;
  // How many times larger than claimed innovations may say that the covariance of poses is. One
  // where errors that last are not expected, or judged elsewhere.
  Misfit max_misfit{9.0, 9.0};  // a filter that is wrong must not shut its eyes
  // A longer step between samples is a gap: what the sensors did in between is unknown by these.
  double gap_s = 0.03;
  double gap_accel_std_mps2 = 3.0;
  double gap_gyro_std_radps = 0.5;
  // What is beyond a sensor's range is unknown by these, for clipped_s, when a scan tells.
  double clipped_s = 0.1;
  double clipped_accel_std_mps2 = 10.0;
  double clipped_gyro_std_radps = 2.0;
};

struct PoseEvent {
  PoseMeasurement measurement;
  bool force = false;  // fuse even beyond the gate, the covariance inflated to what was seen
  // No time has passed where stamps say so: the place is off by what the pose says, the speed not.
  bool is_clock_set = false;
};

class FilterHistory {
 public:
  // `sample` holds at start.stamp.
  FilterHistory(const HistoryOptions& options, const Estimate& start, const ImuSample& sample);

  EventOutcome AddImu(const ImuSample& sample);
  // `result`, when given, is filled under kApplied and kGated.
  EventOutcome AddPose(Timestamp stamp, const PoseEvent& event, UpdateResult* result = nullptr);
  // No velocity but for noise of `variance` an axis, (m/s)^2; gated like poses.
  EventOutcome AddZeroVelocity(Timestamp stamp, double variance);
  // From `stamp` on the map is a map of this very pose: the error of T_map_imu begins at zero.
  EventOutcome AddRebase(Timestamp stamp);

  // Events from `stamp` on, and what they need, are kept even beyond the window: a scan of that
  // time is still to come. Absent: none is.
  void KeepFrom(std::optional<Timestamp> stamp) { keep_from_ = stamp; }

  const Estimate& head() const { return nodes_.back().posterior; }
  Timestamp start_stamp() const { return start_stamp_; }
  // The estimate at `stamp`, after all events up to it. Before the window: the oldest one's.
  Estimate At(Timestamp stamp) const;
  // T_world_imu at every event strictly between the two stamps, and at both of them.
  StampedPoses Trajectory(Timestamp from, Timestamp to) const;
  // Measured ones, with stamps after `from` up to `to`.
  std::vector<ImuSample> SamplesBetween(Timestamp from, Timestamp to) const;

 private:
  enum class Kind { kImu, kPose, kStandstill, kRebase };
  struct Node {
    Timestamp stamp;
    Timestamp imu_stamp;  // of the last measured sample up to here
    Kind kind = Kind::kImu;
    ImuSample sample;  // measured, or interpolated at the stamp of another event
    PoseEvent pose;
    double standstill_var = 0.0;  // (m/s)^2
    UpdateResult update;
    Misfit misfit;  // after the event
    Estimate posterior;
  };

  std::optional<EventOutcome> Refuse(Timestamp stamp, Kind kind) const;
  std::size_t Insert(Node node);  // replays; returns where it is
  void Replay(std::size_t from);
  void Step(std::size_t at);
  void Fuse(Node& node) const;  // a pose
  void StepTo(Estimate& estimate, const ImuSample& from, const ImuSample& to, bool is_in_gap) const;
  // Is `stamp`, just before the node of index `at`, in a gap between measured samples?
  bool IsInGap(Timestamp stamp, std::size_t at) const;
  // The sample at `stamp` from the node before index `at` and the first measured one from it on.
  ImuSample SampleAt(Timestamp stamp, std::size_t at) const;
  std::size_t FirstAfter(Timestamp stamp) const;
  void Trim();

  HistoryOptions options_;
  Timestamp start_stamp_;
  std::optional<Timestamp> keep_from_;
  std::deque<Node> nodes_;  // never empty; the first one is where replays begin
};

}  // namespace lio
