// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/own_vehicle_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

// These are whole numbers of cells: 2 deg of azimuth and of elevation.
constexpr int kNumAzimuths = 180;
constexpr int kNumElevations = 90;
constexpr float kFollowed_m = 3.5f;  // Chosen: a metre beyond the farthest vehicle.
// The vehicle itself is seen in nearly every sweep, at one range; what passes by is not. The spread
// is that of the means of sweeps, as a share of the range: as the lidar sways in its lane, all
// ranges to a wall alongside change by one share. A vehicle's own change by 6 mm
// (docs/experiments/verdict.md).
constexpr double kSteadyShare = 0.9;
constexpr double kSteadyStd = 0.05;
// Surfaces are followed through directions that have near returns in this share of the sweeps: as a
// body turns in its lane, only the nearest part of a wall is steady.
constexpr double kFollowedShare = 0.5;
constexpr int kFewestSweeps = 20;
constexpr int kFewestCells = 6;
constexpr double kFullRing = 0.6;  // share of all azimuths at one elevation: a plain floor, too
constexpr double kMargin_m = 0.05;
// Neighbouring directions see one surface if their ranges differ by less than this share. Chosen: a
// wall 1.2 m away, seen at 3.5 m, is 10 % farther 2 deg on.
constexpr float kOneSurface = 0.15f;

int CellOf(const LidarPoint& point) {
  const double azimuth = std::atan2(point.y_m, point.x_m) * kDegPerRad + 180.0;
  const double elevation =
      std::atan2(point.z_m, std::hypot(point.x_m, point.y_m)) * kDegPerRad + 90.0;
  const int column = std::min(static_cast<int>(azimuth / 2.0), kNumAzimuths - 1);
  const int row = std::min(static_cast<int>(elevation / 2.0), kNumElevations - 1);
  return row * kNumAzimuths + column;
}

Vector3 PlaceOf(int cell, double range_m) {
  const int column = cell % kNumAzimuths;
  const int row = cell / kNumAzimuths;
  const double azimuth = (2.0 * column + 1.0 - 180.0) / kDegPerRad;
  const double elevation = (2.0 * row + 1.0 - 90.0) / kDegPerRad;
  const double flat_m = range_m * std::cos(elevation);
  return {flat_m * std::cos(azimuth), flat_m * std::sin(azimuth), range_m * std::sin(elevation)};
}

// Returns the four directions beside a cell; -1 beyond the lowest and the highest.
std::array<int, 4> Beside(int cell) {
  const int column = cell % kNumAzimuths;
  const int row_begin = cell - column;
  return {row_begin + (column + 1) % kNumAzimuths,
          row_begin + (column + kNumAzimuths - 1) % kNumAzimuths,
          cell >= kNumAzimuths ? cell - kNumAzimuths : -1,
          cell < (kNumElevations - 1) * kNumAzimuths ? cell + kNumAzimuths : -1};
}

float& At(std::vector<float>& ranges_m, int cell) {
  return ranges_m[static_cast<std::size_t>(cell)];
}

// Takes the surface that a cell is part of out of the ranges, and returns its cells with theirs.
std::vector<std::pair<int, float>> TakeSurface(std::vector<float>& ranges_m, int first) {
  std::vector<std::pair<int, float>> surface = {{first, std::exchange(At(ranges_m, first), 0.f)}};
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto [cell, range_m] = surface[i];
    for (const int next : Beside(cell)) {
      if (next < 0 || At(ranges_m, next) == 0.f) continue;
      if (std::abs(At(ranges_m, next) - range_m) > kOneSurface * range_m) continue;
      surface.emplace_back(next, std::exchange(At(ranges_m, next), 0.f));
    }
  }
  return surface;
}

