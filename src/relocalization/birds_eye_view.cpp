// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_view.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr BirdsEyeViewParameters kView = kRelocalization.view;
constexpr int kSide = 2 * static_cast<int>(kView.half_width_m / kView.cell_m);  // in cells
constexpr int kRoughSide = kSide / kView.coarse_cell;

struct Column {
  float low = 0.f;
  float high = 0.f;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int num = 0;
};

// A search looks at millions of points, so coordinates are plain numbers here.
bool IsInView(float x, float y) {
  return std::abs(x) < kView.half_width_m && std::abs(y) < kView.half_width_m;
}

// Returns the cell of a coordinate that is in view; the conversion rounds down, since no sum is
// negative.
int CellOf(float coordinate) {
  return static_cast<int>((coordinate + kView.half_width_m) / kView.cell_m);
}

bool IsInside(int x, int y, int side) {
  return x >= 0 && y >= 0 && x < side && y < side;
}

std::size_t IndexOf(int x, int y, int side) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

// Marks the cell and its eight neighbours.
void MarkAround(int at_x, int at_y, int side, std::vector<std::uint8_t>& cells) {
  for (int y = at_y - 1; y <= at_y + 1; ++y) {
    for (int x = at_x - 1; x <= at_x + 1; ++x) {
      if (IsInside(x, y, side)) cells[IndexOf(x, y, side)] = 1;
    }
  }
}

// They are ordered, so that the result depends on the points alone.
std::map<std::pair<int, int>, Column> ColumnsOf(std::span<const Eigen::Vector3f> points) {
  std::map<std::pair<int, int>, Column> columns;
  for (const Eigen::Vector3f& point : points) {
    if (!IsInView(point.x(), point.y())) continue;
    const std::pair at(static_cast<int>(std::floor(point.x() / kView.column_m)),
                       static_cast<int>(std::floor(point.y() / kView.column_m)));
    Column& column = columns.try_emplace(at, Column{point.z(), point.z()}).first->second;
    column.low = std::min(column.low, point.z());
    column.high = std::max(column.high, point.z());
    column.sum += point.head<2>();
    ++column.num;
  }
  return columns;
}

// Counts how many of the structures, moved by `shift`, satisfy the predicate of x and y.
template <typename Predicate>
int CountShifted(std::span<const Eigen::Vector2f> structures, const Eigen::Vector2f& shift,
                 Predicate is_counted) {
  const float shift_x = shift.x();
  const float shift_y = shift.y();
  int num = 0;
  for (const Eigen::Vector2f& structure : structures) {
    const float* const xy = structure.data();
    num += is_counted(xy[0] + shift_x, xy[1] + shift_y) ? 1 : 0;
  }
  return num;
}

}  // namespace

BirdsEyeView::BirdsEyeView(std::span<const Eigen::Vector3f> points)
    : BirdsEyeView(points, kView.min_height_m) {}

BirdsEyeView::BirdsEyeView(std::span<const Eigen::Vector3f> points, float min_height_m)
    : near_(static_cast<std::size_t>(kSide) * kSide, 0),
      roughly_near_(static_cast<std::size_t>(kRoughSide) * kRoughSide, 0) {
  std::vector<Eigen::Vector2f> structures;
  for (const auto& [at, column] : ColumnsOf(points)) {
    if (column.high - column.low < min_height_m) continue;
    const Eigen::Vector2f structure = column.sum / static_cast<float>(column.num);
    structures.push_back(structure);
    const int x = CellOf(structure.x());
    const int y = CellOf(structure.y());
    MarkAround(x, y, kSide, near_);
    MarkAround(x / kView.coarse_cell, y / kView.coarse_cell, kRoughSide, roughly_near_);
  }
  std::vector<Eigen::Vector2f> off_lines;
  for (const Eigen::Vector2f& structure : structures) {
    if (!IsOnLine(structure)) off_lines.push_back(structure);
  }
  structures_ = SpreadEvenly(off_lines.size() < kView.min_off_lines ? structures : off_lines,
                             kView.max_structures);
}

inline bool BirdsEyeView::IsNear(float x, float y) const {
  if (!IsInView(x, y)) return false;
  const int column = CellOf(x);
  const int row = CellOf(y);
  return IsInside(column, row, kSide) && near_[IndexOf(column, row, kSide)] != 0;
}

inline bool BirdsEyeView::IsRoughlyNear(float x, float y) const {
  if (!IsInView(x, y)) return false;
  const int column = CellOf(x) / kView.coarse_cell;
  const int row = CellOf(y) / kView.coarse_cell;
  return IsInside(column, row, kRoughSide) && roughly_near_[IndexOf(column, row, kRoughSide)] != 0;
}

bool BirdsEyeView::IsOnLine(const Eigen::Vector2f& structure) const {
  for (int i = 0; i < kView.num_line_directions; ++i) {
    const float angle_rad =
        static_cast<float>(i) * std::numbers::pi_v<float> / kView.num_line_directions;
    const Eigen::Vector2f metre(std::cos(angle_rad), std::sin(angle_rad));
    const auto is_near = [&](int distance_m) {
      const Eigen::Vector2f at = structure + distance_m * metre;
      return IsNear(at.x(), at.y());
    };
    int half_length_m = 0;
    while (half_length_m < kView.line_half_length_m && is_near(half_length_m + 1) &&
           is_near(-half_length_m - 1)) {
      ++half_length_m;
    }
    if (half_length_m == kView.line_half_length_m) return true;
  }
  return false;
}

int BirdsEyeView::NumNear(std::span<const Eigen::Vector2f> structures,
                          const Eigen::Vector2f& shift) const {
  return CountShifted(structures, shift, [this](float x, float y) { return IsNear(x, y); });
}

int BirdsEyeView::NumRoughlyNear(std::span<const Eigen::Vector2f> structures,
                                 const Eigen::Vector2f& shift) const {
  return CountShifted(structures, shift, [this](float x, float y) { return IsRoughlyNear(x, y); });
}

bool BirdsEyeView::HasEnoughStructures() const {
  return structures_.size() >= kView.min_structures;
}

std::vector<Eigen::Vector2f> SpreadEvenly(const std::vector<Eigen::Vector2f>& structures,
                                          std::size_t max) {
  const std::size_t num = std::min(structures.size(), max);
  std::vector<Eigen::Vector2f> chosen;
  for (std::size_t i = 0; i < num; ++i) chosen.push_back(structures[i * structures.size() / num]);
  return chosen;
}

}  // namespace lio
