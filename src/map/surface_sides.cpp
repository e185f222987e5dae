// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/surface_sides.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <utility>

#include "lio/base/voxel_map.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

VoxelCell CellOf(const Eigen::Vector3f& point, float edge_m = SurfaceSidesParameters::kRadius_m) {
  return VoxelOf((point / edge_m).cast<double>());
}

VoxelKey KeyOf(const Eigen::Vector3f& point, float edge_m = SurfaceSidesParameters::kRadius_m) {
  const VoxelCell at = CellOf(point, edge_m);
  return PackVoxel(at[0], at[1], at[2]);
}

// One point of each small voxel stands for all of them: the neighbours of a point are then bounded,
// however dense a cloud is.
struct Representatives {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::size_t> of;  // index into `points`, for each point of the cloud

  explicit Representatives(std::span<const Eigen::Vector3f> cloud) {
    VoxelIndex voxels;
    of.reserve(cloud.size());
    for (const Eigen::Vector3f& point : cloud) {
      const auto found = voxels.FindOrAdd(KeyOf(point, SurfaceSidesParameters::kSpacing_m));
      if (found.is_new) points.push_back(point);
      of.push_back(static_cast<std::size_t>(found.voxel));
    }
  }
};

// Holds the points by voxels as wide as the search is far.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(std::span<const Eigen::Vector3f> points) {
    std::vector<std::int32_t> voxel_of;
    for (const Eigen::Vector3f& point : points) {
      voxel_of.push_back(voxels_.FindOrAdd(KeyOf(point)).voxel);
      ++voxels_.Of<Range>(voxel_of.back()).num;
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < voxels_.size(); ++i) {
      Range& range = voxels_.Of<Range>(static_cast<std::int32_t>(i));
      range.begin = begin;
      begin += std::exchange(range.num, 0);
    }
    sorted_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      Range& range = voxels_.Of<Range>(voxel_of[i]);
      sorted_[range.begin + range.num++] = points[i];
    }
  }

  // Gives the points around one, from there.
  void Around(const Eigen::Vector3f& point, std::vector<Eigen::Vector3f>& offsets) const {
    offsets.clear();
    const VoxelCell at = CellOf(point);
    ForEachVoxel({at[0] - 1, at[1] - 1, at[2] - 1}, {at[0] + 1, at[1] + 1, at[2] + 1},
                 [&](std::int32_t x, std::int32_t y, std::int32_t z) {
                   const std::int32_t voxel = voxels_.Find(PackVoxel(x, y, z));
                   if (voxel == VoxelIndex::kNone) return;
                   const Range& range = voxels_.Of<Range>(voxel);
                   for (std::size_t i = range.begin; i < range.begin + range.num; ++i) {
                     const Eigen::Vector3f offset = sorted_[i] - point;
                     if (offset.squaredNorm() <
                         SurfaceSidesParameters::kRadius_m * SurfaceSidesParameters::kRadius_m) {
                       offsets.push_back(offset);
                     }
                   }
                 });
  }

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t num = 0;
  };

  VoxelMap<Range> voxels_;
  std::vector<Eigen::Vector3f> sorted_;
};

Eigen::Vector3f NormalOf(std::span<const Eigen::Vector3f> offsets) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& offset : offsets) mean += offset;
  mean /= static_cast<float>(offsets.size());
  Eigen::Matrix3f cov = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& offset : offsets) {
    cov += (offset - mean) * (offset - mean).transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen;
  eigen.computeDirect(cov);
  return eigen.eigenvectors().col(0);
}

// Holds the points on one side of a sheet, by their distances from it.
struct Side {
  int num = 0;
  int num_near = 0;
  float sum = 0.f;
  float sum_sq = 0.f;

  void Add(float distance_m) {
    ++num;
    num_near += distance_m < SurfaceSidesParameters::kGap_m ? 1 : 0;
    sum += distance_m;
    sum_sq += distance_m * distance_m;
  }
  // Do they lie on another sheet, or on a ceiling with beams, beyond a gap? A wall on a floor
  // spreads over all distances.
  [[nodiscard]] bool IsSheet() const {
    if (num < SurfaceSidesParameters::kMinPoints) return false;
    const auto most_in_gap = SurfaceSidesParameters::kMaxShareInGap * static_cast<float>(num);
    if (static_cast<float>(num_near) <= most_in_gap) return true;
    const float mean = sum / static_cast<float>(num);
    const float variance = sum_sq / static_cast<float>(num) - mean * mean;
    return variance <
           SurfaceSidesParameters::kMaxSheetStd_m * SurfaceSidesParameters::kMaxSheetStd_m;
  }
};

Eigen::Vector3f SideOf(std::span<const Eigen::Vector3f> offsets) {
  if (offsets.size() < 2 * SurfaceSidesParameters::kMinPoints) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f normal = NormalOf(offsets);
  Side before;
  Side behind;
  for (const Eigen::Vector3f& offset : offsets) {
    const float distance_m = normal.dot(offset);
    if (std::abs(distance_m) < SurfaceSidesParameters::kOwnSheet_m) continue;
    (distance_m > 0.f ? before : behind).Add(std::abs(distance_m));
  }
  if (behind.IsSheet() && before.num < SurfaceSidesParameters::kMinPoints) return normal;
  if (before.IsSheet() && behind.num < SurfaceSidesParameters::kMinPoints) return -normal;
  return Eigen::Vector3f::Zero();
}

// A few points beside things that happen to lie in parallel are not a sheet: a side holds where
// enough points of the voxel share it, up to a sign along each axis.
void ForgetFewSides(std::span<const Eigen::Vector3f> points, std::span<Eigen::Vector3f> sides) {
  struct Counts {
    int num = 0;
    std::array<int, 6> num_along{};  // x, y, z, and against them
  };
  const auto axis_of = [](const Eigen::Vector3f& side) {
    Eigen::Index axis = 0;
    side.cwiseAbs().maxCoeff(&axis);
    return static_cast<std::size_t>(side[axis] > 0.f ? axis : axis + 3);
  };
  VoxelMap<Counts> voxels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Counts& counts = voxels.Of<Counts>(voxels.FindOrAdd(KeyOf(points[i])).voxel);
    ++counts.num;
    if (!sides[i].isZero(0.f)) ++counts.num_along[axis_of(sides[i])];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sides[i].isZero(0.f)) continue;
    const Counts& counts = voxels.Of<Counts>(voxels.Find(KeyOf(points[i])));
    if (counts.num_along[axis_of(sides[i])] < SurfaceSidesParameters::kMinShare * counts.num) {
      sides[i].setZero();
    }
  }
}

}  // namespace

std::vector<Eigen::Vector3f> SurfaceSides(std::span<const Eigen::Vector3f> points,
                                          const Workers& workers) {
  const Representatives thinned(points);
  const Neighbourhoods neighbourhoods(thinned.points);
  std::vector<Eigen::Vector3f> thinned_sides(thinned.points.size(), Eigen::Vector3f::Zero());
  workers.ForEachBlock(thinned.points.size(), [&](const Block& block) {
    std::vector<Eigen::Vector3f> offsets;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      neighbourhoods.Around(thinned.points[i], offsets);
      thinned_sides[i] = SideOf(offsets);
    }
  });
  ForgetFewSides(thinned.points, thinned_sides);
  std::vector<Eigen::Vector3f> sides;
  sides.reserve(points.size());
  for (const std::size_t i : thinned.of) sides.push_back(thinned_sides[i]);
  return sides;
}

}  // namespace lio
