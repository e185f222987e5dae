// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scan/loam_ring.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lio {
namespace {

constexpr LoamFeatureParameters kLoamFeatures = kScanParameters.loam;

float Radians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180.0);
}

}  // namespace

LoamRing::LoamRing(const LoamFeatureOptions& options)
    : options_(options),
      max_chord_(2.f * std::sin(0.5f * Radians(options.max_occlusion_gap_deg))),
      tan_min_incidence_(std::tan(Radians(options.min_incidence_deg))) {}

void LoamRing::Load(std::span<const LidarPoint> points, std::span<const std::uint32_t> ring) {
  const std::size_t n = ring.size();
  position_.resize(n);
  direction_.resize(n);
  range_m_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const LidarPoint& point = points[ring[i]];
    position_[i] = {point.x_m, point.y_m, point.z_m};
    range_m_[i] = position_[i].norm();
    direction_[i] = position_[i] / std::max(range_m_[i], 1e-6f);
  }
  label_.assign(n, Label::kPlain);
  is_taken_.assign(n, 0);
}

void LoamRing::Process(std::span<const LidarPoint> points, std::span<const std::uint32_t> ring) {
  Load(points, ring);
  if (size() <= 2 * kHalfWindow) return;
  MarkGrazed();
  MarkOccluded();
  ComputeCurvature();
  const std::size_t num_inside = size() - 2 * kHalfWindow;
  const auto num_sectors = static_cast<std::size_t>(options_.num_sectors);
  for (std::size_t s = 0; s < num_sectors; ++s) {
    const std::size_t begin = kHalfWindow + num_inside * s / num_sectors;
    const std::size_t end = kHalfWindow + num_inside * (s + 1) / num_sectors;
    PickEdges(begin, end);
    PickFlats(begin, end);
  }
}

// Marks grazing incidence. The angle between beam and surface, along the ring, comes from range
// times turned angle against the change of range, over four steps. A change of range that is mostly
// one step is a jump, not a slope.
void LoamRing::MarkGrazed() {
  constexpr std::size_t k = kLoamFeatures.slope_half_window;
  for (std::size_t i = k; i + k < size(); ++i) {
    const float rise = std::abs(range_m_[i + k] - range_m_[i - k]);
    const float chord = Chord(i - k, i + k);
    if (chord > max_chord_ || range_m_[i] * chord > tan_min_incidence_ * rise) continue;
    float max_step = 0.f;
    for (std::size_t j = i - k; j < i + k; ++j) {
      max_step = std::max(max_step, std::abs(range_m_[j + 1] - range_m_[j]));
    }
    if (max_step > kLoamFeatures.max_step_share * rise) continue;
    label_[i] = Label::kGrazed;
    is_taken_[i] = 1;
  }
}

// Marks the far side of a jump of range between neighbouring beams that exceeds the slope around
// it.
void LoamRing::MarkOccluded() {
  const auto min_jump = static_cast<float>(options_.min_occlusion_m);
  for (std::size_t i = 1; i + 2 < size(); ++i) {
    const float step = range_m_[i + 1] - range_m_[i];
    const float sign = step < 0.f ? -1.f : 1.f;
    const float slope = std::min(sign * (range_m_[i] - range_m_[i - 1]),
                                 sign * (range_m_[i + 2] - range_m_[i + 1]));
    if (std::abs(step) - std::max(slope, 0.f) < min_jump) continue;
    if (Chord(i, i + 1) > max_chord_) continue;
    const bool far_is_behind = step < 0.f;  // the far point is before the jump
    const float min_far_range = std::min(range_m_[i], range_m_[i + 1]) + min_jump;
    for (std::size_t k = 0; k < kLoamFeatures.shadow_points; ++k) {
      if (far_is_behind ? k > i : i + 1 + k >= size()) break;
      const std::size_t j = far_is_behind ? i - k : i + 1 + k;
      if (range_m_[j] < min_far_range) break;
      if (label_[j] == Label::kPlain) label_[j] = Label::kOccluded;
      is_taken_[j] = 1;
    }
  }
}

void LoamRing::ComputeCurvature() {
  curvature_m2_.assign(size(), 0.f);
  for (std::size_t i = kHalfWindow; i + kHalfWindow < size(); ++i) {
    // Each point has its own sum, because a running sum would accumulate rounding along the ring.
    Eigen::Vector3f window = Eigen::Vector3f::Zero();
    for (std::size_t j = i - kHalfWindow; j <= i + kHalfWindow; ++j) {
      window += position_[j] - position_[i];
    }
    curvature_m2_[i] = window.squaredNorm();
  }
}

void LoamRing::SuppressNeighbours(std::size_t i) {
  const auto break_sq = static_cast<float>(options_.break_m2);
  is_taken_[i] = 1;
  for (std::size_t j = i + 1; j <= i + kHalfWindow && j < size(); ++j) {
    if ((position_[j] - position_[j - 1]).squaredNorm() > break_sq) break;
    is_taken_[j] = 1;
  }
  for (std::size_t j = i; j-- > 0 && i - j <= kHalfWindow;) {
    if ((position_[j] - position_[j + 1]).squaredNorm() > break_sq) break;
    is_taken_[j] = 1;
  }
}

// Picks the foremost curvature first, equal ones by index, so that the result does not depend on
// the heap.
template <class ComesBefore, class LabelOf>
void LoamRing::Pick(std::size_t begin, std::size_t end, int most, const ComesBefore& comes_before,
                    const LabelOf& label_of) {
  const auto threshold = static_cast<float>(options_.curvature_m2);
  const auto comes_after = [&](std::uint32_t a, std::uint32_t b) {
    return curvature_m2_[a] != curvature_m2_[b] ? comes_before(curvature_m2_[b], curvature_m2_[a])
                                                : a > b;
  };
  heap_.clear();
  for (std::size_t i = begin; i < end; ++i) {
    if (!is_taken_[i] && comes_before(curvature_m2_[i], threshold)) {
      heap_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::make_heap(heap_.begin(), heap_.end(), comes_after);
  int num_picked = 0;
  while (!heap_.empty() && num_picked < most) {
    std::pop_heap(heap_.begin(), heap_.end(), comes_after);
    const std::uint32_t i = heap_.back();
    heap_.pop_back();
    if (is_taken_[i]) continue;
    label_[i] = label_of(num_picked++);
    SuppressNeighbours(i);
  }
}

void LoamRing::PickEdges(std::size_t begin, std::size_t end) {
  Pick(begin, end, options_.num_less_sharp, std::greater<float>(), [&](int num_before) {
    return num_before < options_.num_sharp ? Label::kSharp : Label::kLessSharp;
  });
}

void LoamRing::PickFlats(std::size_t begin, std::size_t end) {
  Pick(begin, end, options_.num_flat, std::less<float>(), [](int) { return Label::kFlat; });
}

}  // namespace lio
