// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/keyframe_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lio {
namespace {

constexpr double kHeightFactor = 3.0;
constexpr int kMaxReach = 8;  // voxels: a search never goes farther
constexpr std::int32_t kCoordinateLimit = kVoxelCoordinateLimit - 2 * kMaxReach;

std::int32_t Take(std::vector<std::int32_t>& free, std::size_t next_new) {
  if (free.empty()) return static_cast<std::int32_t>(next_new);
  const std::int32_t taken = free.back();
  free.pop_back();
  return taken;
}

double DistanceSq(const Vector3& a, const Vector3& b) {
  const Vector3 d = a - b;
  return d.head<2>().squaredNorm() + kHeightFactor * kHeightFactor * d.z() * d.z();
}

}  // namespace

KeyframeMap::KeyframeMap(const KeyframeMapOptions& options)
    : options_(options), inverse_voxel_(1.0 / options.voxel_m) {
  if (!(options.voxel_m > 0) || options.max_points < 1 || !(options.max_distance_m > 0) ||
      options.num_near < 1 || options.num_hull < 0) {
    throw std::invalid_argument("KeyframeMap: an option is out of range");
  }
}

KeyframeMap::Cell KeyframeMap::VoxelOf(const Vector3& point_map) const {
  const Vector3 scaled =
      (inverse_voxel_ * point_map).cwiseMax(-kVoxelCoordinateLimit).cwiseMin(kVoxelCoordinateLimit);
  return {static_cast<std::int32_t>(std::floor(scaled.x())),
          static_cast<std::int32_t>(std::floor(scaled.y())),
          static_cast<std::int32_t>(std::floor(scaled.z()))};
}

Vector3 KeyframeMap::CentreOf(const Cell& voxel) const {
  return options_.voxel_m * (Vector3(voxel[0], voxel[1], voxel[2]).array() + 0.5);
}

std::int32_t KeyframeMap::AddPoint(const ShapedPoint& shape_map, const Vector3& position_map,
                                   std::int32_t keyframe) {
  const Cell cell = VoxelOf(position_map);
  const auto is_far = [](std::int32_t v) { return std::abs(v) >= kCoordinateLimit; };
  if (std::any_of(cell.begin(), cell.end(), is_far)) return kNone;
  const VoxelIndex::Added added = index_.FindOrAdd(PackVoxel(cell[0], cell[1], cell[2]));
  if (first_node_.size() < index_.capacity()) first_node_.resize(index_.capacity(), kNone);
  std::int32_t& head = first_node_[ToIndex(added.voxel)];
  if (added.is_new) head = kNone;
  if (head == kNone || nodes_[ToIndex(head)].count == kNodeSize) {
    const std::int32_t node = Take(free_nodes_, nodes_.size());
    if (ToIndex(node) == nodes_.size()) nodes_.emplace_back();
    nodes_[ToIndex(node)].count = 0;
    nodes_[ToIndex(node)].next = head;
    head = node;
  }
  const std::int32_t point = Take(free_points_, points_.size());
  if (ToIndex(point) == points_.size()) points_.emplace_back();
  points_[ToIndex(point)] = {shape_map, added.voxel};
  Node& node = nodes_[ToIndex(head)];
  const Eigen::Vector3f local = (position_map - CentreOf(cell)).cast<float>();
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
  const std::int32_t voxel = points_[ToIndex(point)].voxel;
  std::int32_t& head = first_node_[ToIndex(voxel)];
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
    if (head == kNone) index_.Remove(voxel);
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

void KeyframeMap::Add(std::span<const ShapedPoint> points_kf, const Pose& T_map_kf) {
  const std::int32_t number = Take(free_keyframes_, keyframes_.size());
  if (ToIndex(number) == keyframes_.size()) keyframes_.emplace_back();
  Keyframe& frame = keyframes_[ToIndex(number)];
  frame.T_map_kf = T_map_kf;
  frame.last_chosen = submap_number_;
  frame.is_used = true;
  ++num_keyframes_;
  const Eigen::Matrix3f rotation = T_map_kf.rotation.toRotationMatrix().cast<float>();
  for (const ShapedPoint& point : points_kf) {
    if (!point.HasShape()) continue;
    ShapedPoint shape = point;
    shape.normal = rotation * point.normal;
    const std::int32_t added = AddPoint(shape, T_map_kf * point.position.cast<double>(), number);
    if (added != kNone) frame.points.push_back(added);
  }

  const double limit_sq = options_.max_distance_m * options_.max_distance_m;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    const Keyframe& other = keyframes_[ToIndex(i)];
    if (!other.is_used || i == number) continue;
    if ((other.T_map_kf.translation - T_map_kf.translation).squaredNorm() > limit_sq) {
      RemoveKeyframe(i);
    }
  }
  while (num_points_ > static_cast<std::size_t>(options_.max_points) && num_keyframes_ > 1) {
    std::int32_t oldest = kNone;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
      if (!keyframes_[ToIndex(i)].is_used || i == number) continue;
      if (oldest == kNone ||
          keyframes_[ToIndex(i)].last_chosen < keyframes_[ToIndex(oldest)].last_chosen) {
        oldest = i;
      }
    }
    RemoveKeyframe(oldest);
  }
}

