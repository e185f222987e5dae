// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/relocalizer.hpp"

#include <algorithm>
#include <utility>

#include "lio/relocalization/candidate.hpp"
#include "lio/relocalization/parameters.hpp"
#include "relocalization/place_candidates.hpp"
#include "relocalization/place_verification.hpp"

namespace lio {
namespace {

// A place is taken whose steps only go to and fro, and none is that the map contradicts.
void RefuseUnlessVerified(const MatchResult& last, MatchResult& match) {
  if (IsVerified(match, last)) {
    if (!match.IsUsable()) match.status = MatchStatus::kConverged;
  } else if (match.IsUsable()) {
    match.status = MatchStatus::kTooFewPoints;
  }
}

// Returns the guesses, moved to where a coarse match ends, best first, each place once.
std::vector<Pose> RankedCandidates(const std::vector<Pose>& guesses,
                                   const MatchFrom& match_coarsely) {
  struct Candidate {
    Pose T_map_imu;
    double support = 0.0;
  };
  std::vector<Candidate> candidates;
  for (const Pose& guess : guesses) {
    const MatchResult coarse = match_coarsely(guess, CandidateCov());
    const double support = SupportOf(coarse);
    candidates.push_back({support > 0.0 ? coarse.T_map_imu : guess, support});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.support > b.support; });
  std::vector<Pose> ranked;
  for (const Candidate& candidate : candidates) {
    const auto is_same = [&](const Pose& other) { return IsSamePlace(candidate.T_map_imu, other); };
    if (std::none_of(ranked.begin(), ranked.end(), is_same)) ranked.push_back(candidate.T_map_imu);
  }
  return ranked;
}

}  // namespace

bool IsWithinConvergenceBasin(const Matrix6& prior_cov) {
  constexpr PlaceVerificationParameters kBasin = kRelocalization.verification;
  const double translation_var = prior_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
  const double rotation_var = prior_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return translation_var + kBasin.lever_m * kBasin.lever_m * rotation_var <
         kBasin.max_prior_std_m * kBasin.max_prior_std_m;
}

Relocalizer::Velocity Relocalizer::FindVelocity(const DeskewedScan& scan,
                                                const MotionPrior& prior) {
  const Quaternion R_level_map = LevelFromMap(prior.up_map);
  velocity_search_.Add(scan.stamp,
                       Levelled(scan.points_imu, R_level_map * prior.T_map_imu.rotation));
  if (velocity_search_.num_scans() < kRelocalization.velocity.min_scans) return {};
  const SeenVelocity seen = velocity_search_.Find();
  const bool may_buildings_tell =
      seen.by_buildings && !seen.is_of_buildings &&
      velocity_search_.num_scans() < kRelocalization.velocity.max_scans_of_buildings;
  Velocity velocity{.v_map_imu_mps = {}, .by_buildings = seen.by_buildings};
  if (seen.v_mps && !may_buildings_tell) {
    velocity.v_map_imu_mps =
        R_level_map.conjugate() * Vector3(seen.v_mps->x(), seen.v_mps->y(), 0.0);
  }
  return velocity;
}

MotionPrior Relocalizer::Align(const DeskewedScan& scan, const MotionPrior& prior) const {
  if (!last_) return prior;
  const Quaternion R_level_map = LevelFromMap(prior.up_map);
  VelocitySearch search;
  search.Add(last_->stamp,
             Levelled(last_->points_imu, R_level_map * last_->match.T_map_imu.rotation));
  search.Add(scan.stamp, Levelled(scan.points_imu, R_level_map * prior.T_map_imu.rotation));
  const auto v_level_mps = search.Find().v_mps;
  if (!v_level_mps) return prior;
  const double since_s = SecondsBetween(last_->stamp, scan.stamp);
  const Vector3 shift_level = since_s * Vector3(v_level_mps->x(), v_level_mps->y(), 0.0);
  MotionPrior aligned = prior;
  aligned.T_map_imu.translation =
      last_->match.T_map_imu.translation + R_level_map.conjugate() * shift_level;
  aligned.cov.topLeftCorner<3, 3>() =
      kRelocalization.aligned_std_m * kRelocalization.aligned_std_m * Matrix3::Identity();
  return aligned;
}

Relocalizer::Found Relocalizer::Search(const SearchRequest& request, const DeskewedScan& scan,
                                       const MotionPrior& prior, const MatchResult& near_prior,
                                       const CandidateMatcher& matcher) {
  Found found{near_prior};
  if (!last_) return found;
  CandidateMatcher of_places = matcher;
  if (request.T_map_imu_alternative) --of_places.max_matches;
  SearchPlaces(request, scan, prior, of_places, found);
  if (request.T_map_imu_alternative && !found.is_relocalized) {
    TryAlternative(*request.T_map_imu_alternative, prior, matcher.match, found);
  }
  return found;
}

