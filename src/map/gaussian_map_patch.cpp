// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the sums of a cell into its patch: a plane, a vertical structure, or neither.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "lio/map/gaussian_map.hpp"
#include "lio/map/grazing_incidence.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

// Splits the spread of points into that along the vertical and that across it.
struct Upright {
  Upright(const Matrix3& cov, const Vector3& up) : height_var(up.dot(cov * up)) {
    Eigen::Matrix<double, 3, 2> level;
    level.col(0) = up.unitOrthogonal();
    level.col(1) = up.cross(level.col(0));
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(level.transpose() * cov * level);
    width_var = eigen.eigenvalues();
    axes = level * eigen.eigenvectors();
  }
  [[nodiscard]] bool IsSlender() const {
    constexpr double kMin = GaussianMapParameters::kMinVerticalSlenderness;
    return width_var[1] * kMin * kMin <= height_var;
  }

  double height_var;
  Eigen::Vector2d width_var;         // ascending
  Eigen::Matrix<double, 3, 2> axes;  // their directions
};

// Returns the steps to the eight cells around one, on the grid's plane that is nearest to level.
std::array<VoxelCell, 8> LevelSteps(const Vector3& up) {
  Eigen::Index up_axis = 0;
  up.cwiseAbs().maxCoeff(&up_axis);
  const auto a = static_cast<std::size_t>((up_axis + 1) % 3);
  const auto b = static_cast<std::size_t>((up_axis + 2) % 3);
  std::array<VoxelCell, 8> steps{};
  std::size_t num = 0;
  for (const int step_a : {-1, 0, 1}) {
    for (const int step_b : {-1, 0, 1}) {
      if (step_a == 0 && step_b == 0) continue;
      steps[num][a] = step_a;
      steps[num++][b] = step_b;
    }
  }
  return steps;
}

VoxelKey Stepped(VoxelKey key, const VoxelCell& step) {
  const VoxelCell voxel = UnpackVoxel(key);
  return PackVoxel(voxel[0] + step[0], voxel[1] + step[1], voxel[2] + step[2]);
}

}  // namespace

Matrix3 GaussianMap::Sums::JointCovariance(const Sums& other, const Vector3& offset) const {
  const double num = num_points + other.num_points;
  const Vector3 apart = offset + other.mean - mean;
  return (Scatter() + other.Scatter() +
          num_points * other.num_points / num * apart * apart.transpose()) /
         (num - 1);
}

void GaussianMap::UpdatePatch(std::int32_t cell) {
  Sums& sums = voxels_.Of<Sums>(cell);
  SurfacePatch& patch = voxels_.Of<SurfacePatch>(cell);
  patch.mean = sums.mean.cast<float>();
  patch.num_points = static_cast<float>(sums.num_points);
  if (sums.num_points < options_.min_cell_points) return;
  if (sums.num_points < GaussianMapParameters::kRefitGrowth * sums.fitted_at) return;
  sums.fitted_at = sums.num_points;

  sums.is_known =
      FitPlane(sums, patch) || (finds_vertical_ && FitUpright(cell, sums.Covariance(), patch));
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

bool GaussianMap::FitPlane(const Sums& sums, SurfacePatch& patch) const {
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(sums.Covariance());
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

// What is upright and narrow is a vertical structure, or else a part of what is wider in the cell
// beside it: the cell's side cuts it off, or few beams meet it.
bool GaussianMap::FitUpright(std::int32_t cell, const Matrix3& cov, SurfacePatch& patch) const {
  const double min_height = GaussianMapParameters::kMinHeightPerVoxel * options_.voxel_m;
  const double max_width = GaussianMapParameters::kMaxVerticalWidthPerVoxel * options_.voxel_m;
  const Upright upright(cov, up_map_);
  if (upright.height_var < min_height * min_height) return false;
  if (upright.width_var[1] > max_width * max_width) return false;
  if (!upright.IsSlender()) return false;
  if (const std::int32_t beside = WiderBeside(cell); beside != kNoCell) {
    return TakeNormal(beside, cov, upright.width_var[1], patch);
  }
  const Eigen::Vector2d variance = upright.width_var.cwiseMax(
      GaussianMapParameters::kMinVerticalStd_m * GaussianMapParameters::kMinVerticalStd_m);
  patch.kind = SurfacePatch::Kind::kVertical;
  patch.thickness_var = static_cast<float>(variance[0]);
  patch.normal = upright.axes.col(0).cast<float>();
  patch.tangent1_per_std = (upright.axes.col(1) / std::sqrt(variance[1])).cast<float>();
  patch.tangent2_per_std.setZero();
  return true;
}

std::int32_t GaussianMap::WiderBeside(std::int32_t cell) const {
  const Sums& sums = voxels_.Of<Sums>(cell);
  const double min_points = GaussianMapParameters::kMinShareBeside * sums.num_points;
  std::int32_t wider = kNoCell;
  std::int32_t most_points = 0;
  for (const VoxelCell& step : LevelSteps(up_map_)) {
    const std::int32_t next = voxels_.Find(Stepped(voxels_.key(cell), step));
    if (next == kNoCell) continue;
    const Sums& other = voxels_.Of<Sums>(next);
    if (other.num_points < min_points || other.num_points <= most_points) continue;
    const Vector3 offset = options_.voxel_m * Vector3(step[0], step[1], step[2]);
    if (Upright(sums.JointCovariance(other, offset), up_map_).IsSlender()) continue;
    wider = next;
    most_points = other.num_points;
  }
  return wider;
}

// The patch keeps its own mean: walls have steps, but few turns.
bool GaussianMap::TakeNormal(std::int32_t beside, const Matrix3& cov, double width_var,
                             SurfacePatch& patch) const {
  const Sums& other = voxels_.Of<Sums>(beside);
  SurfacePatch wall;
  if (other.num_points < options_.min_cell_points || !FitPlane(other, wall)) return false;
  const Vector3 normal = wall.normal.cast<double>();
  if (!IsThin(normal.dot(cov * normal), width_var)) return false;
  wall.mean = patch.mean;
  wall.num_points = patch.num_points;
  wall.is_two_sided = patch.is_two_sided;
  patch = wall;
  return true;
}

}  // namespace lio
