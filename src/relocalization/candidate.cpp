// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/candidate.hpp"

#include "lio/relocalization/parameters.hpp"
#include "relocalization/place_verification.hpp"

namespace lio {

Matrix6 CandidateCov(double std_m, double std_rad) {
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << Vector3::Constant(std_m * std_m), Vector3::Constant(std_rad * std_rad);
  return cov;
}

Matrix6 CandidateCov() {
  constexpr PlaceCandidateParameters kCandidate = kRelocalization.candidate;
  return CandidateCov(kCandidate.std_m, kCandidate.std_rad);
}

bool MayBeThere(const MatchResult& match) {
  return match.IsUsable() || match.status == MatchStatus::kMaxIterations;
}

double SupportOf(const MatchResult& match) {
  if (!MayBeThere(match)) return 0.0;
  const double share = match.num_in_map == 0 ? 1.0 : ShareOf(match);
  return share * match.num_matched;
}

}  // namespace lio
