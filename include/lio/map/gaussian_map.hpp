// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a bounded map of surface patches, the normal-distributions transform of the scans: hashed
// voxels, each with the running mean and covariance of the points that fell into it, and from them,
// where they show one, a plane or a vertical structure: a post, a trunk, a clump of leaves.
//
// A cell whose points show neither is rank-deficient and does not count: cells filled from a
// standing vehicle hold single scan rings, which look like lines and hold the vehicle back by
// metres when it drives off. A ring that cuts through a tree's crown even looks like a plane, which
// is seen at grazing incidence (grazing_incidence.hpp). Sums are kept relative to the voxel's
// centre, so that precision does not depend on the distance from the origin. Not safe for
// concurrent use while inserting. Sources: Biber, Strasser, "The Normal Distributions Transform",
// IROS 2003; Magnusson, "The Three-Dimensional Normal-Distributions Transform", dissertation,
// Orebro 2009, chapter 6. Differences: cells are planes or vertical structures and not any
// Gaussian, and they are hashed and grow with each scan (map_parameters.hpp has the limits).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lio/base/parallel.hpp"
#include "lio/base/rotation.hpp"
#include "lio/base/voxel_map.hpp"
#include "lio/map/cell_beams.hpp"
#include "lio/map/map_parameters.hpp"
#include "lio/map/ndt_options.hpp"
#include "lio/map/roughness.hpp"

namespace lio {

// Holds the part of a cell that matching reads: one cache line. Vectors are in the map's frame,
// `mean` from the voxel's centre.
struct alignas(64) SurfacePatch {
  // A plane constrains the pose along `normal`, which points to the side it was seen from. A
  // vertical structure constrains it in two horizontal directions: along `normal`, and along
  // tangent1_per_std, which is a direction over its standard deviation.
  enum class Kind : std::uint8_t { kPlane, kVertical } kind = Kind::kPlane;
  // A plane whose normal may point to either side, since its points are those of a saved map.
  // Points far off it are of another surface.
  bool is_two_sided = false;
  Roughness roughness;  // zero if nobody knows from where the plane was seen
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  float thickness_var = 0.f;  // variance along the normal, floored; 0: the cell does not count
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float num_points = 0.f;
  Eigen::Vector3f tangent1_per_std = Eigen::Vector3f::Zero();  // tangent / sqrt(its variance)
  // A vertical structure has here the unit normal of the wall that it is a part of, or zero.
  Eigen::Vector3f tangent2_per_std = Eigen::Vector3f::Zero();

  [[nodiscard]] const Eigen::Vector3f& wall_normal() const { return tangent2_per_std; }
};

class GaussianMap {
 public:
  static constexpr std::int32_t kNoCell = VoxelIndex::kNone;

  // `finds_vertical`: do cells show vertical structures, too, and not planes alone? Throws
  // std::invalid_argument when an option is out of its range.
  explicit GaussianMap(const NdtOptions& options, bool finds_vertical = true);

  struct Hit {
    std::int32_t cell = kNoCell;  // index for patch(); kNoCell where the map is empty
    Eigen::Vector3f local = Eigen::Vector3f::Zero();  // the point from the voxel's centre
  };
  [[nodiscard]] Hit Find(const Vector3& point_map) const;
  // hits[i] = Find(points_map[i]) for all of them, several times faster: memory is fetched ahead.
  void FindAll(std::span<const Vector3> points_map, std::span<Hit> hits) const;
  const SurfacePatch& patch(std::int32_t cell) const { return voxels_.Of<SurfacePatch>(cell); }
  [[nodiscard]] bool IsFrozen(std::int32_t cell) const {
    return patch(cell).thickness_var > 0.f &&
           patch(cell).num_points >= static_cast<float>(options_.max_cell_points);
  }

  // Returns the share of the cell's points that the last scan brought; zero where it brought none,
  // and in cells that stay for good.
  [[nodiscard]] float ShareOfLastScan(std::int32_t cell) const;

  // Sets the vertical's direction in the map's frame, of any length.
  void SetUp(const Vector3& up_map) { up_map_ = up_map.normalized(); }

  // Sets the noise of ranges of the scans to come, 1 sigma [m].
  void SetRangeStd(double range_std_m);

  // Returns the beams that the points of a plane came from.
  const CellBeams& beams(std::int32_t cell) const { return voxels_.Of<CellBeams>(cell); }

  // Adds a scan taken from `sensor_map`; then drops cells through whose surface its rays pass,
  // those that are too far from there and, beyond max_cells, those without new points for longest.
  void Insert(std::span<const Vector3> points_map, const Vector3& sensor_map,
              const Workers& workers = Workers(1), const SeenBeams& beams = {});

