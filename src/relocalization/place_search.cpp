// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lio/relocalization/parameters.hpp"
#include "relocalization/planar_grid.hpp"

namespace lio {
namespace {

constexpr PlaceSearchParameters kPlace = kRelocalization.place;

struct ScoredPose {
  PlanarPose pose;
  int score = 0;
};

int NumSteps(float range, float step) {
  return static_cast<int>(std::ceil(range / step));
}

PlanarGrid GridAround(const PlanarPose& middle, const PlanarRange& range, float step_m,
                      float step_rad) {
  return {middle,
          NumSteps(range.shift_m.x(), step_m),
          NumSteps(range.shift_m.y(), step_m),
          NumSteps(range.turn_rad, step_rad),
          step_m,
          step_rad};
}

bool IsBetter(const ScoredPose& a, const ScoredPose& b) {
  return a.score > b.score;
}

// Holds the best of all so far, best first; among equal ones those that came first stay.
class Best {
 public:
  explicit Best(std::size_t max) : max_(max) {}
  void Take(const ScoredPose& scored) {
    if (best_.size() == max_ && scored.score <= best_.back().score) return;
    best_.insert(std::upper_bound(best_.begin(), best_.end(), scored, IsBetter), scored);
    if (best_.size() > max_) best_.pop_back();
  }
  const std::vector<ScoredPose>& all() const { return best_; }

 private:
  std::size_t max_;
  std::vector<ScoredPose> best_;
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
  ForEachPose(SpreadEvenly(later.structures(), kPlace.max_coarse_structures),
              GridAround(middle, range, kPlace.coarse_step_m, kPlace.coarse_step_rad),
              [&](const auto& turned, const PlanarPose& pose) {
                rough.Take({pose, earlier.NumRoughlyNear(turned, pose.shift_m)});
              });
  Best fine(kPlace.max_refined);
  const PlanarRange around{Eigen::Vector2f::Constant(0.5f * kPlace.coarse_step_m),
                           0.5f * kPlace.coarse_step_rad};
  for (const ScoredPose& scored : rough.all()) {
    Best one(1);
    ForEachPose(later.structures(),
                GridAround(scored.pose, around, kPlace.fine_step_m, kPlace.fine_step_rad),
                [&](const auto& turned, const PlanarPose& pose) {
                  one.Take({pose, earlier.NumNear(turned, pose.shift_m)});
                });
    fine.Take(one.all().front());
  }
  std::vector<PlanarPose> found;
  for (const ScoredPose& scored : fine.all()) {
    const auto is_same = [&](const PlanarPose& other) { return IsSame(scored.pose, other); };
    if (std::any_of(found.begin(), found.end(), is_same)) continue;
    found.push_back(scored.pose);
    if (found.size() == kPlace.max_found) break;
  }
  return found;
}

}  // namespace lio
