// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lidar_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/base/angle.hpp"
#include "lio/base/median.hpp"
#include "lio/io/beam_table.hpp"
#include "lio/io/lidar_guess.hpp"

namespace lio {
namespace {

// These are whole numbers of cells: 2 deg of azimuth and of elevation.
constexpr int kNumAzimuths = 180;
constexpr int kNumElevations = 90;
constexpr float kNear_m = 2.5f;  // no farther does a vehicle reach that carries its lidar on top
constexpr int kSampleEvery = 5;  // sweeps: half a second
constexpr int kScansForRings = 100;
constexpr std::size_t kMaxShares = 1000;
// The vehicle itself is seen in nearly every sweep, at one range; what passes by is not.
constexpr double kFixedShare = 0.9;
constexpr double kFixedStd_m = 0.05;
constexpr int kFewestSamples = 20;
constexpr double kShortestPath_m = 20.0;
constexpr int kFewestCells = 6;
constexpr double kFullRing = 0.6;  // share of all azimuths at one elevation: a plain floor, too
constexpr double kMargin_m = 0.05;
constexpr double kOtherModel_rad = 1.0 / kDegPerRad;  // scatter of beams is a tenth of it
constexpr double kOneTime = 0.2;                      // share of the time between sweeps

std::size_t CellOf(const LidarPoint& point) {
  const double azimuth = std::atan2(point.y_m, point.x_m) * kDegPerRad + 180.0;
  const double elevation =
      std::atan2(point.z_m, std::hypot(point.x_m, point.y_m)) * kDegPerRad + 90.0;
  const int column = std::min(static_cast<int>(azimuth / 2.0), kNumAzimuths - 1);
  const int row = std::min(static_cast<int>(elevation / 2.0), kNumElevations - 1);
  return static_cast<std::size_t>(row * kNumAzimuths + column);
}

Vector3 PlaceOf(std::size_t cell, double range_m) {
  const std::size_t column = cell % kNumAzimuths;
  const std::size_t row = cell / kNumAzimuths;
  const double azimuth = (2.0 * static_cast<double>(column) + 1.0 - 180.0) / kDegPerRad;
  const double elevation = (2.0 * static_cast<double>(row) + 1.0 - 90.0) / kDegPerRad;
  const double flat_m = range_m * std::cos(elevation);
  return {flat_m * std::cos(azimuth), flat_m * std::sin(azimuth), range_m * std::sin(elevation)};
}

}  // namespace

LidarCheck::LidarCheck(const Options& options)
    : rig_(options.rig.lidar),
      uses_imu_(options.pipeline.use_imu),
      cells_(std::size_t{kNumAzimuths} * kNumElevations) {}

void LidarCheck::BeginScan(const ScanChunk& chunk) {
  if (scan_begin_ && shares_.size() < kMaxShares) {
    const double period_s = SecondsBetween(*scan_begin_, chunk.stamp);
    constexpr double kLongestPeriod_s = 0.5;
    if (period_s > 0.0 && period_s < kLongestPeriod_s) shares_.push_back(span_s_ / period_s);
  }
  scan_ = chunk.scan_seq;
  scan_begin_ = chunk.stamp;
  span_s_ = 0.0;
  ++num_scans_;
  if (num_scans_ % kSampleEvery == 0) ++num_sampled_;
}

void LidarCheck::Add(const ScanChunk& chunk) {
  if (scan_ != chunk.scan_seq) BeginScan(chunk);
  const double since_begin_s = SecondsBetween(*scan_begin_, chunk.stamp);
  for (const LidarPoint& point : chunk.points) {
    span_s_ = std::max(span_s_, since_begin_s + 1e-9 * point.t_offset_ns);
  }
  if (num_scans_ <= kScansForRings) {
    for (const LidarPoint& point : chunk.points) elevations_.Add(point);
  }
  if (num_scans_ % kSampleEvery != 0) return;
  for (const LidarPoint& point : chunk.points) AddNear(chunk, point);
}

void LidarCheck::AddNear(const ScanChunk& chunk, const LidarPoint& point) {
  const Vector3 p(point.x_m, point.y_m, point.z_m);
  const double range_m = p.norm();
  if (!(range_m < kNear_m) || range_m < rig_.min_range_m) return;
  const auto& box = rig_.own_vehicle_box;
  const bool is_in_box =
      box && (p.array() >= box->min_m.array()).all() && (p.array() <= box->max_m.array()).all();
  if (is_in_box) return;
  Cell& cell = cells_[CellOf(point)];
  if (cell.last_scan != chunk.scan_seq) ++cell.num_scans;
  cell.last_scan = chunk.scan_seq;
  ++cell.num_points;
  cell.sum_m += range_m;
  cell.sum_sq_m2 += range_m * range_m;
}

void LidarCheck::AddTo(Verdict& verdict) const {
  for (Cause& cause : Find(verdict.path_m)) {
    if (std::ranges::count(verdict.causes, cause.kind, &Cause::kind) > 0) continue;
    verdict.trust = std::max(verdict.trust, cause.leaves);
    verdict.causes.push_back(std::move(cause));
  }
}

std::vector<Cause> LidarCheck::Find(double path_m) const {
  std::vector<Cause> causes;
  if (auto cause = FindModel()) causes.push_back(*cause);
  if (auto cause = FindPointTime()) causes.push_back(*cause);
  if (path_m < kShortestPath_m) return causes;
  if (auto cause = FindOwnVehicle()) causes.push_back(*cause);
  return causes;
}

// Nothing but LOAM without rings uses the beams, so that trust stays.
std::optional<Cause> LidarCheck::FindModel() const {
  const std::vector<double> seen = elevations_.Medians();
  const std::vector<double> told = BeamElevations(rig_.model);
  if (seen.empty() || told.empty()) return std::nullopt;
  double worst_rad = 0.0;
  for (std::size_t ring = 0; ring < std::min(seen.size(), told.size()); ++ring) {
    worst_rad = std::max(worst_rad, std::abs(seen[ring] - told[ring]));
  }
  if (seen.size() <= told.size() && worst_rad < kOtherModel_rad) return std::nullopt;
  const LidarGuess guess = GuessLidar(seen, KnownLidars());
  return Cause{
      CauseKind::kLidarModel, Trust::kYes, 0.0,
      fmt::format("the rig says {}, with {} beams; the sweeps have {} rings, which differ "
                  "from its beams by up to {:.1f} deg ({})",
                  rig_.model, told.size(), seen.size(), worst_rad * kDegPerRad, guess.reason),
      fmt::format("rig:\n  lidar:\n    model: {}\n", guess.model)};
}

std::optional<Cause> LidarCheck::FindPointTime() const {
  constexpr std::size_t kFewestShares = 10;
  if (!uses_imu_ || shares_.size() < kFewestShares) return std::nullopt;
  const double share = UpperMedian(shares_);
  if (share > kOneTime) return std::nullopt;
  return Cause{CauseKind::kPointTime, Trust::kDoubtful, 0.0,
               fmt::format("the points of a sweep span {:.1f} % of the time between sweeps: they "
                           "have no times of their own, or in a wrong unit, and the motion within "
                           "a sweep is not taken out",
                           100.0 * share),
               ""};
}

bool LidarCheck::IsFixed(const Cell& cell) const {
  if (cell.num_scans < kFixedShare * num_sampled_) return false;
  const double mean = cell.sum_m / cell.num_points;
  const double variance = cell.sum_sq_m2 / cell.num_points - mean * mean;
  return variance < kFixedStd_m * kFixedStd_m;
}

std::optional<Cause> LidarCheck::FindOwnVehicle() const {
  if (num_sampled_ < kFewestSamples) return std::nullopt;
  int num_fixed = 0;
  Vector3 low = Vector3::Constant(kNear_m), high = -low;
  for (int row = 0; row < kNumElevations; ++row) {
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(row) * kNumAzimuths;
    const auto num = std::count_if(begin, begin + kNumAzimuths,
                                   [this](const Cell& cell) { return IsFixed(cell); });
    if (static_cast<double>(num) > kFullRing * kNumAzimuths) continue;
    for (auto cell = begin; cell != begin + kNumAzimuths; ++cell) {
      if (!IsFixed(*cell)) continue;
      ++num_fixed;
      const auto index = static_cast<std::size_t>(cell - cells_.begin());
      const Vector3 place = PlaceOf(index, cell->sum_m / cell->num_points);
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  }
  if (num_fixed < kFewestCells) return std::nullopt;
  low.array() -= kMargin_m;
  high.array() += kMargin_m;
  return Cause{
      CauseKind::kOwnVehicle, Trust::kYes, 0.0,
      fmt::format("in {} directions of 2 deg there is a return at one range below {:.1f} m "
                  "in nearly every sweep, wherever the vehicle is: it sees itself",
                  num_fixed, kNear_m),
      fmt::format("rig:\n  lidar:\n    own_vehicle_box:\n"
                  "      min_m: [{:.2f}, {:.2f}, {:.2f}]\n"
                  "      max_m: [{:.2f}, {:.2f}, {:.2f}]\n",
                  low.x(), low.y(), low.z(), high.x(), high.y(), high.z())};
}

}  // namespace lio
