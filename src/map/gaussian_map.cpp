// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/gaussian_map.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "lio/map/grazing_incidence.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

// Is a point, given from the voxel's centre, on the plane?
bool IsOn(const SurfacePatch& patch, const Eigen::Vector3f& local) {
  const float off = patch.normal.dot(local - patch.mean);
  constexpr float kSigmas = GaussianMapParameters::kOnPlane_sigmas;
  return off * off < kSigmas * kSigmas * patch.thickness_var;
}

}  // namespace

GaussianMap::GaussianMap(const NdtOptions& options, bool finds_vertical)
    : options_(options), finds_vertical_(finds_vertical), inverse_voxel_(1.0 / options.voxel_m) {
  if (!(options.voxel_m > 0) || options.min_cell_points < 3 ||
      options.max_cell_points <= options.min_cell_points || options.max_cells < 1) {
    throw std::invalid_argument("GaussianMap: voxel_m, cell points or max_cells out of range");
  }
}

Vector3 GaussianMap::CentreOf(VoxelKey key) const {
  const VoxelCell voxel = UnpackVoxel(key);
  return options_.voxel_m * (Vector3(voxel[0], voxel[1], voxel[2]).array() + 0.5);
}

GaussianMap::Place GaussianMap::PlaceOf(const Vector3& point_map) const {
  const Vector3 scaled = inverse_voxel_ * point_map;
  if (!IsVoxel(scaled)) return {kNoVoxel, Eigen::Vector3f::Zero()};
  const std::int32_t x = FloorToInt(scaled.x());
  const std::int32_t y = FloorToInt(scaled.y());
  const std::int32_t z = FloorToInt(scaled.z());
  const Vector3 from_centre(scaled.x() - x - 0.5, scaled.y() - y - 0.5, scaled.z() - z - 0.5);
  return {PackVoxel(x, y, z), (options_.voxel_m * from_centre).cast<float>()};
}

GaussianMap::Hit GaussianMap::Find(const Vector3& point_map) const {
  const Place place = PlaceOf(point_map);
  return {voxels_.Find(place.key), place.local};
}

void GaussianMap::FindAll(std::span<const Vector3> points_map, std::span<Hit> hits) const {
  std::array<Place, GaussianMapParameters::kPrefetchDistance> places;
  for (std::size_t begin = 0; begin < points_map.size();
       begin += GaussianMapParameters::kPrefetchDistance) {
    const std::size_t count =
        std::min(GaussianMapParameters::kPrefetchDistance, points_map.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      places[i] = PlaceOf(points_map[begin + i]);
      voxels_.Prefetch(places[i].key);
    }
    for (std::size_t i = 0; i < count; ++i) {
      Hit& hit = hits[begin + i];
      hit = {voxels_.Find(places[i].key), places[i].local};
      if (hit.cell != kNoCell) __builtin_prefetch(&patch(hit.cell));
    }
  }
}

float GaussianMap::ShareOfLastScan(std::int32_t cell) const {
  const Sums& sums = voxels_.Of<Sums>(cell);
  if (sums.is_kept || sums.touched != scan_number_ || sums.num_points == 0) return 0.f;
  return 1.f - static_cast<float>(sums.num_before) / static_cast<float>(sums.num_points);
}

void GaussianMap::Remove(std::int32_t cell) {
  voxels_.Remove(cell);
  voxels_.Of<SurfacePatch>(cell) = {};
}

