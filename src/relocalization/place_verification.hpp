// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is a scan where a match says it is? It is judged by the share of its points that lie on surfaces
// of the map, and by their number, against those of the last scan that was located.
#pragma once

#include "lio/registration/scan_matcher.hpp"

namespace lio {

// Returns the share of those points that lie on a surface, of all that come to one; 0 where none
// does.
[[nodiscard]] double ShareOf(const Support& support);
[[nodiscard]] double ShareOf(const MatchResult& match);

// Counts the points of a match on such surfaces as another match has points on, too.
struct ComparableSupport {
  Support all;
  Support upright;  // on surfaces that stand
};

// Returns what of a match's support compares with that of `other`, which may have left vertical
// structures out (UprightSupport::structures).
[[nodiscard]] ComparableSupport ComparableTo(const MatchResult& other, const MatchResult& match);

// Does the map contradict a clearly larger share of the points at a rival than at the place, of
// which so many are taken to be contradicted at least?
[[nodiscard]] bool IsBeaten(double rival_residual, double residual, double least_residual);

// Does the scan lie on the map's surfaces there? Steps that oscillate around a pose count as a
// match.
[[nodiscard]] bool IsVerified(const MatchResult& match, const MatchResult& last);

// Has it at least `share` times the points on surfaces that the last scan has?
[[nodiscard]] bool HasNumber(const MatchResult& match, const MatchResult& last, double share);

// Do nearly as many points lie on surfaces as of the last scan?
[[nodiscard]] bool HasPlenty(const MatchResult& match, const MatchResult& last);

// Does it lie on the map as well as the last scan did, and with about as many points? A view
// changes little from scan to scan.
[[nodiscard]] bool IsAsTheLast(const MatchResult& match, const MatchResult& last);

// From an unsure prior: has it so many points, and more of them on surfaces than at any wrong place
// that was measured? A scan that is bent by a motion that nobody measured cannot show more. No
// direction may be degenerate unless the last scan had one.
[[nodiscard]] bool IsLikely(const MatchResult& match, const MatchResult& last);

// The same far from the prior: bare ground agrees everywhere, so that no direction may be
// degenerate unless the last scan had one.
[[nodiscard]] bool IsVerifiedElsewhere(const MatchResult& match, const MatchResult& last);

// A match is beyond doubt with so many points on surfaces that there is no need to search on.
[[nodiscard]] bool IsVerifiedBeyondDoubt(const MatchResult& match, const MatchResult& last);

// Is the match much nearer to `alternative` than to `prior`, two poses that are apart?
[[nodiscard]] bool IsNearAlternative(const MatchResult& match, const Pose& prior,
                                     const Pose& alternative);

// Does the map contradict clearly more of the scan's points in `match` than in `other`?
[[nodiscard]] bool IsClearlyWorse(const MatchResult& match, const MatchResult& other);

// Has `match` clearly more points on surfaces than `other`?
[[nodiscard]] bool IsClearlyBetter(const MatchResult& match, const MatchResult& other);

}  // namespace lio
