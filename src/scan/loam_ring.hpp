// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the features of one ring: curvature, reliability and picking (Zhang and Singh, RSS 2014,
// section V-A). Its buffers are used again for ring after ring. Lidar frame, metres.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lio/base/rotation.hpp"
#include "lio/scan/loam_feature_options.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "scan/scan_parameters.hpp"

namespace lio {

class LoamRing {
 public:
  static constexpr int kHalfWindow = kScanParameters.loam.half_window;  // neighbours each side

  explicit LoamRing(const LoamFeatureOptions& options);

  // Gives the result for a point.
  enum class Label : std::uint8_t { kPlain, kSharp, kLessSharp, kFlat, kOccluded, kGrazed };

  // `ring`: indices into `points`, in the order they were measured.
  void Process(std::span<const LidarPoint> points, std::span<const std::uint32_t> ring);

  std::size_t size() const { return position_.size(); }
  Label label(std::size_t i) const { return label_[i]; }
  // Returns true for points with a full window of neighbours: all but five at each end.
  bool IsInside(std::size_t i) const { return i >= kHalfWindow && i + kHalfWindow < size(); }

 private:
  void Load(std::span<const LidarPoint> points, std::span<const std::uint32_t> ring);
  void MarkGrazed();
  void MarkOccluded();
  void ComputeCurvature();
  void PickEdges(std::size_t begin, std::size_t end);
  void PickFlats(std::size_t begin, std::size_t end);
  // Picks at most `most` of the points whose curvature comes before the threshold. `label_of` gives
  // the label of a pick from the number of those before it.
  template <class ComesBefore, class LabelOf>
  void Pick(std::size_t begin, std::size_t end, int most, const ComesBefore& comes_before,
            const LabelOf& label_of);
  void SuppressNeighbours(std::size_t i);
  float Chord(std::size_t i, std::size_t j) const { return (direction_[i] - direction_[j]).norm(); }

  LoamFeatureOptions options_;
  float max_chord_;  // largest distance of unit directions of beams that may occlude each other
  float tan_min_incidence_;
  std::vector<Eigen::Vector3f> position_;   // lidar frame, m
  std::vector<Eigen::Vector3f> direction_;  // unit
  std::vector<float> range_m_;
  std::vector<float> curvature_m2_;
  std::vector<Label> label_;
  std::vector<std::uint8_t> is_taken_;  // picked, next to a pick, or unreliable
  std::vector<std::uint32_t> heap_;     // candidates of a sector
};

}  // namespace lio
