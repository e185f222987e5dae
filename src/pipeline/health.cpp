// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/health.hpp"

#include <bit>
#include <utility>

#include "lio/registration/registration_parameters.hpp"

namespace lio {

void Health::AddFusion(EventOutcome outcome) {
  gated_scans_ = gated_scans_ << 1 | (outcome == EventOutcome::kGated ? 1U : 0U);
  if (outcome == EventOutcome::kApplied) {
    num_gated_in_a_row_ = 0;
  } else if (outcome == EventOutcome::kGated) {
    ++counters_->num_gated;
    ++num_gated_in_a_row_;
  } else {
    ++counters_->num_scans_late;
  }
}

int Health::NumGatedLately() const {
  constexpr std::uint32_t kLastScans = (1u << kHealth.gated_lately_scans) - 1;
  return std::popcount(gated_scans_ & kLastScans);
}

Health::Verdict Health::AddScan(Timestamp sweep_end, const MatchResult& match, int num_points,
                                bool is_fused) {
  const bool is_located = is_fused || match.status == MatchStatus::kEmptyMap;
  const bool sees_enough = num_points >= kHealth.min_points;
  if (is_located) {
    num_unmatched_in_a_row_ = 0;
    last_fused_ = sweep_end;
  } else {
    ++counters_->num_matches_rejected;
    if (sees_enough) ++num_unmatched_in_a_row_;
  }
  Verdict verdict;
  verdict.rebases_map = has_imu_ && sees_enough &&
                        ((match.status == MatchStatus::kTooFewPoints &&
                          match.num_matched < MatchParameters::kMinMatched) ||
                         num_unmatched_in_a_row_ > kHealth.rebase_after_scans);
  verdict.restarts = num_unmatched_in_a_row_ >= (has_imu_ ? kHealth.restart_after_scans
                                                          : kHealth.restart_after_scans_lidar_only);
  const TrackingStatus status = Judge(sweep_end, match, is_located);
  verdict.is_newly_lost = status == TrackingStatus::kLost && status_ != TrackingStatus::kLost;
  status_ = status;
  return verdict;
}

bool Health::AddGap(Timestamp until) {
  const bool was_lost = std::exchange(status_, Judge(until, {}, false)) == TrackingStatus::kLost;
  return status_ == TrackingStatus::kLost && !was_lost;
}

TrackingStatus Health::Judge(Timestamp sweep_end, const MatchResult& match, bool is_located) const {
  if (is_located) {
    return match.degenerate_mask != 0 ? TrackingStatus::kDegenerate : TrackingStatus::kOk;
  }
  const bool is_lost =
      !last_fused_ || SecondsBetween(*last_fused_, sweep_end) >= kHealth.lost_after_s;
  return is_lost ? TrackingStatus::kLost : TrackingStatus::kCoasting;
}

}  // namespace lio
