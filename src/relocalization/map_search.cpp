// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/map_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "lio/relocalization/parameters.hpp"
#include "relocalization/planar_grid.hpp"

namespace lio {
namespace {

constexpr MapSearchParameters kSearch = kRelocalization.map_search;
constexpr float kWholeTurn_rad = 2.f * std::numbers::pi_v<float>;

float TurnBetween(float a_rad, float b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, kWholeTurn_rad));
}

// Keeps the mean of the poses that score best.
class MeanOfBest {
 public:
  void Add(int score, const Eigen::Vector3f& pose) {
    if (score < best_) return;
    if (score > best_) *this = MeanOfBest(score);
    ++num_;
    sum_ += pose;
  }
  [[nodiscard]] Eigen::Vector3f Mean() const { return sum_ / static_cast<float>(num_); }

  MeanOfBest() = default;

 private:
  explicit MeanOfBest(int score) : best_(score) {}

  int best_ = -1;
  int num_ = 0;
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero();
};

}  // namespace

// This is a total order, so that the search depends on the points alone.
bool MapSearch::IsWorse::operator()(const Node& a, const Node& b) const {
  return std::tie(a.score, b.level, b.turn, b.y, b.x) <
         std::tie(b.score, a.level, a.turn, a.y, a.x);
}

MapSearch::MapSearch(const StructurePyramid& pyramid, std::span<const Eigen::Vector2f> structures,
                     const Eigen::Vector2f& centre, const std::optional<Around>& around)
    : pyramid_(&pyramid),
      centre_(centre),
      structures_(structures.begin(), structures.end()),
      around_(around),
      num_structures_(static_cast<int>(structures.size())),
      num_turns_(static_cast<int>(std::ceil(kWholeTurn_rad / kSearch.step_rad))) {
  cells_.reserve(static_cast<std::size_t>(num_turns_) * structures.size());
  for (int turn = 0; turn < num_turns_; ++turn) {
    const float angle_rad =
        static_cast<float>(turn) * kWholeTurn_rad / static_cast<float>(num_turns_);
    const Eigen::Rotation2Df rotation(angle_rad);
    for (const Eigen::Vector2f& structure : structures) {
      const Eigen::Vector2f cell = (rotation * (structure - centre)) / kSearch.cell_m;
      cells_.push_back({static_cast<std::int16_t>(std::lround(cell.x())),
                        static_cast<std::int16_t>(std::lround(cell.y()))});
    }
  }
}

PlanarPose MapSearch::PoseOf(const Node& node) const {
  const float turn_rad =
      static_cast<float>(node.turn) * kWholeTurn_rad / static_cast<float>(num_turns_);
  const Eigen::Vector2f at = pyramid_->CentreOf({node.x, node.y});
  return {at - Eigen::Rotation2Df(turn_rad) * centre_, std::remainder(turn_rad, kWholeTurn_rad)};
}

int MapSearch::NumOnMap(const Node& node, int least) {
  const auto num = static_cast<std::size_t>(num_structures_);
  const auto* cells = cells_.data() + static_cast<std::size_t>(node.turn) * num;
  int num_misses_left = num_structures_ - least;
  std::size_t i = 0;
  for (; i < num && num_misses_left >= 0; ++i) {
    const Eigen::Vector2i cell(node.x + cells[i][0], node.y + cells[i][1]);
    if (!pyramid_->MayStand(node.level, cell)) --num_misses_left;
  }
  lookups_left_ -= static_cast<std::int64_t>(i);
  return least + num_misses_left;
}

int MapSearch::MinScore() const {
  const double least = kSearch.min_share * num_structures_;
  const double of_best = places_.empty() ? 0.0 : kSearch.min_score_ratio * places_.front().score;
  return static_cast<int>(std::ceil(std::max(least, of_best)));
}

// Has the square a place in the range around the guess?
bool MapSearch::IsInRange(const Node& node) const {
  if (!around_) return true;
  const PlanarPose pose = PoseOf(node);
  const PlanarPose& middle = around_->middle;
  if (TurnBetween(pose.turn_rad, middle.turn_rad) > around_->range.turn_rad) return false;
  const Eigen::Vector2f at = pyramid_->CentreOf({node.x, node.y});
  const Eigen::Vector2f wanted = Eigen::Rotation2Df(middle.turn_rad) * centre_ + middle.shift_m;
  const float width_m = kSearch.cell_m * static_cast<float>((1 << node.level) - 1);
  return ((at - wanted).array() <= around_->range.shift_m.array()).all() &&
         ((wanted - at).array() <= around_->range.shift_m.array() + width_m).all();
}