// Forgets the surfaces that reach farther than a vehicle does. Ranges that are zero are none.
void RemoveFarSurfaces(std::vector<float>& ranges_m) {
  std::vector<float> left_m = ranges_m;
  for (int first = 0; first < static_cast<int>(ranges_m.size()); ++first) {
    if (At(left_m, first) == 0.f) continue;
    const auto surface = TakeSurface(left_m, first);
    const bool is_far = std::ranges::any_of(surface, [](const std::pair<int, float>& part) {
      return part.second > OwnVehicleFinder::kFarthest_m;
    });
    if (!is_far) continue;
    for (const auto& [cell, range_m] : surface) At(ranges_m, cell) = 0.f;
  }
}

// Forgets the rings of a floor.
void RemoveFullRings(std::vector<float>& ranges_m) {
  for (auto row = ranges_m.begin(); row != ranges_m.end(); row += kNumAzimuths) {
    const auto num_none = std::count(row, row + kNumAzimuths, 0.f);
    if (kNumAzimuths - static_cast<double>(num_none) > kFullRing * kNumAzimuths) {
      std::fill(row, row + kNumAzimuths, 0.f);
    }
  }
}

}  // namespace

OwnVehicleFinder::OwnVehicleFinder(const LidarRig& rig)
    : rig_(rig), cells_(std::size_t{kNumAzimuths} * kNumElevations) {}

void OwnVehicleFinder::BeginSweep() {
  ++num_sweeps_;
}

void OwnVehicleFinder::Add(const LidarPoint& point) {
  const Vector3 p(point.x_m, point.y_m, point.z_m);
  const double range_m = p.norm();
  if (!(range_m < kFollowed_m) || range_m < rig_.min_range_m) return;
  if (rig_.own_vehicle_box && rig_.own_vehicle_box->Contains(p)) return;
  Cell& cell = cells_[static_cast<std::size_t>(CellOf(point))];
  if (cell.last_sweep != num_sweeps_) {
    if (cell.num_points > 0) {
      const double mean_m = cell.sum_m / cell.num_points;
      cell.means_m += mean_m;
      cell.means_sq_m2 += mean_m * mean_m;
    }
    cell.sum_m = 0.0;
    cell.num_points = 0;
    ++cell.num_sweeps;
  }
  cell.last_sweep = num_sweeps_;
  cell.sum_m += range_m;
  ++cell.num_points;
}

bool OwnVehicleFinder::IsSteady(const Cell& cell) const {
  if (cell.num_sweeps < kSteadyShare * num_sweeps_) return false;
  const double mean_m = cell.Mean_m();
  const double std_m = kSteadyStd * mean_m;
  return cell.means_sq_m2 / (cell.num_sweeps - 1) - mean_m * mean_m < std_m * std_m;
}

// Returns the mean range in each direction that surfaces are followed through, zero in the others.
std::vector<float> OwnVehicleFinder::FollowedRanges() const {
  std::vector<float> ranges_m(cells_.size(), 0.f);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (cell.num_sweeps < kFollowedShare * num_sweeps_) continue;
    ranges_m[i] = static_cast<float>(cell.Mean_m());
  }
  return ranges_m;
}

std::optional<OwnVehicleFinder::Found> OwnVehicleFinder::Find() const {
  if (num_sweeps_ < kFewestSweeps) return std::nullopt;
  std::vector<float> ranges_m = FollowedRanges();
  RemoveFarSurfaces(ranges_m);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!IsSteady(cells_[i])) ranges_m[i] = 0.f;
  }
  RemoveFullRings(ranges_m);
  Found found;
  found.box = {Vector3::Constant(kFarthest_m), Vector3::Constant(-kFarthest_m)};
  for (int cell = 0; cell < static_cast<int>(ranges_m.size()); ++cell) {
    if (At(ranges_m, cell) == 0.f) continue;
    ++found.num_directions;
    const Vector3 place = PlaceOf(cell, At(ranges_m, cell));
    found.box.min_m = found.box.min_m.cwiseMin(place);
    found.box.max_m = found.box.max_m.cwiseMax(place);
  }
  if (found.num_directions < kFewestCells) return std::nullopt;
  found.box.min_m.array() -= kMargin_m;
  found.box.max_m.array() += kMargin_m;
  return found;
}

}  // namespace lio
