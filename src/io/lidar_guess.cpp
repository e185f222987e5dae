// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lidar_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxPointsARing = 400;
constexpr float kMinRange_m = 2.0f;  // nearer, the beams' own offsets from the origin turn them
constexpr std::size_t kMaxRings = 256;
constexpr double kMaxBeamError_rad = 0.35 / kDegPerRad;

constexpr std::array<const char*, 4> kModels = {"vlp16", "hdl32e", "hdl64e", "os1_64"};

double LargestError(std::span<const double> elevations_rad, const BeamTable& table) {
  double largest = 0.0;
  for (std::size_t i = 0; i < elevations_rad.size(); ++i) {
    largest = std::max(largest, std::abs(elevations_rad[i] - table.elevation_rad[i]));
  }
  return largest;
}

}  // namespace

void RingElevations::Add(const LidarPoint& point) {
  if (point.ring >= kMaxRings) return;
  if (point.ring < by_ring_.size() && by_ring_[point.ring].size() >= kMaxPointsARing) return;
  const float horizontal_m = std::hypot(point.x_m, point.y_m);
  if (!(std::hypot(horizontal_m, point.z_m) > kMinRange_m)) return;
  if (by_ring_.size() <= point.ring) by_ring_.resize(std::size_t{point.ring} + 1);
  by_ring_[point.ring].push_back(std::atan2(point.z_m, horizontal_m));
}

std::vector<double> RingElevations::Medians() const {
  std::vector<double> medians;
  for (std::vector<float> ring : by_ring_) {
    if (ring.empty()) return {};
    const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
    std::nth_element(ring.begin(), middle, ring.end());
    medians.push_back(double{*middle});
  }
  if (medians.size() < 2) return {};
  return medians;
}

LidarGuess GuessLidar(std::span<const double> elevations_rad, std::span<const BeamTable> known) {
  LidarGuess guess;
  if (elevations_rad.empty()) {
    guess.reason = "the points carry no rings";
    return guess;
  }
  double smallest = kMaxBeamError_rad;
  for (const BeamTable& table : known) {
    if (table.elevation_rad.size() != elevations_rad.size()) continue;
    const double error = LargestError(elevations_rad, table);
    if (error >= smallest) continue;
    smallest = error;
    guess.model = table.model;
    guess.reason = fmt::format("{} rings, all within {:.2f} deg of this model's beams",
                               elevations_rad.size(), error * kDegPerRad);
  }
  if (guess.reason.empty()) {
    guess.reason = fmt::format("{} rings at elevations of no known model", elevations_rad.size());
  }
  return guess;
}

std::vector<BeamTable> KnownLidars() {
  std::vector<BeamTable> known;
  known.reserve(kModels.size());
  for (const char* model : kModels) known.push_back(LoadBeamTable(model));
  return known;
}

}  // namespace lio
