// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_view.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace lio {
namespace {

constexpr float kReach_m = 60.f;  // of the view, to each side
constexpr float kColumn_m = 0.5f;
constexpr float kMinHeight_m = 0.4f;  // of a column's points above each other
constexpr float kCell_m = 0.25f;      // of how near is near
constexpr int kSide = 2 * static_cast<int>(kReach_m / kCell_m);
constexpr int kRoughCell = 4;  // in cells
constexpr int kRoughSide = kSide / kRoughCell;
constexpr std::size_t kMinPlaces = 20;
constexpr std::size_t kMaxPlaces = 300;
// What is part of a line, a wall or a rail, says nothing of the way along it.
constexpr int kLineReach_m = 3;  // each way
constexpr int kNumDirections = 24;
constexpr std::size_t kMinAlone = 40;  // else lines must do, too

struct Column {
  float low = 0.f;
  float high = 0.f;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int num = 0;
};

bool IsInView(const Eigen::Vector2f& place) {
  return place.cwiseAbs().maxCoeff() < kReach_m;
}

// Of a coordinate in view.
int CellOf(float coordinate) {
  return static_cast<int>(std::floor((coordinate + kReach_m) / kCell_m));
}

bool IsInside(int x, int y, int side) {
  return x >= 0 && y >= 0 && x < side && y < side;
}

std::size_t IndexOf(int x, int y, int side) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

// The cell and its eight neighbours.
void MarkAround(int at_x, int at_y, int side, std::vector<std::uint8_t>& cells) {
  for (int y = at_y - 1; y <= at_y + 1; ++y) {
    for (int x = at_x - 1; x <= at_x + 1; ++x) {
      if (IsInside(x, y, side)) cells[IndexOf(x, y, side)] = 1;
    }
  }
}

// Ordered, so that the result depends on points alone.
std::map<std::pair<int, int>, Column> ColumnsOf(std::span<const Eigen::Vector3f> points) {
  std::map<std::pair<int, int>, Column> columns;
  for (const Eigen::Vector3f& point : points) {
    if (!IsInView(point.head<2>())) continue;
    const std::pair at(static_cast<int>(std::floor(point.x() / kColumn_m)),
                       static_cast<int>(std::floor(point.y() / kColumn_m)));
    Column& column = columns.try_emplace(at, Column{point.z(), point.z()}).first->second;
    column.low = std::min(column.low, point.z());
    column.high = std::max(column.high, point.z());
    column.sum += point.head<2>();
    ++column.num;
  }
  return columns;
}

}  // namespace

BirdsEyeView::BirdsEyeView(std::span<const Eigen::Vector3f> points)
    : near_(static_cast<std::size_t>(kSide) * kSide, 0),
      roughly_near_(static_cast<std::size_t>(kRoughSide) * kRoughSide, 0) {
  std::vector<Eigen::Vector2f> places;
  for (const auto& [at, column] : ColumnsOf(points)) {
    if (column.high - column.low < kMinHeight_m) continue;
    const Eigen::Vector2f place = column.sum / static_cast<float>(column.num);
    places.push_back(place);
    const int x = CellOf(place.x());
    const int y = CellOf(place.y());
    MarkAround(x, y, kSide, near_);
    MarkAround(x / kRoughCell, y / kRoughCell, kRoughSide, roughly_near_);
  }
  std::vector<Eigen::Vector2f> alone;
  for (const Eigen::Vector2f& place : places) {
    if (!IsOnLine(place)) alone.push_back(place);
  }
  places_ = EvenlyChosen(alone.size() < kMinAlone ? places : alone, kMaxPlaces);
}

inline bool BirdsEyeView::IsNear(const Eigen::Vector2f& place) const {
  if (!IsInView(place)) return false;
  const int x = CellOf(place.x());
  const int y = CellOf(place.y());
  return IsInside(x, y, kSide) && near_[IndexOf(x, y, kSide)] != 0;
}

bool BirdsEyeView::IsOnLine(const Eigen::Vector2f& place) const {
  for (int i = 0; i < kNumDirections; ++i) {
    const float angle_rad = static_cast<float>(i) * std::numbers::pi_v<float> / kNumDirections;
    const Eigen::Vector2f metre(std::cos(angle_rad), std::sin(angle_rad));
    int reach_m = 0;
    while (reach_m < kLineReach_m && IsNear(place + (reach_m + 1) * metre) &&
           IsNear(place - (reach_m + 1) * metre)) {
      ++reach_m;
    }
    if (reach_m == kLineReach_m) return true;
  }
  return false;
}

int BirdsEyeView::NumNear(std::span<const Eigen::Vector2f> places,
                          const Eigen::Vector2f& shift) const {
  int num = 0;
  for (const Eigen::Vector2f& place : places) num += IsNear(place + shift) ? 1 : 0;
  return num;
}

int BirdsEyeView::NumRoughlyNear(std::span<const Eigen::Vector2f> places,
                                 const Eigen::Vector2f& shift) const {
  int num = 0;
  for (const Eigen::Vector2f& unmoved : places) {
    const Eigen::Vector2f place = unmoved + shift;
    if (!IsInView(place)) continue;
    const int x = CellOf(place.x()) / kRoughCell;
    const int y = CellOf(place.y()) / kRoughCell;
    num += IsInside(x, y, kRoughSide) && roughly_near_[IndexOf(x, y, kRoughSide)] != 0 ? 1 : 0;
  }
  return num;
}

bool BirdsEyeView::SaysEnough() const {
  return places_.size() >= kMinPlaces;
}

std::vector<Eigen::Vector2f> EvenlyChosen(const std::vector<Eigen::Vector2f>& places,
                                          std::size_t max) {
  const std::size_t num = std::min(places.size(), max);
  std::vector<Eigen::Vector2f> chosen;
  for (std::size_t i = 0; i < num; ++i) chosen.push_back(places[i * places.size() / num]);
  return chosen;
}

}  // namespace lio
