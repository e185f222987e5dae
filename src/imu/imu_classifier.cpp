// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_classifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lio {
namespace {

constexpr ImuClassifierParameters kClassifier = kImuConventionParameters.classifier;

// The score of the forces with gravity or without, whichever is smaller.
double LeastForceScore(std::span<const MotionEvidence::Bend> bends, const ImuConvention& convention,
                       double gravity_mps2) {
  const auto score = [&](double g_mps2) {
    return MotionEvidence::ForceScore(bends, convention.R_imu_sent, convention.force_scale(),
                                      g_mps2);
  };
  return std::min(score(0.0), score(gravity_mps2));
}

}  // namespace

ImuClassifier::ImuClassifier(const ImuConvention& expected, const Rig& rig)
    : expected_(expected),
      gravity_mps2_(rig.gravity_mps2),
      lidar_axis_imu_(rig.T_imu_lidar.value_or(Pose{}).rotation * Vector3::UnitZ()) {}

// How far the lidar's z axis is from up under a convention: 0 for upright, 1 for level, 2 for
// hanging. Lidars mostly stand upright.
double ImuClassifier::Lean(const ImuConvention& convention) const {
  Vector3 force_sum = Vector3::Zero();
  for (const MotionEvidence::Step& step : evidence_.steps()) force_sum += step.f_sent;
  if (force_sum.isZero()) return 0.0;
  return 1.0 - lidar_axis_imu_.dot(convention.R_imu_sent * force_sum.normalized());
}

// Returns every convention with its score, the sum of those of rates and forces. Another unit of
// rates is considered only when the rates show the turns at all.
std::vector<ImuClassifier::Scored> ImuClassifier::ScoreAll(Bends bends) const {
  std::vector<Scored> all;
  for (const Matrix3& R : QuarterTurns()) {
    for (const bool is_in_deg : {false, true}) {
      const ImuConvention rates{false, is_in_deg, R};
      if (is_in_deg == expected_.is_in_deg || IsGyroHeard(rates)) ScoreForces(rates, bends, all);
    }
  }
  return all;
}

void ImuClassifier::ScoreForces(const ImuConvention& rates, Bends bends,
                                std::vector<Scored>& all) const {
  const double rate_score = evidence_.RateScore(rates.R_imu_sent, rates.rate_scale());
  const double leaning = kClassifier.lean_score * std::max(0.0, Lean(rates) - Lean(expected_));
  for (const bool is_in_g : {false, true}) {
    if (keeps_force_unit_ && is_in_g != expected_.is_in_g) continue;
    const ImuConvention convention{is_in_g, rates.is_in_deg, rates.R_imu_sent};
    for (const double gravity_mps2 : {0.0, gravity_mps2_}) {
      const bool has_gravity = gravity_mps2 > 0.0;
      const double force_score = MotionEvidence::ForceScore(bends, convention.R_imu_sent,
                                                            convention.force_scale(), gravity_mps2);
      all.push_back(
          {convention, has_gravity, rate_score + force_score + (has_gravity ? leaning : 0.0)});
    }
  }
}

// Returns the convention among `likely` with the fewest changes against the expected one; absent
// when several have as few.
std::optional<ImuConvention> ImuClassifier::LeastChange(std::span<const Scored> likely) const {
  std::optional<ImuConvention> least;
  int least_changes = std::numeric_limits<int>::max();
  bool is_only = false;
  for (const Scored& scored : likely) {
    const ImuConvention& convention = scored.convention;
    if (convention == least) continue;
    const int changes = static_cast<int>(convention.is_in_g != expected_.is_in_g) +
                        static_cast<int>(convention.is_in_deg != expected_.is_in_deg) +
                        static_cast<int>(convention.R_imu_sent != expected_.R_imu_sent);
    if (changes > least_changes) continue;
    is_only = changes < least_changes;
    least_changes = changes;
    least = convention;
  }
  return is_only ? least : std::nullopt;
}

