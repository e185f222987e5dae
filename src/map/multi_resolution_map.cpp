// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/multi_resolution_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

// Cells of half the size are four times as many on the same surfaces.
int ShareOfCells(int level, int num_levels, int max_cells) {
  double sum = 0.0;
  for (int i = 0; i < num_levels; ++i) sum += std::ldexp(1.0, -2 * i);
  return std::max(1, static_cast<int>(max_cells * std::ldexp(1.0, -2 * level) / sum));
}

}  // namespace

MultiResolutionMap::MultiResolutionMap(const NdtOptions& options, int num_finer, int num_coarser) {
  if (options.num_levels < 1 || options.num_levels > static_cast<int>(kMaxMapLevels)) {
    throw std::invalid_argument("MultiResolutionMap: num_levels out of range");
  }
  const int coarsest_option = num_finer + options.num_levels - 1;
  for (int level = 0; level <= coarsest_option + num_coarser; ++level) {
    NdtOptions at_level = options;
    at_level.voxel_m = std::ldexp(options.voxel_m, level - coarsest_option);
    at_level.max_cells = ShareOfCells(std::max(0, level - num_finer),
                                      options.num_levels + num_coarser, options.max_cells);
    const bool is_fine = level < coarsest_option;
    if (is_fine) {
      at_level.max_distance_m = std::min(
          options.max_distance_m, MultiResolutionParameters::kMaxDistance_edges * at_level.voxel_m);
    }
    levels_.emplace_back(at_level, !is_fine);
    edges_m_.push_back(at_level.voxel_m);
  }
}

std::size_t MultiResolutionMap::LevelFor(double std_m) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         std_m > MultiResolutionParameters::kMaxOff_edges * edges_m_[level]) {
    ++level;
  }
  return level;
}

// A block of points passes through the levels together, those without a surface to the next one.
struct MultiResolutionMap::Search {
  std::array<Vector3, Workers::kBlockSize> points;
  std::array<GaussianMap::Hit, Workers::kBlockSize> hits;
  std::array<std::size_t, Workers::kBlockSize> index;  // the points' indices
  std::size_t num = 0;
};

void MultiResolutionMap::FindAll(std::span<const Vector3> points_map, const Levels& levels,
                                 std::span<GaussianMap::Hit> hits) const {
  Search search;
  for (std::size_t begin = 0; begin < points_map.size(); begin += Workers::kBlockSize) {
    search.num = std::min(Workers::kBlockSize, points_map.size() - begin);
    for (std::size_t i = 0; i < search.num; ++i) {
      search.points[i] = points_map[begin + i];
      search.index[i] = begin + i;
    }
    for (std::size_t level = levels.finest; level <= levels.coarsest; ++level) {
      FindIn(level, level == levels.coarsest, search, hits);
    }
  }
}

void MultiResolutionMap::FindIn(std::size_t level, bool is_coarsest, Search& search,
                                std::span<GaussianMap::Hit> hits) const {
  levels_[level].FindAll({search.points.data(), search.num}, search.hits);
  std::size_t num_left = 0;
  for (std::size_t i = 0; i < search.num; ++i) {
    GaussianMap::Hit& hit = hits[search.index[i]];
    hit = search.hits[i];
    if (ShowsSurface(level, is_coarsest, hit.cell)) {
      hit.cell = Number(level, hit.cell);
      continue;
    }
    hit.cell = kNoCell;
    search.points[num_left] = search.points[i];
    search.index[num_left++] = search.index[i];
  }
  search.num = num_left;
}

void MultiResolutionMap::SetUp(const Vector3& up_map) {
  for (GaussianMap& level : levels_) level.SetUp(up_map);
}

void MultiResolutionMap::SetRangeStd(double range_std_m) {
  for (GaussianMap& level : levels_) level.SetRangeStd(range_std_m);
}

void MultiResolutionMap::Insert(std::span<const Vector3> points_map, const Vector3& sensor_map,
                                const Workers& workers, std::size_t finest,
                                const SeenBeams& beams) {
  for (std::size_t i = finest; i < levels_.size(); ++i) {
    levels_[i].Insert(points_map, sensor_map, workers, beams);
  }
}

void MultiResolutionMap::InsertKept(std::span<const Vector3> points_map,
                                    std::span<const Eigen::Vector3f> sides,
                                    const Workers& workers) {
  for (GaussianMap& level : levels_) level.InsertKept(points_map, sides, workers);
}

std::size_t MultiResolutionMap::num_cells() const {
  std::size_t num = 0;
  for (const GaussianMap& level : levels_) num += level.num_cells();
  return num;
}

std::size_t MultiResolutionMap::cell_capacity() const {
  std::size_t capacity = 0;
  for (const GaussianMap& level : levels_) capacity = std::max(capacity, level.cell_capacity());
  return capacity * levels_.size();
}

std::size_t MultiResolutionMap::memory_bytes() const {
  std::size_t bytes = 0;
  for (const GaussianMap& level : levels_) bytes += level.memory_bytes();
  return bytes;
}

}  // namespace lio