// Makes Welford's update. A cell that shows neither a plane nor a vertical structure forgets slowly
// instead of freezing; otherwise a cell filled by single rings while parked would stay a line for
// ever.
void GaussianMap::AddPoint(Sums& sums, const Vector3& local, const Eigen::Vector3f& view) const {
  const int most = sums.is_known ? options_.max_cell_points
                                 : std::min(options_.max_cell_points,
                                            GaussianMapParameters::kUnknownMemory_points);
  if (sums.num_points >= most) {
    const double keep = 1.0 - 1.0 / sums.num_points;
    for (double* sum : {&sums.xx, &sums.xy, &sums.xz, &sums.yy, &sums.yz, &sums.zz}) *sum *= keep;
    sums.fitted_at = 0;
  } else {
    ++sums.num_points;
  }
  if (!sums.is_kept) sums.view += (view - sums.view) / static_cast<float>(sums.num_points);
  const Vector3 before = local - sums.mean;
  sums.mean += before / sums.num_points;
  const Vector3 after = local - sums.mean;
  sums.xx += before.x() * after.x();
  sums.xy += before.x() * after.y();
  sums.xz += before.x() * after.z();
  sums.yy += before.y() * after.y();
  sums.yz += before.y() * after.z();
  sums.zz += before.z() * after.z();
}

void GaussianMap::FindCells() {
  cells_.clear();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (i + GaussianMapParameters::kPrefetchDistance < places_.size())
      voxels_.Prefetch(places_[i + GaussianMapParameters::kPrefetchDistance].key);
    const VoxelKey key = places_[i].key;
    cells_.push_back(key == kNoVoxel ? kNoCell : voxels_.FindOrAdd(key).voxel);
  }
}

void GaussianMap::Insert(std::span<const Vector3> points_map, const Vector3& sensor_map,
                         const Workers& workers, const SeenBeams& beams) {
  const auto view_of = [&](std::size_t i) -> Eigen::Vector3f {
    return (points_map[i] - sensor_map).cast<float>().normalized();
  };
  Add(points_map, view_of, workers, beams);
  DropPassedCells(points_map, sensor_map);
  DropOldCells();
  DropFarCells(sensor_map);
}

// Two sheets that share a cell cannot both be its surface: those that look up, and one of two
// walls, come first. Points whose side nobody knows come last, and only onto a surface that is
// there.
void GaussianMap::InsertKept(std::span<const Vector3> points_map,
                             std::span<const Eigen::Vector3f> sides, const Workers& workers) {
  const Eigen::Vector3f first =
      (up_map_ + GaussianMapParameters::kLevelShare * up_map_.unitOrthogonal()).cast<float>();
  std::array<std::vector<std::size_t>, 3> groups;
  for (std::size_t i = 0; i < points_map.size(); ++i) {
    const float towards = sides[i].dot(first);
    groups[sides[i].isZero(0.f) ? 2 : towards < 0.f ? 1 : 0].push_back(i);
  }
  std::vector<std::int32_t> kept;
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<Vector3> points;
    points.reserve(group.size());
    for (const std::size_t i : group) points.push_back(points_map[i]);
    const auto view_of = [&](std::size_t i) -> Eigen::Vector3f { return -sides[group[i]]; };
    Add(points, view_of, workers);
    kept.insert(kept.end(), touched_cells_.begin(), touched_cells_.end());
  }
  for (const std::int32_t cell : kept) {
    Sums& sums = voxels_.Of<Sums>(cell);
    if (!std::exchange(sums.is_kept, true)) ++num_kept_;
    // Its side is that which half of its points have.
    voxels_.Of<SurfacePatch>(cell).is_two_sided =
        sums.view.norm() < GaussianMapParameters::kMinView;
  }
}

template <class ViewOf>
void GaussianMap::Add(std::span<const Vector3> points_map, const ViewOf& view_of,
                      const Workers& workers, const SeenBeams& beams) {
  places_.resize(points_map.size());
  workers.ForEachBlock(points_map.size(), [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) places_[i] = PlaceOf(points_map[i]);
  });
  FindCells();
  AddPoints(view_of, beams);
  workers.ForEachBlock(touched_cells_.size(), [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) UpdatePatch(touched_cells_[i]);
  });
  if (!finds_vertical_) return;
  workers.ForEachBlock(touched_cells_.size(), [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      SurfacePatch& patch = voxels_.Of<SurfacePatch>(touched_cells_[i]);
      if (patch.kind != SurfacePatch::Kind::kVertical) continue;
      patch.tangent2_per_std = WallNormalOf(touched_cells_[i]);
    }
  });
}

