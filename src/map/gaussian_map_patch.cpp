// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the sums of a cell into its patch: a plane, a vertical structure, or neither.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lio/map/gaussian_map.hpp"
#include "lio/map/grazing_incidence.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {

void GaussianMap::UpdatePatch(std::int32_t cell) {
  Sums& sums = voxels_.Of<Sums>(cell);
  SurfacePatch& patch = voxels_.Of<SurfacePatch>(cell);
  patch.mean = sums.mean.cast<float>();
  patch.num_points = static_cast<float>(sums.num_points);
  if (sums.num_points < options_.min_cell_points) return;
  if (sums.num_points < GaussianMapParameters::kRefitGrowth * sums.fitted_at) return;
  sums.fitted_at = sums.num_points;

  Matrix3 cov;
  cov << sums.xx, sums.xy, sums.xz, sums.xy, sums.yy, sums.yz, sums.xz, sums.yz, sums.zz;
  cov /= sums.num_points - 1;
  sums.is_known = FitPlane(cov, sums, patch) || (finds_vertical_ && FitVertical(cov, sums, patch));
  if (!sums.is_known) patch.thickness_var = 0.f;
}

void GaussianMap::SetRangeStd(double range_std_m) {
  constexpr double kUsual_m = GaussianMapParameters::kUsualRangeStd_m;
  range_std_m_ = range_std_m > 0.0 ? range_std_m : kUsual_m;
}

// The planes of a noisy lidar are thick, but no blob is a plane.
bool GaussianMap::IsThin(double thickness_var, double width_var) const {
  constexpr double kUsual_m = GaussianMapParameters::kUsualRangeStd_m;
  const double noise_var = std::max(0.0, range_std_m_ * range_std_m_ - kUsual_m * kUsual_m);
  return thickness_var < GaussianMapParameters::kMaxThicknessRatio * width_var + noise_var &&
         thickness_var < GaussianMapParameters::kMaxNoisyThicknessRatio * width_var;
}

Roughness GaussianMap::RoughnessOf(double variance, float sine) const {
  constexpr double kEven_m = GaussianMapParameters::kEvenStd_m;
  const double noise_m = static_cast<double>(sine) * range_std_m_;
  const double rough_var = variance - noise_m * noise_m - kEven_m * kEven_m;
  return {static_cast<float>(std::sqrt(std::max(0.0, rough_var))), sine};
}

bool GaussianMap::FitPlane(const Matrix3& cov, const Sums& sums, SurfacePatch& patch) const {
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(cov);
  const Vector3 variance = eigen.eigenvalues();  // ascending
  const double thickness =
      std::max(variance[0], options_.min_surface_std_m * options_.min_surface_std_m);
  const double min_width = GaussianMapParameters::kMinWidthPerVoxel * options_.voxel_m;
  const Eigen::Vector3f normal = eigen.eigenvectors().col(0).cast<float>();
  const bool is_view_known = !sums.view.isZero(0.f);
  const bool is_plane = variance[1] > min_width * min_width && IsThin(variance[0], variance[1]) &&
                        thickness < GaussianMapParameters::kMaxNormalStd_rad *
                                        GaussianMapParameters::kMaxNormalStd_rad * sums.num_points *
                                        variance[1] &&
                        !(is_view_known && IsGrazing(normal, sums.view));
  if (!is_plane) return false;
  if (!sums.is_kept) patch.is_two_sided = !is_view_known;
  patch.kind = SurfacePatch::Kind::kPlane;
  patch.thickness_var = static_cast<float>(thickness);
  patch.normal = normal.dot(sums.view) > 0.f ? Eigen::Vector3f(-normal) : normal;
  const bool is_beam_known = is_view_known && !sums.is_kept;  // a saved map has sides, not beams
  patch.roughness =
      is_beam_known ? RoughnessOf(variance[0], std::abs(normal.dot(sums.view))) : Roughness();
  patch.tangent1_per_std = (eigen.eigenvectors().col(1) / std::sqrt(variance[1])).cast<float>();
  patch.tangent2_per_std = (eigen.eigenvectors().col(2) / std::sqrt(variance[2])).cast<float>();
  return true;
}

// Tells whether the last scan's points lie farther off those before it than noise explains.
bool GaussianMap::HasShifted(const LevelSpread& spread, const Sums& sums) {
  const double num_before = sums.num_before;
  const double num_last = sums.num_points - sums.num_before;
  if (sums.is_kept || num_before <= 0.0 || num_last <= 0.0) return false;
  const Vector3 mean_shift = sums.mean - sums.mean_before.cast<double>();
  const Eigen::Array2d shift = spread.axes.transpose() * mean_shift * (sums.num_points / num_last);
  constexpr double kSigmas = GaussianMapParameters::kShift_sigmas;
  constexpr double kShift_m = GaussianMapParameters::kMaxShift_m;
  const Eigen::Array2d noise_var = spread.variance.array() * (1.0 / num_before + 1.0 / num_last);
  return (shift.square() > kSigmas * kSigmas * noise_var + kShift_m * kShift_m).any();
}

