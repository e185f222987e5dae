// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The one place that decides whether the estimator is tracking, coasting or lost, when the map is
// rebased to the predicted pose, and when the start begins anew; and that counts the scans that
// were not fused. It is told about each scan and returns an action.
//
//   matched                          kOk, or kDegenerate where a direction is not observable
//   not matched for less than 2 s    kCoasting
//   not matched for longer           kLost
//   after an outage of all sensors   kLost, until a scan is found and confirmed (outage.hpp)
//   place in a given map sought      kLost if it was known before, kInit otherwise
#pragma once

#include <cstdint>
#include <optional>

#include "lio/base/counters.hpp"
#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/outputs.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

// An early verdict costs a map, a late one a wrong pose said to be right.
struct HealthParameters {
  // s. The way is lost after so long without a match. Chosen: a car has gone 20 to 60 m, and the
  // IMU's guess is metres off.
  double lost_after_s = 2.0;
  // Scans in a row that see enough and match nowhere: then the map goes on from where the IMU says
  // ... Chosen: a second at 10 Hz; fewer give the map up for a bus alongside.
  int rebase_after_scans = 10;
  // ... and after this many the state is wrong by more than matching can correct. Chosen: the map
  // that was begun at the tenth has had 15 scans to match; used in docs/experiments/imu_gaps.md.
  int restart_after_scans = 25;
  // Without an IMU coasting is wrong by more with each scan. Chosen: half a second at 10 Hz; used
  // in docs/experiments/relocalization.md.
  int restart_after_scans_lidar_only = 5;
  // The gated ones are counted among so many last scans. Chosen: half a second at 10 Hz.
  int gated_lately_scans = 5;
  // A scan of fewer points says nothing about the map. Chosen: four times
  // MatchParameters::kMinMatched.
  int min_points = 200;
};

inline constexpr HealthParameters kHealth;

class Health {
 public:
  // `last_fused` is the end of the last fused sweep, if there is one.
  Health(bool has_imu, TrackingStatus status, std::optional<Timestamp> last_fused,
         Counters& counters)
      : has_imu_(has_imu), status_(status), last_fused_(last_fused), counters_(&counters) {}

  // Counts how the filter took the pose of a matched scan.
  void AddFusion(EventOutcome outcome);
  // So many poses in a row were beyond the gate that the next one is fused all the same.
  [[nodiscard]] bool MustForce(int max_gated_in_a_row) const {
    return num_gated_in_a_row_ >= max_gated_in_a_row;
  }

  struct Verdict {
    bool rebases_map = false;  // the map goes on from the predicted pose
    bool restarts = false;     // the start begins anew
    bool is_newly_lost = false;
  };
  [[nodiscard]] Verdict AddScan(Timestamp sweep_end, const MatchResult& match, int num_points,
                                bool is_fused);

  // No scan came up to `until`. True: newly lost.
  [[nodiscard]] bool AddGap(Timestamp until);

  // `recovers`: after an outage, no scan has confirmed the place yet.
  TrackingStatus status(bool recovers = false) const {
    return recovers ? TrackingStatus::kLost : status_;
  }
  // Returns the status while the place in a given map is sought.
  static TrackingStatus StatusWhileSeeking(bool was_known) {
    return was_known ? TrackingStatus::kLost : TrackingStatus::kInit;
  }
  std::optional<Timestamp> last_fused() const { return last_fused_; }
  int num_unmatched_in_a_row() const { return num_unmatched_in_a_row_; }
  // How many of the last kHealth.gated_lately_scans matched scans were beyond the gate?
  [[nodiscard]] int NumGatedLately() const;
  void ShiftTimesBy(Duration by) {
    if (last_fused_) *last_fused_ = *last_fused_ + by;
  }

 private:
  TrackingStatus Judge(Timestamp sweep_end, const MatchResult& match, bool is_located) const;

  bool has_imu_;
  TrackingStatus status_;
  std::optional<Timestamp> last_fused_;
  Counters* counters_;
  int num_gated_in_a_row_ = 0;
  int num_unmatched_in_a_row_ = 0;  // counts scans that see enough
  std::uint32_t gated_scans_ = 0;   // a bit a matched scan, the newest lowest
};

}  // namespace lio
