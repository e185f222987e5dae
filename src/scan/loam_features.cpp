// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/loam_features.hpp"

#include "lio/base/voxel_set.hpp"
#include "lio/scan/point_filter.hpp"
#include "scan/loam_ring.hpp"
#include "scan/ring_order.hpp"

namespace lio {
namespace {

// Keeps the first point along the ring in each voxel.
class RingThinner {
 public:
  explicit RingThinner(double leaf_m) : inverse_leaf_(static_cast<float>(1.0 / leaf_m)) {}

  void Clear() { seen_.Clear(); }
  bool Add(const LidarPoint& point) {
    return seen_.Insert(PackVoxel(FloorToInt(point.x_m * inverse_leaf_),
                                  FloorToInt(point.y_m * inverse_leaf_),
                                  FloorToInt(point.z_m * inverse_leaf_)));
  }

 private:
  float inverse_leaf_;
  VoxelSet seen_;
};

std::vector<std::uint8_t> FindWanted(const Sweep& sweep, const LidarRig& rig) {
  const PointFilter filter(rig);
  std::vector<std::uint8_t> is_wanted(sweep.points.size());
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    is_wanted[i] = IsFinite(sweep.points[i]) && filter.IsWanted(sweep.points[i]);
  }
  return is_wanted;
}

}  // namespace

LoamFeatures ExtractLoamFeatures(const Sweep& sweep, const LoamFeatureOptions& options,
                                 const LidarRig& rig, std::span<const double> beam_elevations_rad) {
  LoamFeatures features;
  if (LacksRings(sweep.points)) {
    if (beam_elevations_rad.empty()) return features;
    features.rebuilt_rings = RingsFromElevation(sweep.points, beam_elevations_rad);
  }
  const RingOrder order = OrderByRing(sweep.points, features.rebuilt_rings, FindWanted(sweep, rig));
  LoamRing ring(options);
  RingThinner thinner(options.leaf_m);
  for (std::size_t r = 0; r < order.num_rings(); ++r) {
    const std::span<const std::uint32_t> indices = order.ring(r);
    ring.Process(sweep.points, indices);
    thinner.Clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!ring.IsInside(i)) continue;
      const std::uint32_t point = indices[i];
      switch (ring.label(i)) {
        case LoamRing::Label::kSharp:
          features.sharp.push_back(point);
          features.less_sharp.push_back(point);
          break;
        case LoamRing::Label::kLessSharp:
          features.less_sharp.push_back(point);
          break;
        case LoamRing::Label::kFlat:
          features.flat.push_back(point);
          [[fallthrough]];
        case LoamRing::Label::kPlain:
          if (thinner.Add(sweep.points[point])) features.less_flat.push_back(point);
          break;
        case LoamRing::Label::kOccluded:
          features.occluded.push_back(point);
          break;
        case LoamRing::Label::kGrazed:
          features.grazed.push_back(point);
          break;
      }
    }
  }
  return features;
}

}  // namespace lio
