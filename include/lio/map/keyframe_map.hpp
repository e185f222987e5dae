// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a bounded map of keyframes: the points of chosen scans, each with its normal, in one hashed
// voxel map. A submap is a choice of keyframes: a search passes over the points of all others, so
// that choosing anew costs nothing. Not safe for concurrent use while changing.
// Source: Chen, Lopez, Agha-mohammadi, Mehta, "Direct LiDAR Odometry", RA-L 2022, for the submap of
// nearest and hull keyframes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/map/point_with_normal.hpp"
#include "lio/map/voxel_blocks.hpp"

namespace lio {

struct KeyframeMapOptions {
  // Voxels have this edge. Chosen: about the distance of nearest points; it sets the time of a
  // search alone.
  double voxel_m = 0.5;
  int max_points = 1000000;  // memory bound; as GicpOptions
  // Keyframes farther from the newest one are dropped; as GicpOptions.
  double max_distance_m = 150.0;
  int num_near = 20;  // keyframes of a submap that are nearest, ...
  int num_hull = 10;  // ... and that are nearest on the convex hull; both as GicpOptions
};

class KeyframeMap {
 public:
  // Throws std::invalid_argument when an option is out of its range.
  explicit KeyframeMap(const KeyframeMapOptions& options);

  // Adds a keyframe of the points that have a normal, given in the keyframe's own frame; then drops
  // keyframes farther than max_distance_m from it and, beyond max_points, those that were in no
  // submap for longest, never the new one.
  void Add(std::span<const PointWithNormal> points_kf, const Pose& T_map_kf);

  // Makes the keyframes nearest to a place the submap, and those nearest to it on the convex hull
  // of all, seen from above. Height differences count three times: storeys above are no neighbours.
  void ChooseSubmap(const Vector3& place_map);

  struct Hit {
    std::int32_t point = -1;  // for point(); -1: none within the radius
    Eigen::Vector3f from_query = Eigen::Vector3f::Zero();  // map axes
  };
  // `near` is a point of the submap that may be the nearest, as it was a moment ago; -1: none
  // known. The better it is the shorter the search; the result is the same but for ties.
  [[nodiscard]] Hit FindNearest(const Vector3& query_map, double radius_m,
                                std::int32_t near = -1) const;
  // The normal is in the map's frame; the position is from the corner of the point's block.
  [[nodiscard]] const PointWithNormal& point(std::int32_t point) const {
    return points_[ToIndex(point)].value;
  }

  // Returns how many points of all keyframes lie in the voxel around a point.
  [[nodiscard]] int CountAt(const Vector3& point_map) const;

  // Holds the keyframe nearest to a place; none: -1.
  struct Nearest {
    std::int32_t keyframe = -1;
    Pose T_map_kf;
  };
  [[nodiscard]] Nearest NearestKeyframe(const Vector3& place_map) const;

  std::size_t num_keyframes() const { return num_keyframes_; }
  std::size_t num_points() const { return num_points_; }
  std::size_t memory_bytes() const;

 private:
  static constexpr int kNodeSize = 8;  // points; chosen: two SSE registers of floats
  static constexpr std::int32_t kNone = -1;
  using Blocks = VoxelBlocks<std::int32_t>;  // the first node of each voxel's chain

  // Holds some points of one voxel, in a chain.
  struct Node {
    std::array<float, kNodeSize> x{}, y{}, z{};  // from the block's corner
    std::array<std::int32_t, kNodeSize> point{};
    std::array<std::int32_t, kNodeSize> keyframe{};
    std::int32_t count = 0;
    std::int32_t next = kNone;
  };
  struct Point {
    PointWithNormal value;
    std::int32_t block = kNone;
    std::int32_t voxel = 0;  // in the block
  };
  struct Keyframe {
    Pose T_map_kf;
    std::vector<std::int32_t> points;
    std::uint64_t last_chosen = 0;  // number of the submap
    bool is_used = false;
    bool is_chosen = false;
  };

  struct Search;

  static std::size_t ToIndex(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::int32_t AddPoint(const PointWithNormal& point_map, const Vector3& position_map,
                        std::int32_t keyframe);
  void RemovePoint(std::int32_t point);
  void RemoveKeyframe(std::int32_t keyframe);
  // These drop what Add() says, and keep the newest keyframe.
  void DropFarKeyframes(std::int32_t newest);
  void DropLongestUnused(std::int32_t newest);
  std::vector<std::int32_t> HullKeyframes(const std::vector<std::int32_t>& all) const;
  // These are in keyframe_map_search.cpp.
  void SearchAround(Search& search, int radius_voxels) const;
  void SearchVoxel(const Blocks::Block& block, std::size_t voxel, const Eigen::Vector3f& query,
                   Search& search) const;

  KeyframeMapOptions options_;
  Blocks blocks_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> free_nodes_;
  std::vector<Point> points_;
  std::vector<std::int32_t> free_points_;
  std::vector<Keyframe> keyframes_;
  std::vector<std::int32_t> free_keyframes_;
  std::size_t num_keyframes_ = 0;
  std::size_t num_points_ = 0;
  std::uint64_t submap_number_ = 0;
};

}  // namespace lio
