// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A candidate is a pose at which a scan may have been taken; a match from there says how likely it
// is. Nothing throws.
#pragma once

#include "lio/registration/scan_matcher.hpp"

namespace lio {

// Returns the covariance of a candidate's error, right error [translation (m); rotation (rad)].
[[nodiscard]] Matrix6 CandidateCov();
[[nodiscard]] Matrix6 CandidateCov(double std_m, double std_rad);

// Did the match come to an end near a place, or oscillate about one?
[[nodiscard]] bool MayBeThere(const MatchResult& match);

// Returns how much speaks for a match: the number of points on surfaces times their share of those
// that come to one. Ground gives many points anywhere, so that the number alone does not tell.
[[nodiscard]] double SupportOf(const MatchResult& match);

}  // namespace lio
