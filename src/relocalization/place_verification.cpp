// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_verification.hpp"

namespace lio {
namespace {

// A guess less sure than this, felt by points at kLever_m, may be beyond what matching reaches.
constexpr double kSureGuess_m = 2.0;
constexpr double kLever_m = 20.0;
// Of the points that come to a surface of the map 98 % lie on it where the scan is, on the worst
// walks, and 78 % at most elsewhere: so much of the share that the last scan had is enough ...
constexpr double kFittingShare = 0.9;
// ... of a number of points that says something, by what the last one had. With as many as the
// second of these there is no need to look on, and against what the inertial unit says it takes
// them.
constexpr double kLeastNumber = 0.2;
constexpr double kPlenty = 0.6;
// Two guesses are apart from here on. Better than the other is what has so many times its matches,
// much nearer what is so many times as far.
constexpr double kApart_m = 0.5;
constexpr double kClearlyMore = 1.2;
constexpr double kMuchNearer = 0.3;

// Steps that go to and fro end nowhere; where the scan fits all the same they are small.
bool GoesToAndFro(const MatchResult& match) {
  return match.status == MatchStatus::kMaxIterations && match.num_in_map > 0;
}

}  // namespace

bool IsWithinReachOfMatching(const Matrix6& prior_cov) {
  const double translation_var = prior_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
  const double rotation_var = prior_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return translation_var + kLever_m * kLever_m * rotation_var < kSureGuess_m * kSureGuess_m;
}

bool IsVerified(const MatchResult& match, const MatchResult& last) {
  if (!match.IsUsable() && !GoesToAndFro(match)) return false;
  if (last.num_matched == 0) return true;  // it began the map
  const bool is_on_surfaces =
      static_cast<double>(match.num_matched) * last.num_in_map >=
      kFittingShare * static_cast<double>(last.num_matched) * match.num_in_map;
  return is_on_surfaces && match.num_matched >= kLeastNumber * last.num_matched;
}

bool IsVerifiedElsewhere(const MatchResult& match, const MatchResult& last) {
  return IsVerified(match, last) && (match.degenerate_mask == 0 || last.degenerate_mask != 0);
}

bool IsVerifiedBeyondDoubt(const MatchResult& match, const MatchResult& last) {
  return IsVerifiedElsewhere(match, last) && match.num_matched >= kPlenty * last.num_matched;
}

bool IsNearAlternative(const MatchResult& match, const Pose& prior, const Pose& alternative) {
  const auto off_m = [&](const Pose& guess) {
    return (match.T_map_imu.translation - guess.translation).norm();
  };
  const double off_prior_m = off_m(prior);
  return match.IsUsable() && match.degenerate_mask == 0 && off_prior_m > kApart_m &&
         off_m(alternative) < kMuchNearer * off_prior_m;
}

bool IsClearlyBetter(const MatchResult& match, const MatchResult& other) {
  return match.num_matched > kClearlyMore * other.num_matched;
}

}  // namespace lio
