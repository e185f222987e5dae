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

Support operator-(const Support& all, const Support& part) {
  return {all.num_in_map - part.num_in_map, all.num_matched - part.num_matched};
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
  const ComparableSupport now = ComparableTo(last, match);
  const ComparableSupport before = ComparableTo(match, last);
  return HasShareOf(now.all, before.all, share) &&
         StandsAsBefore(now.upright, before.upright, share);
}

// No direction is degenerate unless the last scan had one.
bool IsAsObservable(const MatchResult& match, const MatchResult& last) {
  return match.degenerate_mask == 0 || last.degenerate_mask != 0;
}

}  // namespace

double ShareOf(const Support& support) {
  return support.num_in_map == 0 ? 0.0
                                 : static_cast<double>(support.num_matched) / support.num_in_map;
}

double ShareOf(const MatchResult& match) {
  return ShareOf(Support{match.num_in_map, match.num_matched});
}

ComparableSupport ComparableTo(const MatchResult& other, const MatchResult& match) {
  const Support all{match.num_in_map, match.num_matched};
  const Support& structures = match.upright.structures;
  if (other.upright.structures.num_in_map > 0) return {all, match.upright.all};
  return {all - structures, match.upright.all - structures};
}

bool HasNumber(const MatchResult& match, const MatchResult& last, double share) {
  return ComparableTo(last, match).all.num_matched >=
         share * ComparableTo(match, last).all.num_matched;
}

bool IsBeaten(double rival_residual, double residual, double least_residual) {
  return rival_residual >=
         kRelocalization.rival.min_residual_ratio * std::max(residual, least_residual);
}

bool IsVerified(const MatchResult& match, const MatchResult& last) {
  if (!match.IsUsable() && !Oscillates(match)) return false;
  if (last.num_matched == 0) return true;  // the last scan began the map
  return HasShare(match, last, kVerify.min_share) && HasNumber(match, last, kVerify.min_number);
}

bool IsVerifiedElsewhere(const MatchResult& match, const MatchResult& last) {
  return IsVerified(match, last) && IsAsObservable(match, last);
}

bool HasPlenty(const MatchResult& match, const MatchResult& last) {
  return HasNumber(match, last, kVerify.plenty_number);
}

bool IsAsTheLast(const MatchResult& match, const MatchResult& last) {
  return match.IsUsable() && IsVerified(match, last) && HasNumber(match, last, kVerify.same_number);
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
  return IsBeaten(1.0 - ShareOf(ComparableTo(other, match).all),
                  1.0 - ShareOf(ComparableTo(match, other).all),
                  kRelocalization.rival.least_residual);
}

bool IsClearlyBetter(const MatchResult& match, const MatchResult& other) {
  return !HasNumber(other, match, 1.0 / kVerify.clearly_more);
}

}  // namespace lio
