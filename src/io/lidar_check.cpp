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

constexpr int kSampleEvery = 5;  // sweeps: half a second
constexpr int kScansForRings = 100;
constexpr std::size_t kMaxShares = 1000;
constexpr double kShortestPath_m = 20.0;
constexpr double kOtherModel_rad = 1.0 / kDegPerRad;  // scatter of beams is a tenth of it
constexpr double kOneTime = 0.2;                      // share of the time between sweeps

}  // namespace

LidarCheck::LidarCheck(const Options& options)
    : rig_(options.rig.lidar), uses_imu_(options.pipeline.use_imu), own_vehicle_(rig_) {}

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
  if (num_scans_ % kSampleEvery == 0) own_vehicle_.BeginSweep();
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
  for (const LidarPoint& point : chunk.points) own_vehicle_.Add(point);
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

std::optional<Cause> LidarCheck::FindOwnVehicle() const {
  const auto found = own_vehicle_.Find();
  if (!found) return std::nullopt;
  const Vector3& low = found->box.min_m;
  const Vector3& high = found->box.max_m;
  return Cause{
      CauseKind::kOwnVehicle, Trust::kYes, 0.0,
      fmt::format("in {} directions of 2 deg there is a return at one range below {:.1f} m "
                  "in nearly every sweep, wherever the vehicle is: it sees itself",
                  found->num_directions, OwnVehicleFinder::kFarthest_m),
      fmt::format("rig:\n  lidar:\n    own_vehicle_box:\n"
                  "      min_m: [{:.2f}, {:.2f}, {:.2f}]\n"
                  "      max_m: [{:.2f}, {:.2f}, {:.2f}]\n",
                  low.x(), low.y(), low.z(), high.x(), high.y(), high.z())};
}

}  // namespace lio
