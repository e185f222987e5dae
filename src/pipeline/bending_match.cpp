// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A scan whose motion nobody has measured, or somebody wrongly, bends along with the pose that is
// found.
#include <algorithm>
#include <cmath>
#include <optional>

#include "lio/relocalization/candidate.hpp"
#include "pipeline/health.hpp"
#include "pipeline/scan_in_work.hpp"

namespace lio {
namespace {

// Tunes the search for the turn that nobody has measured.
struct TurnSearchParameters {
  double step_rad = 0.05;     // chosen: matching converges over 1 m, at 20 m
  double range_sigmas = 3.0;  // searched, of the prior's; statistics: 99.7 %
  double max_turn_rad = 0.6;  // ... at most; chosen by cost: 25 coarse matches
  // A scan that is bent has so many times the support of one that is not, where the motion was
  // measured wrongly. Measured on sound drives: 1.003 at most where they contradict each other
  // (docs/experiments/dead_imu.md).
  double min_support_ratio = 1.03;
};
constexpr TurnSearchParameters kTurnSearch;

// Is it likely that the measured motion has laid the scan where little of the map is?
bool MayBeMeasuredWrongly(const MatchResult& match, const MatchJob& job, std::size_t num_points) {
  const bool is_near = !IsUnseen(job) && job.map_action == MapAction::kKeep &&
                       match.status != MatchStatus::kEmptyMap;
  const bool lies_badly = match.support_at_guess ? !match.HasSlid() : !match.IsUsable();
  return job.doubts_gyro && is_near && lies_badly &&
         num_points >= static_cast<std::size_t>(kHealth.min_points);
}

MotionPrior WithUnknownTurn(MotionPrior prior) {
  constexpr double kStd_rad = kTurnSearch.max_turn_rad / kTurnSearch.range_sigmas;
  prior.cov.bottomRightCorner<3, 3>() += kStd_rad * kStd_rad * Matrix3::Identity();
  return prior;
}

std::vector<float> SharesOfPriorError(const std::vector<float>& from_mid_sweep_s,
                                      const MatchJob& job) {
  std::vector<float> shares;
  shares.reserve(from_mid_sweep_s.size());
  for (const float at_s : from_mid_sweep_s) {
    shares.push_back(static_cast<float>(ShareOfPriorError(static_cast<double>(at_s), job)));
  }
  return shares;
}

// Returns the prior turned about the vertical, by steps up to as far as it may be off.
std::vector<Pose> Turned(const MotionPrior& prior) {
  const Vector3 up_imu = prior.T_map_imu.rotation.conjugate() * prior.up_map;
  const double std_rad = std::sqrt(up_imu.dot(prior.cov.bottomRightCorner<3, 3>() * up_imu));
  const double most_rad = std::min(kTurnSearch.range_sigmas * std_rad, kTurnSearch.max_turn_rad);
  const int num_steps = static_cast<int>(std::ceil(most_rad / kTurnSearch.step_rad));
  std::vector<Pose> turned;
  for (int i = -num_steps; i <= num_steps; ++i) {
    const Quaternion turn = ExpSo3(kTurnSearch.step_rad * i * up_imu);
    turned.push_back({prior.T_map_imu.rotation * turn, prior.T_map_imu.translation});
  }
  return turned;
}

}  // namespace

// A gyro that has just broken lays the scan where few points match. Then it is matched once more as
// if nobody had measured how it turned. A scan in doubt teaches the calibration nothing.
MatchResult RegistrationWorker::MatchAsMeasured(const MotionPrior& prior, ScanInWork& scan) {
  const MatchResult match = MatchFully(scan.InputFrom(prior.T_map_imu, prior.cov), scan);
  if (!MayBeMeasuredWrongly(match, scan.job, scan.to_match.size())) return match;
  const MatchResult bent = MatchBending(WithUnknownTurn(prior), scan);
  calibration_.ForgetScan();
  if (bent.IsUsable() && SupportOf(bent) > kTurnSearch.min_support_ratio * SupportOf(match)) {
    return bent;
  }
  scan.motion = scan.job.T_any_imu;
  DeskewAgain(scan);
  return match;
}

// The motion within the sweep is a guess as the prior is, so the scan stays as it was bent where it
// was found. A body that begins or ends a quick turn is far from the prior by its direction alone.
MatchResult RegistrationWorker::MatchBending(const MotionPrior& prior, ScanInWork& scan) {
  MatchResult match = MatchBentFrom(prior.T_map_imu, prior.cov, scan);
  if (relocalizer_.MayBeElsewhere(match)) {
    if (const auto turned = BestTurn(prior, scan)) {
      BendTo(*turned, scan);
      calibration_.ForgetScan();
      const MatchResult other = MatchBentFrom(*turned, CandidateCov(), scan);
      if (SupportOf(other) > SupportOf(match)) match = other;
    }
  }
  BendTo(match.T_map_imu, scan);
  return match;
}

void RegistrationWorker::BendTo(const Pose& T_map_imu, ScanInWork& scan) const {
  scan.motion = BentTo(T_map_imu, scan.job);
  DeskewAgain(scan);
}

// The scan is deskewed along the motion that leads to the guess.
MatchResult RegistrationWorker::MatchBentFrom(const Pose& T_map_imu_guess, const Matrix6& cov,
                                              ScanInWork& scan) {
  const std::vector<float> shares =
      SharesOfPriorError(TimesFromMidSweep(TimesOf(*scan.job.sweep), scan.reduced), scan.job);
  MatchInput input = scan.InputFrom(T_map_imu_guess, cov);
  input.shares_of_correction = shares;
  return MatchFully(input, scan);
}

// Few of the scan's points tell which of the turns it is.
std::optional<Pose> RegistrationWorker::BestTurn(const MotionPrior& prior, ScanInWork& scan) {
  const SweepTimes times = TimesOf(*scan.job.sweep);
  const std::vector<std::uint32_t> few =
      SpreadIndices(scan.reduced.to_match.size(), kRelocalization.num_coarse_points);
  const std::vector<ScanPoint> points = Pick(scan.reduced.points, Pick(scan.reduced.to_match, few));
  const std::vector<FeatureTag> tags = Pick(scan.tags_to_match, few);
  const std::vector<float> shares =
      Pick(SharesOfPriorError(TimesFromMidSweep(times, scan.reduced), scan.job), few);
  std::optional<Pose> best;
  double most = 0.0;
  for (const Pose& guess : Turned(prior)) {
    const std::vector<Eigen::Vector3f> points_imu =
        Deskew(points, times, BentTo(guess, scan.job), T_imu_lidar_);
    MatchInput input = scan.InputFrom(guess, CandidateCov());
    input.points_imu = points_imu;
    input.tags = tags;
    input.shares_of_correction = shares;
    const MatchResult coarse = MatchCoarsely(input, scan);
    if (SupportOf(coarse) <= most) continue;
    most = SupportOf(coarse);
    best = coarse.T_map_imu;
  }
  return best;
}

}  // namespace lio
