// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/velocity_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lio {
namespace {

constexpr float kStep_mps = 0.5f;
constexpr int kMaxSteps = 90;  // 45 m/s each way
constexpr int kNumSteps = 2 * kMaxSteps + 1;
constexpr float kPeakWidth_m = 1.f;  // what is farther from the best shift must fit worse ...
constexpr double kClearly = 2.0;     // ... by so many roots of the best score
constexpr double kFlatTop = 0.88;

Eigen::Vector2f VelocityOf(int x, int y) {
  return kStep_mps *
         Eigen::Vector2f(static_cast<float>(x - kMaxSteps), static_cast<float>(y - kMaxSteps));
}

}  // namespace

void VelocitySearch::Add(Timestamp stamp, std::span<const Eigen::Vector3f> points) {
  Scan scan{stamp, BirdsEyeView(points)};
  if (!scan.view.SaysEnough()) return;
  for (const Scan& before : scans_) AddPair(before, scan);
  scans_.push_back(std::move(scan));
}

void VelocitySearch::AddPair(const Scan& before, const Scan& after) {
  scores_.resize(static_cast<std::size_t>(kNumSteps) * kNumSteps, 0);
  const auto dt_s = static_cast<float>(SecondsBetween(before.stamp, after.stamp));
  auto score = scores_.begin();
  for (int y = 0; y < kNumSteps; ++y) {
    for (int x = 0; x < kNumSteps; ++x, ++score) {
      const Eigen::Vector2f shift = dt_s * VelocityOf(x, y);
      *score += before.view.NumNear(after.view.places(), shift);
    }
  }
}

std::optional<Eigen::Vector2f> VelocitySearch::Find() const {
  if (scans_.size() < 2) return {};
  const auto span_s = static_cast<float>(SecondsBetween(scans_.front().stamp, scans_.back().stamp));
  if (!(span_s > 0.f)) return {};
  const auto best =
      static_cast<int>(std::max_element(scores_.begin(), scores_.end()) - scores_.begin());
  const int best_x = best % kNumSteps;
  const int best_y = best / kNumSteps;
  const int width = std::max(1, static_cast<int>(kPeakWidth_m / (span_s * kStep_mps)));
  const int peak = scores_[static_cast<std::size_t>(best)];
  int rival = 0;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();  // of the peak's flat top
  int num = 0;
  for (int i = 0; i < kNumSteps * kNumSteps; ++i) {
    const int x = i % kNumSteps;
    const int y = i / kNumSteps;
    const int score = scores_[static_cast<std::size_t>(i)];
    if (std::max(std::abs(x - best_x), std::abs(y - best_y)) > width) {
      rival = std::max(rival, score);
    } else if (static_cast<double>(score) > kFlatTop * peak) {
      sum += VelocityOf(x, y);
      ++num;
    }
  }
  if (peak - rival < kClearly * std::sqrt(static_cast<double>(peak))) return {};
  return sum / static_cast<float>(num);
}

}  // namespace lio
