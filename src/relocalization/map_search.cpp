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
  return std::tie(a.score, b.level, b.turn, b.z, b.y, b.x) <
         std::tie(b.score, a.level, a.turn, a.z, a.y, a.x);
}

MapSearch::MapSearch(const StructurePyramid& pyramid, std::span<const Eigen::Vector3f> points,
                     const Eigen::Vector3f& centre, const std::optional<Around>& around)
    : pyramid_(&pyramid),
      centre_(centre),
      points_(points.begin(), points.end()),
      around_(around),
      num_points_(static_cast<int>(points.size())),
      num_turns_(static_cast<int>(std::ceil(kWholeTurn_rad / pyramid.scale().step_rad))) {
  cells_.reserve(static_cast<std::size_t>(num_turns_) * points.size());
  for (int turn = 0; turn < num_turns_; ++turn) {
    const float angle_rad =
        static_cast<float>(turn) * kWholeTurn_rad / static_cast<float>(num_turns_);
    const Eigen::Matrix3f rotation =
        Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitZ()).toRotationMatrix();
    for (const Eigen::Vector3f& point : points) {
      const Eigen::Vector3f cell = (rotation * (point - centre)) / pyramid.scale().cell_m;
      cells_.push_back({static_cast<std::int16_t>(std::lround(cell.x())),
                        static_cast<std::int16_t>(std::lround(cell.y())),
                        static_cast<std::int16_t>(std::lround(cell.z()))});
    }
  }
}

float MapSearch::TurnOf(const Node& node) const {
  return std::remainder(
      static_cast<float>(node.turn) * kWholeTurn_rad / static_cast<float>(num_turns_),
      kWholeTurn_rad);
}

PlanarPose MapSearch::PoseAt(const Eigen::Vector2f& at, float turn_rad) const {
  return {at - Eigen::Rotation2Df(turn_rad) * centre_.head<2>(), turn_rad};
}

Eigen::Vector3f MapSearch::CentreAt(const PlanarPose& pose, float height_m) const {
  const Eigen::Vector2f at = Eigen::Rotation2Df(pose.turn_rad) * centre_.head<2>() + pose.shift_m;
  return {at.x(), at.y(), centre_.z() + height_m};
}

ScoredPlace MapSearch::PlaceOf(const Node& node) const {
  const Eigen::Vector3f at = pyramid_->CentreOf(node.cell());
  return {PoseAt(at.head<2>(), TurnOf(node)), at.z() - centre_.z(), node.score};
}

Eigen::Vector3f MapSearch::WidthOf(const Node& node) const {
  const float width_m = pyramid_->scale().cell_m * static_cast<float>((1 << node.level) - 1);
  return {width_m, width_m, pyramid_->is_flat() ? 0.f : width_m};
}

int MapSearch::NumOnMap(const Node& node, int least) {
  const auto num = static_cast<std::size_t>(num_points_);
  const auto* cells = cells_.data() + static_cast<std::size_t>(node.turn) * num;
  int num_misses_left = num_points_ - least;
  std::size_t i = 0;
  for (; i < num && num_misses_left >= 0; ++i) {
    const Eigen::Vector3i cell(node.x + cells[i][0], node.y + cells[i][1], node.z + cells[i][2]);
    if (!pyramid_->MayStand(node.level, cell)) --num_misses_left;
  }
  lookups_left_ -= static_cast<std::int64_t>(i);
  return least + num_misses_left;
}

int MapSearch::MinScore() const {
  const double least = kSearch.min_share * num_points_;
  const double of_best = places_.empty() ? 0.0 : kSearch.min_score_ratio * places_.front().score;
  return static_cast<int>(std::ceil(std::max(least, of_best)));
}

// Has the cube a place in the range around the guess?
bool MapSearch::IsInRange(const Node& node) const {
  if (!around_) return true;
  const PlanarRange& range = around_->range;
  if (TurnBetween(TurnOf(node), around_->middle.turn_rad) > range.turn_rad) return false;
  const Eigen::Vector3f from_wanted =
      pyramid_->CentreOf(node.cell()) - CentreAt(around_->middle, around_->height_m);
  const float up_m =
      pyramid_->is_flat() ? std::numeric_limits<float>::infinity() : around_->range_up_m;
  const Eigen::Vector3f range_m(range.shift_m.x(), range.shift_m.y(), up_m);
  return (from_wanted.array() <= range_m.array()).all() &&
         (-from_wanted.array() <= (range_m + WidthOf(node)).array()).all();
}

