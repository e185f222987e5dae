// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/velocity_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr VelocitySearchParameters kVelocity = kRelocalization.velocity;
constexpr int kNumSteps = 2 * kVelocity.max_steps + 1;

Eigen::Vector2f VelocityOf(int x, int y) {
  return kVelocity.step_mps * Eigen::Vector2f(static_cast<float>(x - kVelocity.max_steps),
                                              static_cast<float>(y - kVelocity.max_steps));
}

}  // namespace

void VelocityVotes::Add(Timestamp stamp, BirdsEyeView view) {
  if (!view.HasEnoughStructures()) return;
  Scan scan{stamp, std::move(view)};
  for (const Scan& before : scans_) AddPair(before, scan);
  scans_.push_back(std::move(scan));
}

void VelocityVotes::AddPair(const Scan& before, const Scan& after) {
  scores_.resize(static_cast<std::size_t>(kNumSteps) * kNumSteps, 0);
  const auto dt_s = static_cast<float>(SecondsBetween(before.stamp, after.stamp));
  auto score = scores_.begin();
  for (int y = 0; y < kNumSteps; ++y) {
    for (int x = 0; x < kNumSteps; ++x, ++score) {
      const Eigen::Vector2f shift = dt_s * VelocityOf(x, y);
      *score += before.view.NumNear(after.view.structures(), shift);
    }
  }
}

std::optional<Eigen::Vector2f> VelocityVotes::Find() const {
  if (scans_.size() < 2) return {};
  const auto span_s = static_cast<float>(SecondsBetween(scans_.front().stamp, scans_.back().stamp));
  if (!(span_s > 0.f)) return {};
  const auto best =
      static_cast<int>(std::max_element(scores_.begin(), scores_.end()) - scores_.begin());
  const int best_x = best % kNumSteps;
  const int best_y = best / kNumSteps;
  const int width =
      std::max(1, static_cast<int>(kVelocity.peak_width_m / (span_s * kVelocity.step_mps)));
  const int peak = scores_[static_cast<std::size_t>(best)];
  int rival = 0;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();  // sum over the peak's flat top
  int num = 0;
  for (int i = 0; i < kNumSteps * kNumSteps; ++i) {
    const int x = i % kNumSteps;
    const int y = i / kNumSteps;
    const int score = scores_[static_cast<std::size_t>(i)];
    if (std::max(std::abs(x - best_x), std::abs(y - best_y)) > width) {
      rival = std::max(rival, score);
    } else if (static_cast<double>(score) > kVelocity.flat_top * peak) {
      sum += VelocityOf(x, y);
      ++num;
    }
  }
  if (peak - rival < kVelocity.min_lead * std::sqrt(static_cast<double>(peak))) return {};
  return sum / static_cast<float>(num);
}

std::optional<SpeedRange> VelocityVotes::LikelySpeeds() const {
  if (scores_.empty()) return {};
  const double peak = *std::max_element(scores_.begin(), scores_.end());
  const double least = peak - kVelocity.likely_sigmas * std::sqrt(peak);
  SpeedRange range{std::numeric_limits<double>::max(), 0.0};
  for (int i = 0; i < kNumSteps * kNumSteps; ++i) {
    if (scores_[static_cast<std::size_t>(i)] < least) continue;
    const double mps = static_cast<double>(VelocityOf(i % kNumSteps, i / kNumSteps).norm());
    range.min_mps = std::min(range.min_mps, mps);
    range.max_mps = std::max(range.max_mps, mps);
  }
  return range;
}

void VelocitySearch::Add(Timestamp stamp, std::span<const Eigen::Vector3f> points) {
  of_all_.Add(stamp, BirdsEyeView(points));
  of_buildings_.Add(stamp, BirdsEyeView(points, kVelocity.min_building_height_m));
}

SeenVelocity VelocitySearch::Find() const {
  SeenVelocity seen;
  if (of_buildings_.num_scans() == num_scans()) {
    seen.by_buildings = of_buildings_.LikelySpeeds();
    seen.v_mps = of_buildings_.Find();
    seen.is_of_buildings = seen.v_mps.has_value();
  }
  if (!seen.v_mps) seen.v_mps = of_all_.Find();
  return seen;
}

}  // namespace lio