// Fetches the sums that AddPoints() will change.
void GaussianMap::Prefetch(std::int32_t cell) const {
  if (cell == kNoCell) return;
  const auto* sums = reinterpret_cast<const char*>(&voxels_.Of<Sums>(cell));
  __builtin_prefetch(sums);
  __builtin_prefetch(sums + sizeof(Sums) - 1);
}

template <class ViewOf>
void GaussianMap::AddPoints(const ViewOf& view_of, const SeenBeams& beams) {
  ++scan_number_;
  touched_cells_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i + GaussianMapParameters::kPrefetchDistance < cells_.size())
      Prefetch(cells_[i + GaussianMapParameters::kPrefetchDistance]);
    const std::int32_t cell = cells_[i];
    if (cell == kNoCell) continue;
    Sums& sums = voxels_.Of<Sums>(cell);
    const bool is_frozen = sums.is_known && sums.num_points >= options_.max_cell_points;
    if (sums.touched != scan_number_) {
      if (sums.touched == 0) sums.listed = scan_number_;
      sums.touched = scan_number_;
      sums.num_before = sums.num_points;
      sums.mean_before = sums.mean.cast<float>();
      if (!is_frozen) touched_cells_.push_back(cell);
    }
    if (is_frozen) continue;
    const Eigen::Vector3f view = view_of(i);
    const SurfacePatch& patch = voxels_.Of<SurfacePatch>(cell);
    const bool is_plane = sums.is_known && patch.kind == SurfacePatch::Kind::kPlane;
    if (is_plane) {
      const bool is_seen_from_anywhere = patch.is_two_sided || view.isZero(0.f);
      const bool is_of_another =
          is_seen_from_anywhere ? !IsOn(patch, places_[i].local) : IsFromBehind(patch.normal, view);
      if (is_of_another) continue;
    }
    AddPoint(sums, places_[i].local.cast<double>(), view);
    if (is_plane && i % SeenBeams::kSampling == 0 && !beams.beams.empty()) {
      voxels_.Of<CellBeams>(cell).Add(beams.beams[i / SeenBeams::kSampling], patch.normal,
                                      beams.path_m);
    }
  }
}

// Drops the cells that were touched longest ago. Touching a cell only notes the scan: to keep all
// cells in order would cost a tenth of the insertion. A cell whose turn comes though it was touched
// since then is put last.
void GaussianMap::DropOldCells() {
  while (num_cells() - num_kept_ > static_cast<std::size_t>(options_.max_cells)) {
    const std::int32_t cell = voxels_.oldest();
    Sums& sums = voxels_.Of<Sums>(cell);
    if (sums.is_kept) {
      voxels_.Touch(cell);
    } else if (sums.listed == sums.touched) {
      Remove(cell);
    } else {
      sums.listed = sums.touched;
      voxels_.Touch(cell);
    }
  }
}

void GaussianMap::DropFarCells(const Vector3& sensor_map) {
  if (cell_capacity() == 0) return;
  const std::size_t num_to_visit = cell_capacity() / GaussianMapParameters::kFarCellsWalk_scans + 1;
  const double limit_sq = options_.max_distance_m * options_.max_distance_m;
  for (std::size_t i = 0; i < num_to_visit; ++i) {
    if (++sweep_position_ >= cell_capacity()) sweep_position_ = 0;
    const auto cell = static_cast<std::int32_t>(sweep_position_);
    if (!voxels_.IsUsed(cell) || voxels_.Of<Sums>(cell).is_kept) continue;
    if ((CentreOf(voxels_.key(cell)) - sensor_map).squaredNorm() > limit_sq) Remove(cell);
  }
}

}  // namespace lio
