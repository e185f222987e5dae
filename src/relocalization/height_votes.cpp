// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/height_votes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lio/base/voxel_key.hpp"
#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr HeightVotesParameters kHeight = kRelocalization.height;

std::int32_t BinOf(float height_m) {
  return FloorToInt(height_m / kHeight.bin_m);
}

// Returns the best bins, each with its two neighbours, none nearer to a better one than a metre.
std::vector<float> PeaksOf(const std::vector<int>& votes, int first_bin) {
  const auto width = static_cast<int>(kHeight.apart_m / kHeight.bin_m);
  std::vector<std::pair<int, int>> sums;  // votes and bin, best first
  for (std::size_t i = 1; i + 1 < votes.size(); ++i) {
    const int sum = votes[i - 1] + votes[i] + votes[i + 1];
    if (sum > 0) sums.emplace_back(sum, static_cast<int>(i));
  }
  std::stable_sort(sums.begin(), sums.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<float> peaks;
  std::vector<int> taken;
  for (const auto& [sum, bin] : sums) {
    if (sum < kHeight.min_vote_ratio * sums.front().first) break;
    const auto is_near = [&, at = bin](int other) { return std::abs(other - at) < width; };
    if (std::any_of(taken.begin(), taken.end(), is_near)) continue;
    taken.push_back(bin);
    const auto at = static_cast<std::size_t>(bin);
    const float off_bins =
        static_cast<float>(votes[at + 1] - votes[at - 1]) / static_cast<float>(sum);
    peaks.push_back(kHeight.bin_m * (static_cast<float>(first_bin + bin) + off_bins));
    if (peaks.size() == kHeight.max_heights) break;
  }
  return peaks;
}

}  // namespace

HeightVotes::Column HeightVotes::ColumnOf(const Eigen::Vector2f& point) {
  const Eigen::Vector2f scaled = point / kHeight.column_m;
  return (static_cast<std::int64_t>(FloorToInt(scaled.x())) << 32) + FloorToInt(scaled.y());
}

HeightVotes::HeightVotes(std::span<const Eigen::Vector3f> points_map) {
  heights_.reserve(points_map.size());
  for (const Eigen::Vector3f& point : points_map) {
    heights_.emplace_back(ColumnOf(point.head<2>()), BinOf(point.z()));
  }
  std::sort(heights_.begin(), heights_.end());
  heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
  heights_.shrink_to_fit();
  if (heights_.empty()) return;
  const auto [low, high] =
      std::minmax_element(heights_.begin(), heights_.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; });
  lowest_ = low->second;
  highest_ = high->second;
}

std::vector<float> HeightVotes::Find(std::span<const Eigen::Vector3f> points,
                                     const PlanarPose& pose) const {
  if (points.empty() || heights_.empty()) return {};
  const std::size_t num = std::min(points.size(), kHeight.max_points);
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  const int first_bin = lowest_ - BinOf(high->z()) - 1;
  const int last_bin = highest_ - BinOf(low->z()) + 1;
  std::vector<int> votes(static_cast<std::size_t>(last_bin - first_bin + 1), 0);
  const Eigen::Rotation2Df rotation(pose.turn_rad);
  for (std::size_t i = 0; i < num; ++i) {
    const Eigen::Vector3f& point = points[i * points.size() / num];
    const Eigen::Vector2f above = rotation * Eigen::Vector2f(point.head<2>()) + pose.shift_m;
    const Column column = ColumnOf(above);
    const int bin = BinOf(point.z());
    auto at = std::lower_bound(heights_.begin(), heights_.end(),
                               std::pair(column, std::numeric_limits<std::int32_t>::min()));
    for (; at != heights_.end() && at->first == column; ++at) {
      ++votes[static_cast<std::size_t>(at->second - bin - first_bin)];
    }
  }
  return PeaksOf(votes, first_bin);
}

}  // namespace lio