  // Adds points of which nobody knows where they were seen from, such as those of a saved map.
  // `sides` (surface_sides.hpp): of each point. Their cells stay for good: they are neither dropped
  // nor counted for max_cells.
  void InsertKept(std::span<const Vector3> points_map, std::span<const Eigen::Vector3f> sides,
                  const Workers& workers = Workers(1));

  std::size_t num_cells() const { return voxels_.size(); }
  // Returns an upper bound of cell indices, for scratch arrays beside the map.
  std::size_t cell_capacity() const { return voxels_.capacity(); }
  std::size_t memory_bytes() const { return voxels_.memory_bytes(); }

 private:
  struct Place {
    VoxelKey key = 0;       // kNoVoxel: out of range, or no number
    Eigen::Vector3f local;  // the point from the voxel's centre
  };
  struct Sums {
    Vector3 mean = Vector3::Zero();                         // from the voxel's centre
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // sums over deviations from the mean
    Eigen::Vector3f view = Eigen::Vector3f::Zero();         // mean direction from the sensor
    std::int32_t num_points = 0;
    std::int32_t fitted_at = 0;   // num_points when the patch was last computed
    std::uint32_t touched = 0;    // number of the last scan that added to it
    std::int32_t num_before = 0;  // points before that scan, and their mean
    Eigen::Vector3f mean_before = Eigen::Vector3f::Zero();
    std::uint32_t listed = 0;        // ... when the cell was put last in the order of age
    std::uint32_t passed_since = 0;  // `touched` when rays began to pass through
    std::int32_t num_passed = 0;     // rays since then
    bool is_known = false;           // the points show a plane or a vertical structure
    bool is_kept = false;
  };

  Place PlaceOf(const Vector3& point_map) const;
  // Finds or makes each place's cell.
  void FindCells();
  // `view_of(i)` points along the beam that saw the point, unit; or is zero.
  template <class ViewOf>
  void Add(std::span<const Vector3> points_map, const ViewOf& view_of, const Workers& workers,
           const SeenBeams& beams = {});
  template <class ViewOf>
  void AddPoints(const ViewOf& view_of, const SeenBeams& beams);
  void Prefetch(std::int32_t cell) const;
  void AddPoint(Sums& sums, const Vector3& local, const Eigen::Vector3f& view) const;
  void Remove(std::int32_t cell);
  void DropOldCells();
  void DropFarCells(const Vector3& sensor_map);
  Vector3 CentreOf(VoxelKey key) const;

  // These are in gaussian_map_rays.cpp.
  void DropPassedCells(std::span<const Vector3> points_map, const Vector3& sensor_map);
  void NoteRay(const Vector3& sensor_map, const Vector3& point_map);
  void NotePass(std::int32_t cell);

  // These are in gaussian_map_patch.cpp.
  void UpdatePatch(std::int32_t cell);
  [[nodiscard]] bool IsThin(double thickness_var, double width_var) const;
  bool FitPlane(const Matrix3& cov, const Sums& sums, SurfacePatch& patch) const;
  // `variance`: of the points across the plane.
  [[nodiscard]] Roughness RoughnessOf(double variance, float sine) const;
  bool FitVertical(const Matrix3& cov, const Sums& sums, SurfacePatch& patch) const;
  struct LevelSpread {
    Eigen::Matrix<double, 3, 2> axes;  // level, orthonormal
    Eigen::Vector2d variance;          // the points' along them, ascending [m^2]
  };
  [[nodiscard]] LevelSpread LevelSpreadOf(const Matrix3& cov) const;
  [[nodiscard]] static bool HasShifted(const LevelSpread& spread, const Sums& sums);
  [[nodiscard]] bool IsPost(const LevelSpread& spread, double height_var) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> ClumpVariance(const LevelSpread& spread,
                                                             int num_points) const;
  [[nodiscard]] Eigen::Vector3f WallNormalOf(std::int32_t cell) const;
  [[nodiscard]] std::optional<Eigen::Vector3f> WallBeside(std::int32_t cell,
                                                          const Vector3& to_beside) const;

  NdtOptions options_;
  bool finds_vertical_;
  double inverse_voxel_;
  Vector3 up_map_ = Vector3::UnitZ();
  double range_std_m_ = GaussianMapParameters::kUsualRangeStd_m;  // noise of the ranges
  VoxelMap<SurfacePatch, Sums, CellBeams> voxels_;
  // Insert() uses these as scratch.
  std::vector<Place> places_;
  std::vector<std::int32_t> cells_;  // one per place
  std::vector<std::int32_t> touched_cells_;
  std::vector<Vector3> on_ray_map_;  // places along a ray, and what is there
  std::vector<Hit> on_ray_;
  std::size_t num_kept_ = 0;
  std::size_t sweep_position_ = 0;  // next cell of the walk that looks for far ones
  std::uint32_t scan_number_ = 0;
};

}  // namespace lio
