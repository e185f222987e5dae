// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/shift_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lio {
namespace {

constexpr float kStep_m = 0.25f;
constexpr double kLeastStd_m = 0.2;
// So many powers of e less likely is what fits worse by as much as chance makes of a score.
constexpr double kUnlikely = 6.0;

struct Scored {
  Eigen::Vector2f place_m;
  int score = 0;
};

int ScoreAt(std::span<const PlacedView> earlier, const BirdsEyeView& now,
            const Eigen::Vector2f& place_m) {
  int score = 0;
  for (const PlacedView& other : earlier) {
    score += other.view.NumNear(now.places(), place_m - other.position_m);
  }
  return score;
}

// What it would be if nothing but the sensor's own pattern were seen, which moves with it.
int ScoreOfPattern(std::span<const PlacedView> earlier, const BirdsEyeView& now) {
  int score = 0;
  for (const PlacedView& other : earlier) {
    score += other.view.NumNear(now.places(), Eigen::Vector2f::Zero());
  }
  return score;
}

std::vector<Scored> ScoreAll(std::span<const PlacedView> earlier, const BirdsEyeView& now,
                             const Eigen::Vector2f& guess_m, float range_m) {
  const int num_steps = static_cast<int>(std::ceil(range_m / kStep_m));
  std::vector<Scored> scored;
  for (int y = -num_steps; y <= num_steps; ++y) {
    for (int x = -num_steps; x <= num_steps; ++x) {
      const Eigen::Vector2f steps(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector2f place_m = guess_m + kStep_m * steps;
      scored.push_back({place_m, ScoreAt(earlier, now, place_m)});
    }
  }
  return scored;
}

// Mean and covariance over all places, by how likely each is.
FoundShift Summarise(const std::vector<Scored>& scored, int peak, double chance) {
  double weight_sum = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  const Eigen::Vector2f origin_m = scored.front().place_m;
  for (const Scored& one : scored) {
    const double weight = std::exp(kUnlikely * (one.score - peak) / chance);
    const Eigen::Vector2d offset_m = (one.place_m - origin_m).cast<double>();
    weight_sum += weight;
    sum += weight * offset_m;
    squares += weight * offset_m * offset_m.transpose();
  }
  const Eigen::Vector2d mean = sum / weight_sum;
  return {origin_m.cast<double>() + mean,
          squares / weight_sum - mean * mean.transpose() +
              kLeastStd_m * kLeastStd_m * Eigen::Matrix2d::Identity()};
}

}  // namespace

std::optional<FoundShift> FindShift(std::span<const PlacedView> earlier, const BirdsEyeView& now,
                                    const Eigen::Vector2f& guess_m, float range_m) {
  if (earlier.empty() || !now.SaysEnough()) return {};
  const std::vector<Scored> scored = ScoreAll(earlier, now, guess_m, range_m);
  const Scored best = *std::max_element(
      scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  const int peak = best.score;
  // At the border of what was looked at the best place may be beyond it.
  if ((best.place_m - guess_m).cwiseAbs().maxCoeff() > range_m - 0.5f * kStep_m) return {};
  // Views of the same things err partly alike: n of them count as the root of n.
  const double chance = std::sqrt(std::sqrt(static_cast<double>(earlier.size())) * peak);
  if (peak == 0 || peak - ScoreOfPattern(earlier, now) < chance) return {};
  return Summarise(scored, peak, chance);
}

}  // namespace lio