// Is the whole square so near to a place that was found that it is the same?
bool MapSearch::IsTaken(const Node& node) const {
  constexpr PlaceSearchParameters kPlace = kRelocalization.place;
  const PlanarPose pose = PoseOf(node);
  const float width_m = kSearch.cell_m * static_cast<float>((1 << node.level) - 1);
  const Eigen::Vector2f at = pyramid_->CentreOf({node.x, node.y});
  return std::any_of(places_.begin(), places_.end(), [&](const ScoredPlace& place) {
    const Eigen::Vector2f there =
        Eigen::Rotation2Df(place.pose.turn_rad) * centre_ + place.pose.shift_m;
    const Eigen::Vector2f low = at - there;
    const Eigen::Vector2f far = low.cwiseAbs().cwiseMax((low.array() + width_m).abs().matrix());
    return far.norm() < kPlace.same_m &&
           TurnBetween(pose.turn_rad, place.pose.turn_rad) < kPlace.same_rad;
  });
}

void MapSearch::Push(Node node) {
  if (node.x >= pyramid_->size().x() || node.y >= pyramid_->size().y()) return;
  if (!IsInRange(node) || IsTaken(node)) return;
  const int least = MinScore();
  node.score = NumOnMap(node, least);
  if (node.score >= least && nodes_.size() < kSearch.max_nodes) nodes_.push(node);
}

void MapSearch::AddRoots() {
  const auto level = static_cast<std::int16_t>(kSearch.num_levels - 1);
  const auto turn = static_cast<std::int16_t>(next_root_turn_++);
  const int step = 1 << level;
  for (int y = 0; y < pyramid_->size().y(); y += step) {
    for (int x = 0; x < pyramid_->size().x(); x += step) {
      Push({0, static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), turn, level});
    }
  }
}

void MapSearch::Expand(const Node& node) {
  const auto level = static_cast<std::int16_t>(node.level - 1);
  const auto half = static_cast<std::int16_t>(1 << level);
  for (std::int16_t y = 0; y < 2; ++y) {
    for (std::int16_t x = 0; x < 2; ++x) {
      Push({0, static_cast<std::int16_t>(node.x + x * half),
            static_cast<std::int16_t>(node.y + y * half), node.turn, level});
    }
  }
}

int MapSearch::NumExactlyOnMap(const std::vector<Eigen::Vector2f>& turned,
                               const Eigen::Vector2f& shift) const {
  int num = 0;
  for (const Eigen::Vector2f& structure : turned) {
    num += pyramid_->Stands(pyramid_->CellOf(structure + shift)) ? 1 : 0;
  }
  return num;
}

// A score is the same over some cells and turns: the middle of the poses where most structures lie
// in the very cells of things.
PlanarPose MapSearch::Refined(const PlanarPose& pose) {
  constexpr PlaceSearchParameters kPlace = kRelocalization.place;
  constexpr int kSteps = kSearch.num_refine_steps;
  std::vector<Eigen::Vector2f> centred;
  for (const Eigen::Vector2f& structure : structures_) centred.emplace_back(structure - centre_);
  const Eigen::Vector2f at = Eigen::Rotation2Df(pose.turn_rad) * centre_ + pose.shift_m;
  const PlanarGrid grid{{at, pose.turn_rad}, kSteps, kSteps, kSteps, kPlace.fine_step_m,
                        kPlace.fine_step_rad};
  MeanOfBest best;
  ForEachPose(centred, grid, [&](const auto& turned, const PlanarPose& tried) {
    best.Add(NumExactlyOnMap(turned, tried.shift_m),
             {tried.shift_m.x(), tried.shift_m.y(), tried.turn_rad});
  });
  lookups_left_ -= (2 * kSteps + 1) * (2 * kSteps + 1) * (2 * kSteps + 1) * num_structures_;
  const Eigen::Vector3f mean = best.Mean();
  return {Eigen::Vector2f(mean.head<2>()) - Eigen::Rotation2Df(mean.z()) * centre_, mean.z()};
}

bool MapSearch::GoOn(std::int64_t max_lookups) {
  if (num_structures_ == 0) return true;
  lookups_left_ = max_lookups;
  while (next_root_turn_ < num_turns_) {
    if (lookups_left_ <= 0) return false;
    AddRoots();
  }
  while (!nodes_.empty() && places_.size() < kSearch.max_places) {
    if (lookups_left_ <= 0) return false;
    const Node node = nodes_.top();
    if (node.score < MinScore()) return true;
    nodes_.pop();
    if (IsTaken(node)) continue;
    if (node.level > 0) {
      Expand(node);
    } else {
      places_.push_back({Refined(PoseOf(node)), node.score});
    }
  }
  return true;
}

}  // namespace lio
