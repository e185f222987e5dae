// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The steps of one job share this, and deskew its scan so.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/pipeline/registration_worker.hpp"
#include "lio/registration/match_budget.hpp"
#include "lio/relocalization/parameters.hpp"
#include "lio/scan/deskew.hpp"
#include "pipeline/prior_error.hpp"

namespace lio {

template <class T>
std::vector<T> Pick(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  std::vector<T> picked;
  if (values.empty()) return picked;
  picked.reserve(indices.size());
  for (const std::uint32_t i : indices) picked.push_back(values[i]);
  return picked;
}

inline SweepTimes TimesOf(const Sweep& sweep) {
  return {sweep.start, sweep.end, sweep.middle()};
}

// When the picked points were seen.
inline std::vector<float> TimesFromMidSweep(const SweepTimes& times, const ReducedScan& reduced) {
  const auto start_s = static_cast<float>(SecondsBetween(times.reference, times.start));
  std::vector<float> from_mid_sweep_s;
  from_mid_sweep_s.reserve(reduced.to_match.size());
  for (const std::uint32_t i : reduced.to_match) {
    from_mid_sweep_s.push_back(start_s + 1e-9f * static_cast<float>(reduced.points[i].t_offset_ns));
  }
  return from_mid_sweep_s;
}

// Returns the trajectory over the sweep, bent so that its middle is where the scan was found.
inline StampedPoses BentTo(const Pose& found, const MatchJob& job) {
  return Bent(job, LogSe3(job.prior.T_map_imu.Inverse() * found));
}

// Has the body moved unseen, so that the scan may be anywhere?
inline bool IsUnseen(const MatchJob& job) {
  const auto* task = std::get_if<Relocalize>(&job.task);
  return task != nullptr && task->search.region == SearchRegion::kObservable;
}

inline int MaxMatches(const MatchJob& job) {
  return IsUnseen(job) ? kRelocalization.max_matches_unseen : kRelocalization.max_matches_per_scan;
}

struct RegistrationWorker::ScanInWork {
  const MatchJob& job;
  Pose T_imu_lidar;
  BeamCalibration* calibration;
  ReducedScan reduced = {};
  StampedPoses motion;  // the trajectory that the points are deskewed by
  MatchOutcome outcome = {};
  std::vector<Eigen::Vector3f> to_match = {};  // chosen from outcome.points_imu
  std::vector<FeatureTag> tags_to_match = {};
  std::vector<ScanPoint> beams_to_match = {};
  MatchBudget budget = MatchBudget(MaxMatches(job));

  MatchInput InputFrom(const Pose& T_map_imu_guess, const Matrix6& cov) const {
    return {.points_imu = to_match,
            .T_map_imu_guess = T_map_imu_guess,
            .guess_cov = cov,
            .is_far_off = job.refines_deskew,
            .tags = tags_to_match,
            .scan_points_imu = outcome.points_imu,
            .shift_std_m = job.prior.shift_std_m,
            .from_mid_sweep_s = {},
            .T_imu_lidar = T_imu_lidar,
            .calibration = calibration,
            .beam_points = beams_to_match};
  }
};

}  // namespace lio
