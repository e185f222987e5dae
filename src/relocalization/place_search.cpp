// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr PlaceSearchParameters kPlace = kRelocalization.place;

struct Scored {
  PlanarPose pose;
  int score = 0;
};

int NumSteps(float range, float step) {
  return static_cast<int>(std::ceil(range / step));
}

Eigen::Matrix2f TurnBy(float angle_rad) {
  const float c = std::cos(angle_rad);
  const float s = std::sin(angle_rad);
  return (Eigen::Matrix2f() << c, -s, s, c).finished();
}

struct Grid {
  PlanarPose middle;
  PlanarRange range;
  float step_m = 0.f;
  float step_rad = 0.f;
};

// Calls `take` with each shift of a grid and the number of turned structures that agree there.
template <class NumNear, class Take>
void ScoreShifts(const std::vector<Eigen::Vector2f>& turned, float turn_rad, const Grid& grid,
                 const NumNear& num_near, const Take& take) {
  const int num_x = NumSteps(grid.range.shift_m.x(), grid.step_m);
  const int num_y = NumSteps(grid.range.shift_m.y(), grid.step_m);
  for (int y = -num_y; y <= num_y; ++y) {
    for (int x = -num_x; x <= num_x; ++x) {
      const Eigen::Vector2f steps(static_cast<float>(x), static_cast<float>(y));
      const Eigen::Vector2f shift = grid.middle.shift_m + grid.step_m * steps;
      take(Scored{{shift, turn_rad}, num_near(turned, shift)});
    }
  }
}

// Calls `take` with each pose of a grid and the number of structures that agree there.
template <class NumNear, class Take>
void ScoreGrid(const std::vector<Eigen::Vector2f>& structures, const Grid& grid,
               const NumNear& num_near, const Take& take) {
  const int num_turns = NumSteps(grid.range.turn_rad, grid.step_rad);
  std::vector<Eigen::Vector2f> turned(structures.size());
  for (int k = -num_turns; k <= num_turns; ++k) {
    const float turn_rad = grid.middle.turn_rad + static_cast<float>(k) * grid.step_rad;
    const Eigen::Matrix2f turn = TurnBy(turn_rad);
    std::transform(structures.begin(), structures.end(), turned.begin(),
                   [&](const Eigen::Vector2f& structure) { return turn * structure; });
    ScoreShifts(turned, turn_rad, grid, num_near, take);
  }
}

bool IsBetter(const Scored& a, const Scored& b) {
  return a.score > b.score;
}

// The best of all so far, best first; among equal ones those that came first stay.
class Best {
 public:
  explicit Best(std::size_t max) : max_(max) {}
  void Take(const Scored& scored) {
    if (best_.size() == max_ && scored.score <= best_.back().score) return;
    best_.insert(std::upper_bound(best_.begin(), best_.end(), scored, IsBetter), scored);
    if (best_.size() > max_) best_.pop_back();
  }
  const std::vector<Scored>& all() const { return best_; }

 private:
  std::size_t max_;
  std::vector<Scored> best_;
};

bool IsSame(const PlanarPose& a, const PlanarPose& b) {
  const float turn = std::remainder(a.turn_rad - b.turn_rad, 2.f * std::numbers::pi_v<float>);
  return (a.shift_m - b.shift_m).norm() < kPlace.same_m && std::abs(turn) < kPlace.same_rad;
}

}  // namespace

std::vector<PlanarPose> FindPlaces(const BirdsEyeView& earlier, const BirdsEyeView& later,
                                   const PlanarPose& middle, const PlanarRange& range) {
  if (!earlier.HasEnoughStructures() || !later.HasEnoughStructures()) return {};
  Best rough(kPlace.max_refined);
  ScoreGrid(
      SpreadEvenly(later.structures(), kPlace.max_coarse_structures),
      Grid{middle, range, kPlace.coarse_step_m, kPlace.coarse_step_rad},
      [&](const auto& structures, const auto& shift) {
        return earlier.NumRoughlyNear(structures, shift);
      },
      [&](const Scored& scored) { rough.Take(scored); });
  Best fine(kPlace.max_refined);
  const PlanarRange around{Eigen::Vector2f::Constant(0.5f * kPlace.coarse_step_m),
                           0.5f * kPlace.coarse_step_rad};
  for (const Scored& scored : rough.all()) {
    Best one(1);
    ScoreGrid(
        later.structures(), Grid{scored.pose, around, kPlace.fine_step_m, kPlace.fine_step_rad},
        [&](const auto& structures, const auto& shift) {
          return earlier.NumNear(structures, shift);
        },
        [&](const Scored& finer) { one.Take(finer); });
    fine.Take(one.all().front());
  }
  std::vector<PlanarPose> found;
  for (const Scored& scored : fine.all()) {
    const auto is_same = [&](const PlanarPose& other) { return IsSame(scored.pose, other); };
    if (std::any_of(found.begin(), found.end(), is_same)) continue;
    found.push_back(scored.pose);
    if (found.size() == kPlace.max_found) break;
  }
  return found;
}

}  // namespace lio