GaussianMap::LevelSpread GaussianMap::LevelSpreadOf(const Matrix3& cov) const {
  const Vector3 level1 = up_map_.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> level;
  level << level1, up_map_.cross(level1);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(level.transpose() * cov * level);
  return {level * eigen.eigenvectors(), eigen.eigenvalues()};
}

// It must be narrow: one that fills the cell is cut off by the cell's sides. And it must be
// slender.
bool GaussianMap::IsPost(const LevelSpread& spread, double height_var) const {
  const double max_width = GaussianMapParameters::kMaxVerticalWidthPerVoxel * options_.voxel_m;
  constexpr double kMinSlenderness = GaussianMapParameters::kMinVerticalSlenderness;
  const double width_var = spread.variance[1];
  return width_var <= max_width * max_width &&
         width_var * kMinSlenderness * kMinSlenderness <= height_var;
}

// Points that fill the cell evenly stay where they are when the clump moves, and tell nothing: the
// variance grows beyond bounds as they come near to that.
std::optional<Eigen::Vector2d> GaussianMap::ClumpVariance(const LevelSpread& spread,
                                                          int num_points) const {
  const double even_var = options_.voxel_m * options_.voxel_m / 12.0;
  if (num_points < GaussianMapParameters::kMinClumpPoints || spread.variance[1] >= even_var)
    return std::nullopt;
  return spread.variance.array() / (1.0 - spread.variance.array() / even_var);
}

// A part of a wall that a cell's side cuts off, or that few rings cross, is as narrow and tall as a
// post; but beside the cell the wall goes on. Returns that wall's normal, or zero.
Eigen::Vector3f GaussianMap::WallNormalOf(std::int32_t cell) const {
  const SurfacePatch& post = patch(cell);
  if (post.thickness_var <= 0.f) return Eigen::Vector3f::Zero();
  const Vector3 across = options_.voxel_m * post.normal.cast<double>();
  const Vector3 along = options_.voxel_m * post.tangent1_per_std.normalized().cast<double>();
  for (const Vector3& to_beside : {across, Vector3(-across), along, Vector3(-along)}) {
    if (const auto normal = WallBeside(cell, to_beside)) return *normal;
  }
  return Eigen::Vector3f::Zero();
}

// Returns the normal of the plane beside the cell if it stands and the cell's points lie on it.
std::optional<Eigen::Vector3f> GaussianMap::WallBeside(std::int32_t cell,
                                                       const Vector3& to_beside) const {
  const Vector3 mean = CentreOf(voxels_.key(cell)) + patch(cell).mean.cast<double>();
  const Hit beside = Find(mean + to_beside);
  if (beside.cell == kNoCell || beside.cell == cell) return std::nullopt;
  const SurfacePatch& wall = patch(beside.cell);
  if (wall.thickness_var <= 0.f || wall.kind != SurfacePatch::Kind::kPlane) return std::nullopt;
  const float sine = std::abs(wall.normal.dot(up_map_.cast<float>()));
  if (sine > GaussianMapParameters::kMaxWallSine) return std::nullopt;
  const Eigen::Vector3f from_wall = beside.local - to_beside.cast<float>() - wall.mean;
  const bool is_on = std::abs(wall.normal.dot(from_wall)) < GaussianMapParameters::kMaxOffWall_m;
  return is_on ? std::optional(wall.normal) : std::nullopt;
}

// A vertical structure is seen in the same place from everywhere, as rings on the ground are not.
// It holds still: what each scan sees farther on is a thing that moves.
bool GaussianMap::FitVertical(const Matrix3& cov, const Sums& sums, SurfacePatch& patch) const {
  const double min_height = GaussianMapParameters::kMinHeightPerVoxel * options_.voxel_m;
  const double height_var = up_map_.dot(cov * up_map_);
  if (height_var < min_height * min_height) return false;
  const LevelSpread spread = LevelSpreadOf(cov);
  if (HasShifted(spread, sums)) return false;
  std::optional<Eigen::Vector2d> variance = spread.variance;
  if (!IsPost(spread, height_var)) variance = ClumpVariance(spread, sums.num_points);
  if (!variance) return false;
  *variance = variance->cwiseMax(GaussianMapParameters::kMinVerticalStd_m *
                                 GaussianMapParameters::kMinVerticalStd_m);
  patch.kind = SurfacePatch::Kind::kVertical;
  patch.thickness_var = static_cast<float>((*variance)[0]);
  patch.normal = spread.axes.col(0).cast<float>();
  patch.tangent1_per_std = (spread.axes.col(1) / std::sqrt((*variance)[1])).cast<float>();
  patch.tangent2_per_std.setZero();
  return true;
}

}  // namespace lio
