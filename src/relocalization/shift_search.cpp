// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/shift_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr ShiftSearchParameters kShift = kRelocalization.shift;

struct ScoredShift {
  Eigen::Vector2f position_m;
  int score = 0;
};

int ScoreAt(std::span<const PlacedView> earlier, const BirdsEyeView& now,
            const Eigen::Vector2f& position_m) {
  int score = 0;
  for (const PlacedView& other : earlier) {
    score += other.view.NumNear(now.structures(), position_m - other.position_m);
  }
  return score;
}

// Returns the score if nothing but the sensor's own pattern of beams were seen, which moves with
// it.
int ScoreOfPattern(std::span<const PlacedView> earlier, const BirdsEyeView& now) {
  int score = 0;
  for (const PlacedView& other : earlier) {
    score += other.view.NumNear(now.structures(), Eigen::Vector2f::Zero());
  }
  return score;
}

std::vector<ScoredShift> ScoreAll(std::span<const PlacedView> earlier, const BirdsEyeView& now,
                                  const Eigen::Vector2f& guess_m, float range_m) {
  const int num_steps = static_cast<int>(std::ceil(range_m / kShift.step_m));
  std::vector<ScoredShift> scored;
  for (int y = -num_steps; y <= num_steps; ++y) {
    for (int x = -num_steps; x <= num_steps; ++x) {
      const Eigen::Vector2f steps(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector2f position_m = guess_m + kShift.step_m * steps;
      scored.push_back({position_m, ScoreAt(earlier, now, position_m)});
    }
  }
  return scored;
}

// Returns mean and covariance over all positions, each weighted by its likelihood (Olson 2009, eq.
// 10).
FoundShift Summarise(const std::vector<ScoredShift>& scored, int peak, double chance) {
  double weight_sum = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  const Eigen::Vector2f origin_m = scored.front().position_m;
  for (const ScoredShift& one : scored) {
    const double weight = std::exp(kShift.log_odds * (one.score - peak) / chance);
    const Eigen::Vector2d offset_m = (one.position_m - origin_m).cast<double>();
    weight_sum += weight;
    sum += weight * offset_m;
    squares += weight * offset_m * offset_m.transpose();
  }
  const Eigen::Vector2d mean = sum / weight_sum;
  return {origin_m.cast<double>() + mean,
          squares / weight_sum - mean * mean.transpose() +
              kShift.min_std_m * kShift.min_std_m * Eigen::Matrix2d::Identity()};
}

}  // namespace

std::optional<FoundShift> FindShift(std::span<const PlacedView> earlier, const BirdsEyeView& now,
                                    const Eigen::Vector2f& guess_m, float range_m) {
  if (earlier.empty() || !now.HasEnoughStructures()) return {};
  const std::vector<ScoredShift> scored = ScoreAll(earlier, now, guess_m, range_m);
  const ScoredShift best = *std::max_element(
      scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  const int peak = best.score;
  // A best position at the border of the range may have a better one beyond it.
  if ((best.position_m - guess_m).cwiseAbs().maxCoeff() > range_m - 0.5f * kShift.step_m) return {};
  // Errors of views of the same structures are partly alike: n of them count as the root of n.
  const double chance = std::sqrt(std::sqrt(static_cast<double>(earlier.size())) * peak);
  if (peak == 0 || peak - ScoreOfPattern(earlier, now) < chance) return {};
  return Summarise(scored, peak, chance);
}

}  // namespace lio