// Andrew's monotone chain over the keyframes' places seen from above.
std::vector<std::int32_t> KeyframeMap::HullKeyframes() const {
  std::vector<std::int32_t> sorted;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    if (keyframes_[ToIndex(i)].is_used) sorted.push_back(i);
  }
  const auto place = [&](std::int32_t i) -> Eigen::Vector2d {
    return keyframes_[ToIndex(i)].T_map_kf.translation.head<2>();
  };
  std::sort(sorted.begin(), sorted.end(), [&](std::int32_t a, std::int32_t b) {
    const Eigen::Vector2d p = place(a);
    const Eigen::Vector2d q = place(b);
    if (p.x() != q.x()) return p.x() < q.x();
    return p.y() != q.y() ? p.y() < q.y() : a < b;
  });
  if (sorted.size() < 3) return sorted;
  std::vector<std::int32_t> hull;
  const auto add = [&](std::int32_t i, std::size_t floor) {
    while (hull.size() >= floor + 2) {
      const Eigen::Vector2d a = place(hull[hull.size() - 1]) - place(hull[hull.size() - 2]);
      const Eigen::Vector2d b = place(i) - place(hull[hull.size() - 2]);
      if (a.x() * b.y() - a.y() * b.x() > 0) break;
      hull.pop_back();
    }
    hull.push_back(i);
  };
  for (const std::int32_t i : sorted) add(i, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto i = sorted.rbegin() + 1; i != sorted.rend(); ++i) add(*i, lower);
  hull.pop_back();  // the first one again
  return hull;
}

