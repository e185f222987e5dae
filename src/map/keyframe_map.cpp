// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/keyframe_map.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "lio/map/map_parameters.hpp"
#include "map/convex_hull.hpp"

namespace lio {
namespace {

std::int32_t Take(std::vector<std::int32_t>& free, std::size_t next_new) {
  if (free.empty()) return static_cast<std::int32_t>(next_new);
  const std::int32_t taken = free.back();
  free.pop_back();
  return taken;
}

// Returns the squared distance by which a submap's keyframes are chosen: storeys are far apart.
double SubmapDistanceSq(const Vector3& a, const Vector3& b) {
  const Vector3 d = a - b;
  constexpr double kFactor = KeyframeMapParameters::kHeightFactor;
  return d.head<2>().squaredNorm() + kFactor * kFactor * d.z() * d.z();
}

}  // namespace

KeyframeMap::KeyframeMap(const KeyframeMapOptions& options)
    : options_(options), blocks_(options.voxel_m, KeyframeMapParameters::kMaxSearch_voxels) {
  if (!(options.voxel_m > 0) || options.max_points < 1 || !(options.max_distance_m > 0) ||
      options.num_near < 1 || options.num_hull < 0) {
    throw std::invalid_argument("KeyframeMap: an option is out of range");
  }
}

std::int32_t KeyframeMap::AddPoint(const PointWithNormal& point_map, const Vector3& position_map,
                                   std::int32_t keyframe) {
  const VoxelCell cell = blocks_.VoxelAt(position_map);
  if (!blocks_.IsInRange(cell)) return kNone;
  const VoxelIndex::Added added = blocks_.FindOrAdd(cell);
  Blocks::Block& block = blocks_.block(added.voxel);
  const std::int32_t voxel = Blocks::InBlock(cell);
  const std::uint64_t bit = std::uint64_t{1} << voxel;
  std::int32_t& head = block.voxels[ToIndex(voxel)];
  if (!(block.occupied & bit)) head = kNone;
  block.occupied |= bit;
  if (head == kNone || nodes_[ToIndex(head)].count == kNodeSize) {
    const std::int32_t node = Take(free_nodes_, nodes_.size());
    if (ToIndex(node) == nodes_.size()) nodes_.emplace_back();
    nodes_[ToIndex(node)].count = 0;
    nodes_[ToIndex(node)].next = head;
    head = node;
  }
  const std::int32_t point = Take(free_points_, points_.size());
  if (ToIndex(point) == points_.size()) points_.emplace_back();
  const Eigen::Vector3f local = (position_map - blocks_.CornerOf(block)).cast<float>();
  points_[ToIndex(point)] = {point_map, added.voxel, voxel};
  points_[ToIndex(point)].value.position = local;
  Node& node = nodes_[ToIndex(head)];
  const auto i = ToIndex(node.count++);
  node.x[i] = local.x();
  node.y[i] = local.y();
  node.z[i] = local.z();
  node.point[i] = point;
  node.keyframe[i] = keyframe;
  ++num_points_;
  return point;
}

// The last point of the chain's first node fills the gap.
void KeyframeMap::RemovePoint(std::int32_t point) {
  const Point& removed = points_[ToIndex(point)];
  Blocks::Block& block = blocks_.block(removed.block);
  std::int32_t& head = block.voxels[ToIndex(removed.voxel)];
  Node& first = nodes_[ToIndex(head)];
  const auto last = ToIndex(first.count - 1);
  for (std::int32_t at = head; at != kNone; at = nodes_[ToIndex(at)].next) {
    Node& node = nodes_[ToIndex(at)];
    const auto end = node.point.begin() + node.count;
    const auto found = std::find(node.point.begin(), end, point);
    if (found == end) continue;
    const auto i = static_cast<std::size_t>(found - node.point.begin());
    node.x[i] = first.x[last];
    node.y[i] = first.y[last];
    node.z[i] = first.z[last];
    node.point[i] = first.point[last];
    node.keyframe[i] = first.keyframe[last];
    break;
  }
  if (--first.count == 0) {
    const std::int32_t emptied = head;
    head = first.next;
    free_nodes_.push_back(emptied);
    if (head == kNone) block.occupied &= ~(std::uint64_t{1} << removed.voxel);
    if (block.occupied == 0) blocks_.Remove(removed.block);
  }
  free_points_.push_back(point);
  --num_points_;
}

void KeyframeMap::RemoveKeyframe(std::int32_t keyframe) {
  Keyframe& frame = keyframes_[ToIndex(keyframe)];
  for (const std::int32_t point : frame.points) RemovePoint(point);
  frame = {};
  free_keyframes_.push_back(keyframe);
  --num_keyframes_;
}

void KeyframeMap::Add(std::span<const PointWithNormal> points_kf, const Pose& T_map_kf) {
  const std::int32_t number = Take(free_keyframes_, keyframes_.size());
  if (ToIndex(number) == keyframes_.size()) keyframes_.emplace_back();
  Keyframe& frame = keyframes_[ToIndex(number)];
  frame.T_map_kf = T_map_kf;
  frame.last_chosen = submap_number_;
  frame.is_used = true;
  ++num_keyframes_;
  const Eigen::Matrix3f rotation = T_map_kf.rotation.toRotationMatrix().cast<float>();
  for (const PointWithNormal& point : points_kf) {
    if (!point.HasNormal()) continue;
    PointWithNormal rotated = point;
    rotated.normal = rotation * point.normal;
    const std::int32_t added = AddPoint(rotated, T_map_kf * point.position.cast<double>(), number);
    if (added != kNone) frame.points.push_back(added);
  }
  DropFarKeyframes(number);
  DropLongestUnused(number);
}

void KeyframeMap::DropFarKeyframes(std::int32_t newest) {
  const Vector3 place_map = keyframes_[ToIndex(newest)].T_map_kf.translation;
  const double limit_sq = options_.max_distance_m * options_.max_distance_m;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    const Keyframe& other = keyframes_[ToIndex(i)];
    if (!other.is_used || i == newest) continue;
    if ((other.T_map_kf.translation - place_map).squaredNorm() > limit_sq) RemoveKeyframe(i);
  }
}