// Returns true when the gyro's rates explain the turns better than no rates at all. Noise and
// vibration of a vehicle at rest do not, however small another unit makes them.
bool ImuClassifier::IsGyroHeard(const ImuConvention& convention) const {
  return evidence_.RateScore(convention.R_imu_sent, 0.0) >
         evidence_.RateScore(convention.R_imu_sent, convention.rate_scale()) +
             kClassifier.refuted_score;
}

// Returns the least score of the expected convention over the clock offsets that are possible.
double ImuClassifier::ExpectedScoreOfOtherClocks() const {
  double least = std::numeric_limits<double>::infinity();
  for (double num_steps = -kClassifier.max_clock_shift_steps;
       num_steps <= kClassifier.max_clock_shift_steps;
       num_steps += kClassifier.clock_shift_grid_steps) {
    const MotionEvidence shifted = evidence_.Shifted(num_steps);
    if (shifted.steps().empty()) continue;
    const std::vector<MotionEvidence::Bend> bends = shifted.FindBends();
    const double rate_score = shifted.RateScore(expected_.R_imu_sent, expected_.rate_scale());
    // A shift leaves fewer steps, hence a smaller score.
    const double share =
        static_cast<double>(shifted.steps().size()) / static_cast<double>(evidence_.steps().size());
    const double force_score = LeastForceScore(bends, expected_, gravity_mps2_);
    least = std::min(least, (rate_score + force_score) / share);
  }
  return least;
}

ImuClassifier::Ranking ImuClassifier::Rank(Bends bends) const {
  Ranking ranking;
  ranking.all = ScoreAll(bends);
  for (const Scored& scored : ranking.all) {
    ranking.best = std::min(ranking.best, scored.score);
    if (scored.convention == expected_) ranking.expected = std::min(ranking.expected, scored.score);
  }
  double num_terms = 3.0 * static_cast<double>(evidence_.steps().size());
  for (const MotionEvidence::Bend& bend : bends) num_terms += 3.0 * bend.weight;
  ranking.scale = std::max(1.0, ranking.best / num_terms);
  return ranking;
}

// Returns the conventions that fit nearly as well as the best; none where the expected is among
// them.
std::vector<ImuClassifier::Scored> ImuClassifier::FavouredOverExpected() const {
  if (evidence_.steps().size() < kClassifier.min_steps) return {};
  Ranking ranking = Rank(evidence_.FindBends());
  const double limit = ranking.best + kClassifier.favoured_score * ranking.scale;
  if (ranking.expected <= limit) return {};
  std::erase_if(ranking.all, [&](const Scored& scored) { return scored.score > limit; });
  return std::move(ranking.all);
}

bool ImuClassifier::FavoursAnother() const {
  return !FavouredOverExpected().empty();
}

std::optional<ImuConvention> ImuClassifier::Favoured() const {
  return LeastChange(FavouredOverExpected());
}

ImuVerdict ImuClassifier::Judge(bool in_doubt) const {
  using Finding = ImuVerdict::Finding;
  ImuVerdict verdict;
  verdict.convention = expected_;
  if (evidence_.steps().size() < kClassifier.min_steps) return verdict;
  const std::vector<MotionEvidence::Bend> bends = evidence_.FindBends();
  Ranking ranking = Rank(bends);
  if (ranking.scale > kClassifier.max_residual_ratio_sq) return verdict;
  const auto within = [&](double margin) { return ranking.best + ranking.scale * margin; };
  std::vector<Scored>& likely = ranking.all;
  std::erase_if(likely,
                [&](const Scored& s) { return s.score > within(kClassifier.refuted_score); });

  const bool has_gravity = likely.front().has_gravity;
  const auto all_agree = [&likely](const auto& is_so) {
    return std::all_of(likely.begin(), likely.end(), is_so);
  };
  if (all_agree([&](const Scored& s) { return s.has_gravity == has_gravity; })) {
    verdict.has_gravity = has_gravity;
  }
  if (all_agree([&](const Scored& s) { return s.convention == expected_; })) {
    verdict.finding = Finding::kAsExpected;
  } else if (const double limit =
                 within(in_doubt ? kClassifier.refuted_score : kClassifier.given_up_score);
             ranking.expected > limit && ExpectedScoreOfOtherClocks() > limit) {
    verdict.finding = Finding::kNotExpected;
    const std::optional<ImuConvention> found = LeastChange(likely);
    if (found && verdict.has_gravity) {
      verdict.finding = Finding::kOtherwise;
      verdict.convention = *found;
      verdict.evidence = Describe(*found, bends);
    }
  }
  return verdict;
}