void KeyframeMap::ChooseSubmap(const Vector3& place_map) {
  ++submap_number_;
  std::vector<std::int32_t> all;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(keyframes_.size()); ++i) {
    keyframes_[ToIndex(i)].is_chosen = false;
    if (keyframes_[ToIndex(i)].is_used) all.push_back(i);
  }
  const auto choose_nearest = [&](std::vector<std::int32_t>& from, int count) {
    const auto wanted = std::min(from.size(), static_cast<std::size_t>(count));
    const auto is_nearer = [&](std::int32_t a, std::int32_t b) {
      const double p = DistanceSq(keyframes_[ToIndex(a)].T_map_kf.translation, place_map);
      const double q = DistanceSq(keyframes_[ToIndex(b)].T_map_kf.translation, place_map);
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
  std::vector<std::int32_t> hull = HullKeyframes();
  choose_nearest(hull, options_.num_hull);
}

void KeyframeMap::SearchVoxel(const Cell& voxel, const Vector3& query_map, float& best_sq,
                              Hit& best) const {
  const std::int32_t number = index_.Find(PackVoxel(voxel[0], voxel[1], voxel[2]));
  if (number == VoxelIndex::kNone) return;
  const Eigen::Vector3f query = (query_map - CentreOf(voxel)).cast<float>();
  for (std::int32_t at = first_node_[ToIndex(number)]; at != kNone; at = nodes_[ToIndex(at)].next) {
    const Node& node = nodes_[ToIndex(at)];
    std::array<float, kNodeSize> distance_sq;
    for (std::size_t i = 0; i < kNodeSize; ++i) {  // all of them: this becomes vector code
      const float dx = node.x[i] - query.x();
      const float dy = node.y[i] - query.y();
      const float dz = node.z[i] - query.z();
      distance_sq[i] = dx * dx + dy * dy + dz * dz;
    }
    for (std::size_t i = 0; i < ToIndex(node.count); ++i) {
      if (distance_sq[i] >= best_sq || !keyframes_[ToIndex(node.keyframe[i])].is_chosen) continue;
      best_sq = distance_sq[i];
      best.point = node.point[i];
      best.from_query = Eigen::Vector3f(node.x[i], node.y[i], node.z[i]) - query;
    }
  }
}

// Shell by shell of voxels, each voxel only when it can hold something nearer.
KeyframeMap::Hit KeyframeMap::FindNearest(const Vector3& query_map, double radius_m) const {
  Hit best;
  const Cell centre = VoxelOf(query_map);
  const auto is_far = [](std::int32_t v) { return std::abs(v) >= kCoordinateLimit; };
  if (std::any_of(centre.begin(), centre.end(), is_far)) return best;
  auto best_sq = static_cast<float>(radius_m * radius_m);
  SearchVoxel(centre, query_map, best_sq, best);
  const Vector3 local = inverse_voxel_ * query_map - Vector3(centre[0], centre[1], centre[2]);
  // Distance from the query to the voxels `step` away along an axis, in voxels.
  const auto gap = [&](std::size_t axis, int step) {
    const double at = local[static_cast<Eigen::Index>(axis)];
    return step > 0 ? step - at : (step < 0 ? at - step - 1.0 : 0.0);
  };
  const double voxel_sq = options_.voxel_m * options_.voxel_m;
  const int reach = std::min(static_cast<int>(std::ceil(radius_m * inverse_voxel_)), kMaxReach);
  for (int shell = 1; shell <= reach; ++shell) {
    const double nearest_side = std::min(local.minCoeff(), 1.0 - local.maxCoeff()) + shell - 1;
    if (nearest_side > 0 && nearest_side * nearest_side * voxel_sq >= best_sq) break;
    for (int z = -shell; z <= shell; ++z) {
      const double gap_z = gap(2, z);
      for (int y = -shell; y <= shell; ++y) {
        const double gap_y = gap(1, y);
        const double gap_yz_sq = gap_z * gap_z + gap_y * gap_y;
        if (gap_yz_sq * voxel_sq >= best_sq) continue;
        const bool is_face = std::abs(z) == shell || std::abs(y) == shell;
        for (int x = -shell; x <= shell; x += is_face ? 1 : 2 * shell) {
          const double gap_x = gap(0, x);
          if ((gap_yz_sq + gap_x * gap_x) * voxel_sq >= best_sq) continue;
          SearchVoxel({centre[0] + x, centre[1] + y, centre[2] + z}, query_map, best_sq, best);
        }
      }
    }
  }
  return best;
}

int KeyframeMap::CountAt(const Vector3& point_map) const {
  const Cell cell = VoxelOf(point_map);
  const auto is_far = [](std::int32_t v) { return std::abs(v) >= kCoordinateLimit; };
  if (std::any_of(cell.begin(), cell.end(), is_far)) return 0;
  const std::int32_t voxel = index_.Find(PackVoxel(cell[0], cell[1], cell[2]));
  if (voxel == VoxelIndex::kNone) return 0;
  int count = 0;
  for (std::int32_t at = first_node_[ToIndex(voxel)]; at != kNone; at = nodes_[ToIndex(at)].next) {
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
  return index_.memory_bytes() + first_node_.capacity() * sizeof(std::int32_t) +
         nodes_.capacity() * sizeof(Node) + points_.capacity() * (sizeof(Point) + 4);
}

}  // namespace lio
