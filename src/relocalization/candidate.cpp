// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/candidate.hpp"

#include "lio/relocalization/parameters.hpp"
#include "relocalization/place_verification.hpp"

namespace lio {

Matrix6 CandidateCov() {
  constexpr PlaceCandidateParameters kCandidate = kRelocalization.candidate;
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << Vector3::Constant(kCandidate.std_m * kCandidate.std_m),
      Vector3::Constant(kCandidate.std_rad * kCandidate.std_rad);
  return cov;
}

double SupportOf(const MatchResult& match) {
  const bool may_be_there = match.IsUsable() || match.status == MatchStatus::kMaxIterations;
  if (!may_be_there) return 0.0;
  const double share = match.num_in_map == 0 ? 1.0 : ShareOf(match);
  return share * match.num_matched;
}

}  // namespace lio
