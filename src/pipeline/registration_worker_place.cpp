// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/registration_worker.hpp"
#include "relocalization/place_guesses.hpp"

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

bool IsSure(const Matrix6& guess_cov) {
  const double translation_var = guess_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
  const double rotation_var = guess_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return translation_var + kLever_m * kLever_m * rotation_var < kSureGuess_m * kSureGuess_m;
}

// Steps that go to and fro end nowhere; where the scan fits all the same they are small.
bool GoesToAndFro(const MatchResult& match) {
  return match.status == MatchStatus::kMaxIterations && match.num_in_map > 0;
}

// Is the scan where its match says, as far as the scene holds it?
bool Fits(const MatchResult& match, const MatchResult& last) {
  if (!match.IsUsable() && !GoesToAndFro(match)) return false;
  if (last.num_matched == 0) return true;  // it began the map
  const bool is_on_surfaces =
      static_cast<double>(match.num_matched) * last.num_in_map >=
      kFittingShare * static_cast<double>(last.num_matched) * match.num_in_map;
  return is_on_surfaces && match.num_matched >= kLeastNumber * last.num_matched;
}

// Bare ground fits everywhere: where a scan is only sought nothing may be weak that was not before.
bool FitsNowhereElse(const MatchResult& match, const MatchResult& last) {
  return Fits(match, last) && (match.degenerate_mask == 0 || last.degenerate_mask != 0);
}

// Much nearer to where it would be had no time passed than to where it was guessed?
bool IsNearClockSet(const MatchJob& job, const MatchResult& match) {
  const auto off_m = [&](const Pose& guess) {
    return (match.T_map_imu.translation - guess.translation).norm();
  };
  const double off_guess_m = off_m(job.T_map_imu_guess);
  return match.IsUsable() && match.degenerate_mask == 0 && off_guess_m > kApart_m &&
         off_m(*job.T_map_imu_if_clock_set) < kMuchNearer * off_guess_m;
}

}  // namespace

void RegistrationWorker::TryClockSet(const MatchJob& job, MatchInput input, MatchOutcome& outcome) {
  if (!job.T_map_imu_if_clock_set || outcome.is_sought) return;
  outcome.is_clock_set = IsNearClockSet(job, outcome.match);  // it was sought, perhaps
  if (outcome.is_clock_set) return;
  input.T_map_imu_guess = *job.T_map_imu_if_clock_set;
  input.guess_cov = GuessedPlaceCov();
  const MatchResult match = matcher_->Match(input);
  const bool is_better = match.num_matched > kClearlyMore * outcome.match.num_matched;
  if (match.degenerate_mask != 0 || !Fits(match, last_found_->match) || !is_better) return;
  outcome.match = match;
  outcome.match.status = MatchStatus::kConverged;  // or to and fro, by little
  outcome.is_clock_set = true;
}

void RegistrationWorker::SeekPlace(const MatchJob& job, MatchInput input, MatchOutcome& outcome) {
  const MatchResult& last = last_found_->match;
  const bool is_unlike_imu = job.seek_place == MatchJob::SeekPlace::kWhereHeld;
  if (job.seek_place == MatchJob::SeekPlace::kNowhere) return;
  if (is_unlike_imu && last.degenerate_mask != 0) return;
  if (outcome.match.IsUsable() && IsSure(job.guess_cov)) return;
  const auto has_plenty = [&](const MatchResult& match) {
    return FitsNowhereElse(match, last) && match.num_matched >= kPlenty * last.num_matched;
  };
  if (!has_plenty(outcome.match)) {
    const PlacedScan earlier{last_found_->points_imu, last.T_map_imu};
    const PlacedScan now{input.points_imu, job.T_map_imu_guess};
    input.guess_cov = GuessedPlaceCov();
    for (const Pose& guess : GuessPlaces(earlier, now, job.guess_cov, LevelOf(job.up_map))) {
      input.T_map_imu_guess = guess;
      const MatchResult match = matcher_->Match(input);
      const bool is_more = match.num_matched > outcome.match.num_matched;
      if (!FitsNowhereElse(match, last)) continue;
      if (is_unlike_imu && !has_plenty(match)) continue;
      if (FitsNowhereElse(outcome.match, last) && !is_more) continue;
      outcome.match = match;
      outcome.is_sought = true;
      if (has_plenty(match)) break;
    }
  }
  if (Fits(outcome.match, last)) {
    if (!outcome.match.IsUsable()) outcome.match.status = MatchStatus::kConverged;
  } else if (outcome.match.IsUsable()) {
    outcome.match.status = MatchStatus::kTooFewPoints;
  }
}

}  // namespace lio
