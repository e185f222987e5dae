// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/shift_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lio {
namespace {

constexpr float kReach_m = 60.f;  // of the view, to each side
constexpr float kColumn_m = 0.5f;
constexpr float kMinHeight_m = 0.4f;  // of a column's points above each other
constexpr float kCell_m = 0.25f;      // of shifts, and of how near is near
constexpr int kSide = 2 * static_cast<int>(kReach_m / kCell_m);
constexpr int kMaxShift = 24;     // cells: 6 m between scans, 60 m/s at 10 Hz
constexpr int kPeakRadius = 4;    // cells: what is farther from the best shift must fit worse ...
constexpr double kClearly = 1.1;  // ... by this factor
constexpr int kMinPlaces = 30;

struct Column {
  float low = 0.f;
  float high = 0.f;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int num = 0;
};

int CellOf(float coordinate) {
  return static_cast<int>(std::floor((coordinate + kReach_m) / kCell_m));
}

bool IsInside(int x, int y) {
  return x >= 0 && y >= 0 && x < kSide && y < kSide;
}

std::size_t IndexOf(int x, int y) {
  return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
}

}  // namespace

UprightView::UprightView(std::span<const Eigen::Vector3f> points)
    : near_(static_cast<std::size_t>(kSide) * kSide, 0) {
  std::map<std::pair<int, int>, Column> columns;  // ordered: the result depends on points alone
  for (const Eigen::Vector3f& point : points) {
    if (point.head<2>().cwiseAbs().maxCoeff() >= kReach_m) continue;
    const std::pair at(static_cast<int>(std::floor(point.x() / kColumn_m)),
                       static_cast<int>(std::floor(point.y() / kColumn_m)));
    Column& column = columns.try_emplace(at, Column{point.z(), point.z()}).first->second;
    column.low = std::min(column.low, point.z());
    column.high = std::max(column.high, point.z());
    column.sum += point.head<2>();
    ++column.num;
  }
  for (const auto& [at, column] : columns) {
    if (column.high - column.low < kMinHeight_m) continue;
    const Eigen::Vector2f place = column.sum / static_cast<float>(column.num);
    places_.push_back(place);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = CellOf(place.x()) + dx;
        const int y = CellOf(place.y()) + dy;
        if (IsInside(x, y)) near_[IndexOf(x, y)] = 1;
      }
    }
  }
}

bool UprightView::IsNear(const Eigen::Vector2f& place) const {
  const int x = CellOf(place.x());
  const int y = CellOf(place.y());
  return IsInside(x, y) && near_[IndexOf(x, y)] != 0;
}

std::optional<Eigen::Vector2f> FindShift(const UprightView& before, const UprightView& after) {
  if (after.places().size() < kMinPlaces || before.places().size() < kMinPlaces) return {};
  constexpr int kShifts = 2 * kMaxShift + 1;
  std::vector<int> scores;
  scores.reserve(kShifts * kShifts);
  for (int y = -kMaxShift; y <= kMaxShift; ++y) {
    for (int x = -kMaxShift; x <= kMaxShift; ++x) {
      const Eigen::Vector2f shift(kCell_m * static_cast<float>(x), kCell_m * static_cast<float>(y));
      const auto fits = [&](const Eigen::Vector2f& place) { return before.IsNear(place + shift); };
      scores.push_back(
          static_cast<int>(std::count_if(after.places().begin(), after.places().end(), fits)));
    }
  }
  const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
  const int best_x = static_cast<int>(best % kShifts);
  const int best_y = static_cast<int>(best / kShifts);
  int rival = 0;
  for (int i = 0; i < kShifts * kShifts; ++i) {
    const int distance = std::max(std::abs(i % kShifts - best_x), std::abs(i / kShifts - best_y));
    if (distance > kPeakRadius) rival = std::max(rival, scores[static_cast<std::size_t>(i)]);
  }
  const int peak = scores[static_cast<std::size_t>(best)];
  if (static_cast<double>(peak) < kClearly * rival) return {};
  return kCell_m * Eigen::Vector2f(static_cast<float>(best_x - kMaxShift),
                                   static_cast<float>(best_y - kMaxShift));
}

}  // namespace lio