// Is the whole cube so near to a place that was found that it is the same?
bool MapSearch::IsTaken(const Node& node) const {
  const Eigen::Vector3f at = pyramid_->CentreOf(node.cell());
  const float turn_rad = TurnOf(node);
  return std::any_of(places_.begin(), places_.end(), [&](const ScoredPlace& place) {
    const Eigen::Vector3f low = at - CentreAt(place.pose, place.height_m);
    const Eigen::Vector3f far = low.cwiseAbs().cwiseMax((low + WidthOf(node)).cwiseAbs());
    return far.norm() < pyramid_->scale().same_m &&
           TurnBetween(turn_rad, place.pose.turn_rad) < kRelocalization.place.same_rad;
  });
}

void MapSearch::Push(Node node) {
  if ((node.cell().array() >= pyramid_->size().array()).any()) return;
  if (!IsInRange(node) || IsTaken(node)) return;
  const int least = MinScore();
  node.score = NumOnMap(node, least);
  if (node.score >= least && nodes_.size() < kSearch.max_nodes) nodes_.push(node);
}

void MapSearch::AddRoots() {
  const auto level = static_cast<std::int16_t>(pyramid_->scale().num_levels - 1);
  const auto turn = static_cast<std::int16_t>(next_root_turn_++);
  const int step = 1 << level;
  for (int z = 0; z < pyramid_->size().z(); z += step) {
    for (int y = 0; y < pyramid_->size().y(); y += step) {
      for (int x = 0; x < pyramid_->size().x(); x += step) {
        Push({0, static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
              static_cast<std::int16_t>(z), turn, level});
      }
    }
  }
}

void MapSearch::Expand(const Node& node) {
  const auto level = static_cast<std::int16_t>(node.level - 1);
  const int half = 1 << level;
  const int num_layers = pyramid_->is_flat() ? 1 : 2;
  for (int z = 0; z < num_layers; ++z) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 2; ++x) {
        Push({0, static_cast<std::int16_t>(node.x + x * half),
              static_cast<std::int16_t>(node.y + y * half),
              static_cast<std::int16_t>(node.z + z * half), node.turn, level});
      }
    }
  }
}

int MapSearch::NumExactlyOnMap(const std::vector<Eigen::Vector2f>& turned,
                               const Eigen::Vector2f& shift) const {
  int num = 0;
  for (const Eigen::Vector2f& thing : turned) {
    const Eigen::Vector2f at = thing + shift;
    num += pyramid_->Stands(pyramid_->CellOf({at.x(), at.y(), 0.f})) ? 1 : 0;
  }
  return num;
}

// Seen from above, a score is the same over some cells and turns: the middle of the poses where
// most things lie in the very cells of things.
PlanarPose MapSearch::Refined(const PlanarPose& pose) {
  constexpr PlaceSearchParameters kPlace = kRelocalization.place;
  constexpr int kSteps = kSearch.num_refine_steps;
  std::vector<Eigen::Vector2f> centred;
  for (const Eigen::Vector3f& thing : points_) centred.emplace_back((thing - centre_).head<2>());
  const Eigen::Vector2f at = CentreAt(pose, 0.f).head<2>();
  const PlanarGrid grid{{at, pose.turn_rad}, kSteps, kSteps, kSteps, kPlace.fine_step_m,
                        kPlace.fine_step_rad};
  MeanOfBest best;
  ForEachPose(centred, grid, [&](const auto& turned, const PlanarPose& tried) {
    best.Add(NumExactlyOnMap(turned, tried.shift_m),
             {tried.shift_m.x(), tried.shift_m.y(), tried.turn_rad});
  });
  lookups_left_ -= (2 * kSteps + 1) * (2 * kSteps + 1) * (2 * kSteps + 1) * num_points_;
  const Eigen::Vector3f mean = best.Mean();
  return PoseAt(mean.head<2>(), mean.z());
}

bool MapSearch::GoOn(std::int64_t max_lookups) {
  if (num_points_ == 0) return true;
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
      continue;
    }
    ScoredPlace place = PlaceOf(node);
    if (pyramid_->is_flat()) place.pose = Refined(place.pose);
    places_.push_back(place);
  }
  return true;
}

}  // namespace lio
