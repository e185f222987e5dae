// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_verification.hpp"

#include "lio/relocalization/parameters.hpp"
#include "lio/relocalization/relocalizer.hpp"

namespace lio {
namespace {

constexpr PlaceVerificationParameters kVerify = kRelocalization.verification;

// Steps that oscillate never end the iteration; at the right place they are small.
bool Oscillates(const MatchResult& match) {
  return match.status == MatchStatus::kMaxIterations && match.num_in_map > 0;
}

}  // namespace

bool IsWithinReachOfMatching(const Matrix6& prior_cov) {
  const double translation_var = prior_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
  const double rotation_var = prior_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return translation_var + kVerify.lever_m * kVerify.lever_m * rotation_var <
         kVerify.max_prior_std_m * kVerify.max_prior_std_m;
}

bool IsVerified(const MatchResult& match, const MatchResult& last) {
  if (!match.IsUsable() && !Oscillates(match)) return false;
  if (last.num_matched == 0) return true;  // the last scan began the map
  const bool is_on_surfaces =
      static_cast<double>(match.num_matched) * last.num_in_map >=
      kVerify.min_share * static_cast<double>(last.num_matched) * match.num_in_map;
  return is_on_surfaces && match.num_matched >= kVerify.min_number * last.num_matched;
}

bool IsVerifiedElsewhere(const MatchResult& match, const MatchResult& last) {
  return IsVerified(match, last) && (match.degenerate_mask == 0 || last.degenerate_mask != 0);
}

bool HasPlenty(const MatchResult& match, const MatchResult& last) {
  return match.num_matched >= kVerify.plenty_number * last.num_matched;
}

bool IsLikely(const MatchResult& match, const MatchResult& last) {
  const bool is_observable = match.degenerate_mask == 0 || last.degenerate_mask != 0;
  const bool has_shares = last.num_in_map > 0;  // as the method ndt counts
  return has_shares && is_observable && HasPlenty(match, last) &&
         static_cast<double>(match.num_matched) * last.num_in_map >=
             kVerify.likely_share * last.num_matched * match.num_in_map;
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

bool IsClearlyBetter(const MatchResult& match, const MatchResult& other) {
  return match.num_matched > kVerify.clearly_more * other.num_matched;
}

}  // namespace lio