void KeyframeMap::DropLongestUnused(std::int32_t newest) {
  while (num_points_ > static_cast<std::size_t>(options_.max_points) && num_keyframes_ > 1) {
    std::int32_t oldest = kNone;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
      if (!keyframes_[ToIndex(i)].is_used || i == newest) continue;
      if (oldest == kNone ||
          keyframes_[ToIndex(i)].last_chosen < keyframes_[ToIndex(oldest)].last_chosen) {
        oldest = i;
      }
    }
    RemoveKeyframe(oldest);
  }
}

std::vector<std::int32_t> KeyframeMap::HullKeyframes(const std::vector<std::int32_t>& all) const {
  std::vector<Eigen::Vector2d> places;
  places.reserve(all.size());
  for (const std::int32_t i : all) {
    places.emplace_back(keyframes_[ToIndex(i)].T_map_kf.translation.head<2>());
  }
  std::vector<std::int32_t> hull;
  for (const std::size_t corner : ConvexHull(places)) hull.push_back(all[corner]);
  return hull;
}

void KeyframeMap::ChooseSubmap(const Vector3& place_map) {
  ++submap_number_;
  std::vector<std::int32_t> all;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    keyframes_[ToIndex(i)].is_chosen = false;
    if (keyframes_[ToIndex(i)].is_used) all.push_back(i);
  }
  const auto choose_nearest = [&](std::vector<std::int32_t> from, int count) {
    const auto wanted = std::min(from.size(), static_cast<std::size_t>(count));
    const auto is_nearer = [&](std::int32_t a, std::int32_t b) {
      const double p = SubmapDistanceSq(keyframes_[ToIndex(a)].T_map_kf.translation, place_map);
      const double q = SubmapDistanceSq(keyframes_[ToIndex(b)].T_map_kf.translation, place_map);
      return p != q ? p < q : a < b;
    };
    std::partial_sort(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(wanted), from.end(),
                      is_nearer);
    for (std::size_t i = 0; i < wanted; ++i) {
      keyframes_[ToIndex(from[i])].is_chosen = true;
      keyframes_[ToIndex(from[i])].last_chosen = submap_number_;
    }
  };
  choose_nearest(all, options_.num_near);
  if (all.size() <= static_cast<std::size_t>(options_.num_near)) return;
  choose_nearest(HullKeyframes(all), options_.num_hull);
}

int KeyframeMap::CountAt(const Vector3& point_map) const {
  const VoxelCell cell = blocks_.VoxelAt(point_map);
  if (!blocks_.IsInRange(cell)) return 0;
  const std::int32_t number = blocks_.Find(cell);
  if (number == Blocks::kNone) return 0;
  const Blocks::Block& block = blocks_.block(number);
  const std::int32_t voxel = Blocks::InBlock(cell);
  if (!(block.occupied >> voxel & 1)) return 0;
  int count = 0;
  for (std::int32_t at = block.voxels[ToIndex(voxel)]; at != kNone; at = nodes_[ToIndex(at)].next) {
    count += nodes_[ToIndex(at)].count;
  }
  return count;
}

KeyframeMap::Nearest KeyframeMap::NearestKeyframe(const Vector3& place_map) const {
  Nearest nearest;
  double best_sq = std::numeric_limits<double>::infinity();
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    if (!keyframes_[ToIndex(i)].is_used) continue;
    const double distance_sq =
        (keyframes_[ToIndex(i)].T_map_kf.translation - place_map).squaredNorm();
    if (distance_sq >= best_sq) continue;
    best_sq = distance_sq;
    nearest = {i, keyframes_[ToIndex(i)].T_map_kf};
  }
  return nearest;
}

std::size_t KeyframeMap::memory_bytes() const {
  return blocks_.memory_bytes() + nodes_.capacity() * sizeof(Node) +
         points_.capacity() * (sizeof(Point) + 4);
}

}  // namespace lio
