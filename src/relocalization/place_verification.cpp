// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_verification.hpp"

#include <algorithm>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr PlaceVerificationParameters kVerify = kRelocalization.verification;

// Steps that oscillate never end the iteration; at the right place they are small.
bool Oscillates(const MatchResult& match) {
  return match.status == MatchStatus::kMaxIterations && match.num_in_map > 0;
}

// Does at least this share of the last scan's share of points lie on surfaces?
bool HasShareOf(const Support& now, const Support& last, double share) {
  return static_cast<double>(now.num_matched) * last.num_in_map >=
         share * static_cast<double>(last.num_matched) * now.num_in_map;
}

// Floors and ceilings fit anywhere, so what stands is asked besides, where the last scan had enough
// of it.
bool StandsAsBefore(const Support& now, const Support& last, double share) {
  return last.num_matched < kVerify.min_upright ||
         (now.num_matched >= kVerify.min_number * last.num_matched && HasShareOf(now, last, share));
}

bool HasShare(const MatchResult& match, const MatchResult& last, double share) {
  return HasShareOf({match.num_in_map, match.num_matched}, {last.num_in_map, last.num_matched},
                    share) &&
         StandsAsBefore(match.upright, last.upright, share);
}

// No direction is degenerate unless the last scan had one.
bool IsAsObservable(const MatchResult& match, const MatchResult& last) {
  return match.degenerate_mask == 0 || last.degenerate_mask != 0;
}

}  // namespace

double ShareOf(const MatchResult& match) {
  return match.num_in_map == 0 ? 0.0 : static_cast<double>(match.num_matched) / match.num_in_map;
}

bool IsBeaten(double rival_residual, double residual, double least_residual) {
  return rival_residual >=
         kRelocalization.rival.min_residual_ratio * std::max(residual, least_residual);
}

bool IsVerified(const MatchResult& match, const MatchResult& last) {
  if (!match.IsUsable() && !Oscillates(match)) return false;
  if (last.num_matched == 0) return true;  // the last scan began the map
  return HasShare(match, last, kVerify.min_share) &&
         match.num_matched >= kVerify.min_number * last.num_matched;
}

bool IsVerifiedElsewhere(const MatchResult& match, const MatchResult& last) {
  return IsVerified(match, last) && IsAsObservable(match, last);
}

bool HasPlenty(const MatchResult& match, const MatchResult& last) {
  return match.num_matched >= kVerify.plenty_number * last.num_matched;
}

bool IsAsTheLast(const MatchResult& match, const MatchResult& last) {
  return match.IsUsable() && IsVerified(match, last) &&
         match.num_matched >= kVerify.same_number * last.num_matched;
}

bool IsLikely(const MatchResult& match, const MatchResult& last) {
  const bool has_shares = last.num_in_map > 0;  // as the method ndt counts
  return has_shares && IsAsObservable(match, last) && HasPlenty(match, last) &&
         HasShare(match, last, kVerify.likely_share);
}

bool IsVerifiedBeyondDoubt(const MatchResult& match, const MatchResult& last) {
  return IsVerifiedElsewhere(match, last) && HasPlenty(match, last);
}

bool IsNearAlternative(const MatchResult& match, const Pose& prior, const Pose& alternative) {
  const auto off_m = [&](const Pose& guess) {
    return (match.T_map_imu.translation - guess.translation).norm();
  };
  const double off_prior_m = off_m(prior);
  return match.IsUsable() && match.degenerate_mask == 0 && off_prior_m > kVerify.apart_m &&
         off_m(alternative) < kVerify.much_nearer * off_prior_m;
}

bool IsClearlyWorse(const MatchResult& match, const MatchResult& other) {
  return IsBeaten(1.0 - ShareOf(match), 1.0 - ShareOf(other), kRelocalization.rival.least_residual);
}

bool IsClearlyBetter(const MatchResult& match, const MatchResult& other) {
  return match.num_matched > kVerify.clearly_more * other.num_matched;
}

}  // namespace lio
