// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lio {
namespace {

// What is sought roughly may be off by half a step of each, at the ends of the view by a metre.
constexpr float kRoughStep_m = 1.f;
constexpr float kRoughStep_rad = 0.035f;
constexpr float kFineStep_m = 0.25f;
constexpr float kFineStep_rad = 0.00875f;
constexpr std::size_t kMaxRoughPlaces = 60;
constexpr std::size_t kMaxRefined = 100;
constexpr std::size_t kMaxFound = 12;
// Two poses nearer than this are the same.
constexpr float kSame_m = 2.f;
constexpr float kSame_rad = 0.1f;

struct Scored {
  FlatPose pose;
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
  FlatPose middle;
  FlatRange range;
  float step_m = 0.f;
  float step_rad = 0.f;
};

// Calls `take` with each shift of a grid and the number of turned places that fit there.
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

// The same with each pose of a grid.
template <class NumNear, class Take>
void ScoreGrid(const std::vector<Eigen::Vector2f>& places, const Grid& grid,
               const NumNear& num_near, const Take& take) {
  const int num_turns = NumSteps(grid.range.turn_rad, grid.step_rad);
  std::vector<Eigen::Vector2f> turned(places.size());
  for (int k = -num_turns; k <= num_turns; ++k) {
    const float turn_rad = grid.middle.turn_rad + static_cast<float>(k) * grid.step_rad;
    const Eigen::Matrix2f turn = TurnBy(turn_rad);
    std::transform(places.begin(), places.end(), turned.begin(),
                   [&](const Eigen::Vector2f& place) { return turn * place; });
    ScoreShifts(turned, turn_rad, grid, num_near, take);
  }
}

bool IsBetter(const Scored& a, const Scored& b) {
  return a.score > b.score;
}

// The best of all so far, best first; of equal ones those that came first.
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

bool IsSame(const FlatPose& a, const FlatPose& b) {
  const float turn = std::remainder(a.turn_rad - b.turn_rad, 2.f * std::numbers::pi_v<float>);
  return (a.shift_m - b.shift_m).norm() < kSame_m && std::abs(turn) < kSame_rad;
}

}  // namespace

std::vector<FlatPose> FindPlaces(const BirdsEyeView& earlier, const BirdsEyeView& later,
                                 const FlatPose& middle, const FlatRange& range) {
  if (!earlier.SaysEnough() || !later.SaysEnough()) return {};
  Best rough(kMaxRefined);
  ScoreGrid(
      EvenlyChosen(later.places(), kMaxRoughPlaces),
      Grid{middle, range, kRoughStep_m, kRoughStep_rad},
      [&](const auto& places, const auto& shift) { return earlier.NumRoughlyNear(places, shift); },
      [&](const Scored& scored) { rough.Take(scored); });
  Best fine(kMaxRefined);
  const FlatRange around{Eigen::Vector2f::Constant(0.5f * kRoughStep_m), 0.5f * kRoughStep_rad};
  for (const Scored& scored : rough.all()) {
    Best one(1);
    ScoreGrid(
        later.places(), Grid{scored.pose, around, kFineStep_m, kFineStep_rad},
        [&](const auto& places, const auto& shift) { return earlier.NumNear(places, shift); },
        [&](const Scored& finer) { one.Take(finer); });
    fine.Take(one.all().front());
  }
  std::vector<FlatPose> found;
  for (const Scored& scored : fine.all()) {
    const auto is_same = [&](const FlatPose& other) { return IsSame(scored.pose, other); };
    if (std::any_of(found.begin(), found.end(), is_same)) continue;
    found.push_back(scored.pose);
    if (found.size() == kMaxFound) break;
  }
  return found;
}

}  // namespace lio