bool ImuClassifier::IsGyroAbsurd() const {
  if (!HasMoved()) return false;
  constexpr int kRecent = kImuConventionParameters.evidence.recent_steps;
  const std::vector<MotionEvidence::Step>& steps = evidence_.steps();
  const auto num_absurd = std::count_if(steps.end() - kRecent, steps.end(), [&](const auto& step) {
    const double read_rad = expected_.rate_scale() * step.span_s() * step.w_sent.norm();
    return read_rad > kClassifier.absurd_turn_rad &&
           read_rad > kClassifier.absurd_ratio * step.turn_rad.norm();
  });
  return 2 * num_absurd >= kRecent;
}

std::string ImuClassifier::Describe(const ImuConvention& found, Bends bends) const {
  const auto rate_error = [&](const ImuConvention& convention) {
    return evidence_.RateError_radps(
        evidence_.RateScore(convention.R_imu_sent, convention.rate_scale()));
  };
  const auto force_error = [&](const ImuConvention& convention) {
    return MotionEvidence::ForceError_mps2(bends,
                                           LeastForceScore(bends, convention, gravity_mps2_));
  };
  return fmt::format(
      "against scan matching rates are off by {:.3f} rad/s and forces by {:.2f} m/s^2, "
      "otherwise by {:.3f} and {:.2f}",
      rate_error(found), force_error(found), rate_error(expected_), force_error(expected_));
}

ForceAtRest JudgeForceAtRest(const Vector3& mean_f_sent, double gravity_mps2) {
  const double in_metric = mean_f_sent.norm() / gravity_mps2;
  const double in_g = ImuConvention{true, false}.force_scale() * in_metric;
  if (std::abs(in_metric - 1.0) < kClassifier.force_tolerance) return ForceAtRest::kMetric;
  if (std::abs(in_g - 1.0) < kClassifier.force_tolerance) return ForceAtRest::kInG;
  if (in_g < kClassifier.max_force_without_gravity) return ForceAtRest::kWithoutGravity;
  return ForceAtRest::kUnclear;
}

double RateNoise(std::span<const ImuSample> samples) {
  Vector3 sum_sq = Vector3::Zero();
  for (std::size_t i = 2; i < samples.size(); ++i) {
    const Vector3 bend =
        samples[i].w_imu_radps - 2.0 * samples[i - 1].w_imu_radps + samples[i - 2].w_imu_radps;
    sum_sq += bend.cwiseAbs2() / 6.0;
  }
  return samples.size() < 3
             ? 0.0
             : std::sqrt(sum_sq.maxCoeff() / static_cast<double>(samples.size() - 2));
}

bool IsNoiseOfDegrees(std::span<const ImuSample> samples, const ImuRig& imu) {
  const double noise_radps = RateNoise(samples);
  if (noise_radps < kClassifier.min_noise_radps) return false;
  const double span_s = SecondsBetween(samples.front().stamp, samples.back().stamp);
  const double rate_hz = static_cast<double>(samples.size() - 1) / span_s;
  const double noise_if_deg_radps = ImuConvention{false, true}.rate_scale() * noise_radps;
  return noise_if_deg_radps >
         kClassifier.min_noise_share * imu.gyro_noise_density * std::sqrt(rate_hz);
}

}  // namespace lio