void Relocalizer::SearchPlaces(const SearchRequest& request, const DeskewedScan& scan,
                               const MotionPrior& prior, const CandidateMatcher& matcher,
                               Found& found) {
  const MatchResult& last = last_->match;
  const bool is_prior_sure = IsWithinConvergenceBasin(prior.cov);
  if (request.region == SearchRegion::kObservable && last.degenerate_mask != 0) {
    if (!is_prior_sure) RefuseUnlessVerified(last, found.match);
    return;
  }
  const bool is_tracked = request.region == SearchRegion::kTracked;
  const bool is_near_prior = is_prior_sure && found.match.IsUsable();
  if (is_near_prior ? HasPlenty(found.match, last)
                    : found.match.IsUsable() && IsLikely(found.match, last)) {
    return;
  }
  if (is_tracked && is_prior_sure && !is_near_prior) return;
  const bool may_be_elsewhere = !is_near_prior && !(is_tracked && last.degenerate_mask != 0);
  if (may_be_elsewhere && !IsVerifiedBeyondDoubt(found.match, last)) {
    if (request.region == SearchRegion::kObservable) {
      TakePlaceWithoutRival(scan, prior, matcher, found);
    } else {
      TakeBestPlace(scan, prior, matcher, found);
    }
  }
  RefuseUnlessVerified(last, found.match);
}

// Matches the scan at as many candidates as it may, those first that no search before has tried,
// until `take` has enough.
void Relocalizer::TryPlaces(const DeskewedScan& scan, const MotionPrior& prior,
                            const CandidateMatcher& matcher,
                            const std::function<bool(const MatchResult&)>& take) {
  const PlacedScan earlier{last_->points_imu, last_->match.T_map_imu};
  const PlacedScan now{scan.points_imu, prior.T_map_imu};
  const bool was_unseen = prior.since_last_fix_s > kRelocalization.candidate.unseen_from_s;
  std::vector<Pose> candidates = RankedCandidates(
      PlaceCandidates(earlier, now, prior.cov, LevelFromMap(prior.up_map), was_unseen),
      matcher.match_coarsely);
  const auto is_new = [&](const Pose& place) { return !tried_.Contains(prior.T_map_imu, place); };
  if (std::none_of(candidates.begin(), candidates.end(), is_new)) tried_.Clear();
  std::stable_partition(candidates.begin(), candidates.end(), is_new);
  int num_left = matcher.max_matches;
  for (const Pose& candidate : candidates) {
    if (num_left-- <= 0) return;
    const MatchResult match = matcher.match(candidate, CandidateCov());
    tried_.Add(prior.T_map_imu, candidate);
    if (take(match)) return;
  }
}

// Takes the place with the most points, or the first one beyond doubt.
void Relocalizer::TakeBestPlace(const DeskewedScan& scan, const MotionPrior& prior,
                                const CandidateMatcher& matcher, Found& found) {
  const MatchResult& last = last_->match;
  TryPlaces(scan, prior, matcher, [&](const MatchResult& match) {
    const bool is_more = !HasNumber(found.match, match, 1.0);
    if (!IsVerifiedElsewhere(match, last)) return false;
    if (IsVerifiedElsewhere(found.match, last) && !is_more) return false;
    found.match = match;
    found.is_relocalized = true;
    return IsVerifiedBeyondDoubt(match, last);
  });
}

// The body may be anywhere: none of several places is taken that look alike.
void Relocalizer::TakePlaceWithoutRival(const DeskewedScan& scan, const MotionPrior& prior,
                                        const CandidateMatcher& matcher, Found& found) {
  std::optional<MatchResult> best;
  bool has_rival = false;
  TryPlaces(scan, prior, matcher, [&](const MatchResult& match) {
    if (!IsVerifiedBeyondDoubt(match, last_->match)) return false;
    if (best && IsSamePlace(match.T_map_imu, best->T_map_imu)) return false;
    if (best && IsClearlyWorse(match, *best)) return false;
    has_rival |= best && !IsClearlyWorse(*best, match);
    best = match;
    return has_rival;
  });
  if (!best || has_rival) return;
  found.match = *best;
  found.is_relocalized = true;
}

void Relocalizer::TryAlternative(const Pose& alternative, const MotionPrior& prior,
                                 const MatchFrom& match, Found& found) const {
  found.is_clock_set = IsNearAlternative(found.match, prior.T_map_imu, alternative);
  if (found.is_clock_set) return;
  const MatchResult there = match(alternative, CandidateCov());
  const bool is_better = IsClearlyBetter(there, found.match);
  if (there.degenerate_mask != 0 || !IsVerified(there, last_->match) || !is_better) return;
  found.match = there;
  found.match.status = MatchStatus::kConverged;  // or its steps oscillate by little
  found.is_clock_set = true;
}

void Relocalizer::HoldDegenerate(std::span<const Eigen::Vector3f> points_imu,
                                 const MotionPrior& prior, MatchResult& match) {
  hold_.Apply(points_imu, LevelFromMap(prior.up_map), prior.cov, match);
}

bool Relocalizer::MayBeElsewhere(const MatchResult& match) const {
  return last_ && !IsAsTheLast(match, last_->match);
}

void Relocalizer::SetLocated(Timestamp stamp, std::vector<Eigen::Vector3f> points_imu,
                             const MatchResult& match) {
  last_ = {stamp, std::move(points_imu), match};
  tried_.Clear();
}

}  // namespace lio
