// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/ndt_matcher.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr int kMinMatched = 50;
constexpr float kGateSq = 25.f;        // residuals beyond five sigma do not count
constexpr float kKernelWidthSq = 8.f;  // Geman-McClure: w = 1 / (1 + d^2/8)^2
// What is seen of an upright thing depends on the side it is seen from: its cell is off by this.
constexpr double kSideStd_m = 0.15;
constexpr double kMaxShiftStd_m = 0.02;  // a better known shift does without upright things
constexpr std::int32_t kNoSlot = -1;
constexpr float kMaxLever = 4.f;       // cap of a^2/l, where a patch is extrapolated
constexpr double kMinCurvature = 0.3;  // of the information; lower is a scene of outliers
constexpr double kReachShrink = 0.3;   // of the reach's standard deviation, each iteration
constexpr double kMinReach_m = 0.01;   // a smaller reach is none
constexpr double kMaxReach_m = 2.0;
constexpr double kMaxLastStep = 5e-3;  // m, rad
constexpr int kFarOffIterationFactor = 5;
constexpr double kReachLever_m = 20.0;  // range at which a rotation error of the guess is felt

// Fixed odd rotation between the map's axes and the voxel grid's.
const Pose& GridFromMap() {
  static const Pose kRotation{ExpSo3(Vector3(0.31, -0.23, 0.41)), Vector3(0.37, 0.41, 0.29)};
  return kRotation;
}

using Matrix6f = Eigen::Matrix<float, 6, 6>;
using Vector6f = Eigen::Matrix<float, 6, 1>;

Vector6f JacobianRow(const Eigen::Vector3f& point_imu, const Eigen::Vector3f& direction_imu) {
  Vector6f row;
  row << direction_imu, point_imu.cross(direction_imu);
  return row;
}

double InitialReach(const Matrix6& guess_cov) {
  const double translation_var = guess_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
  const double rotation_var = guess_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  const double reach = std::sqrt(std::max(0.0, translation_var) +
                                 std::max(0.0, rotation_var) * kReachLever_m * kReachLever_m);
  return std::min(reach, kMaxReach_m);
}

}  // namespace

struct NdtMatcher::System {
  // Gives the row's gradient.
  Vector6f Add(const Vector6f& jacobian, const Row& row, const Term& term) {
    const Matrix6f row_information = row.weight * jacobian * jacobian.transpose();
    const Vector6f row_gradient = (row.weight * row.distance) * jacobian;
    information += row_information.cast<double>();
    // d(w d)/dd: less than w, for the kernel gives way.
    curvature_sum += row.weight * (1.f - 4.f * term.kernel * term.distance_sq / kKernelWidthSq);
    information_sum += row.weight;
    gradient += row_gradient.cast<double>();
    weight_sum += term.kernel * term.kernel;
    residual_sq_sum += term.kernel * term.kernel * row.distance * row.distance;
    return row_gradient;
  }

  Matrix6 information = Matrix6::Zero();  // with the weights held
  Matrix6 feigned = Matrix6::Zero();      // information that the normals' noise alone would show
  Vector6 gradient = Vector6::Zero();
  double weight_sum = 0.0;
  double curvature_sum = 0.0;    // of the robust cost along the normals, and the same ...
  double information_sum = 0.0;  // ... with the weights held
  double residual_sq_sum = 0.0;
  int num_matched = 0;
};

// Gradients summed per cell: the parts of the score whose errors are independent.
struct NdtMatcher::Scores {
  struct Cell {
    Vector6f gradient = Vector6f::Zero();
    // What the gradient changes by when an upright cell is off by a metre, along its two
    // directions.
    std::array<Vector6f, 2> per_metre{Vector6f::Zero(), Vector6f::Zero()};
  };

  Cell& Of(std::int32_t cell) {
    std::int32_t& slot = slots[static_cast<std::size_t>(cell)];
    if (slot == kNoSlot) {
      slot = static_cast<std::int32_t>(cells.size());
      cells.emplace_back();
    }
    return cells[static_cast<std::size_t>(slot)];
  }
  Matrix6 Covariance() const;

  std::vector<std::int32_t>& slots;  // by the map's cell: index in cells
  std::vector<Cell> cells;
};

// With the usual correction for so few cells as six parameters count.
Matrix6 NdtMatcher::Scores::Covariance() const {
  Matrix6 scores = Matrix6::Zero();
  Matrix6 sides = Matrix6::Zero();
  for (const Cell& cell : cells) {
    const Vector6 gradient = cell.gradient.cast<double>();
    scores += gradient * gradient.transpose();
    for (const Vector6f& per_metre : cell.per_metre) {
      const Vector6 side = per_metre.cast<double>();
      sides += side * side.transpose();
    }
  }
  const auto num = static_cast<double>(cells.size());
  return num / std::max(1.0, num - 6.0) * scores + kSideStd_m * kSideStd_m * sides;
}

NdtMatcher::NdtMatcher(const NdtOptions& options) : options_(options), map_(options) {}

void NdtMatcher::Clear() {
  map_ = GaussianMap(options_);
}

void NdtMatcher::SetUp(const Vector3& up_map) {
  map_.SetUp(GridFromMap().rotation * up_map);
}

void NdtMatcher::Insert(const ScanView& scan, const Pose& T_map_imu) {
  const Pose T_grid_imu = GridFromMap() * T_map_imu;
  const Matrix3 rotation = T_grid_imu.rotation.toRotationMatrix();
  std::vector<Vector3> points_grid;
  points_grid.reserve(scan.points_imu.size());
  for (const Eigen::Vector3f& point : scan.points_imu) {
    points_grid.push_back(rotation * point.cast<double>() + T_grid_imu.translation);
  }
  map_.Insert(points_grid, T_grid_imu.translation);
}

void NdtMatcher::Associate(std::span<const Eigen::Vector3f> points, const Pose& T_grid_imu,
                           bool with_upright) {
  for (const Pair& pair : pairs_) cell_counts_[static_cast<std::size_t>(pair.cell)] = 0;
  pairs_.clear();
  paired_at_ = T_grid_imu;
  cell_counts_.resize(map_.cell_capacity(), 0);
  const Matrix3 rotation = T_grid_imu.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 point_grid = rotation * points[i].cast<double>() + T_grid_imu.translation;
    const GaussianMap::Hit hit = map_.Find(point_grid);
    if (hit.cell == GaussianMap::kNoCell) continue;
    const SurfacePatch& patch = map_.patch(hit.cell);
    if (patch.thickness_var <= 0.f) continue;
    if (patch.kind == SurfacePatch::Kind::kUpright && !with_upright) continue;
    pairs_.push_back({static_cast<std::int32_t>(i), hit.cell, hit.local - patch.mean});
    ++cell_counts_[static_cast<std::size_t>(hit.cell)];
  }
}

NdtMatcher::Term NdtMatcher::TermOf(const Pair& pair, float reach_var) const {
  return map_.patch(pair.cell).kind == SurfacePatch::Kind::kPlane ? PlaneTerm(pair, reach_var)
                                                                  : UprightTerm(pair, reach_var);
}

NdtMatcher::Term NdtMatcher::PlaneTerm(const Pair& pair, float reach_var) const {
  const SurfacePatch& patch = map_.patch(pair.cell);
  const float a1 = patch.tangent1_per_std.dot(pair.from_mean);
  const float a2 = patch.tangent2_per_std.dot(pair.from_mean);
  const float lever = 1.f + std::min(a1 * a1, kMaxLever) + std::min(a2 * a2, kMaxLever);
  const auto num_here = static_cast<float>(cell_counts_[static_cast<std::size_t>(pair.cell)]);
  const float variance =
      patch.thickness_var * (1.f + num_here / patch.num_points * lever) + reach_var;
  Term term;
  Row& row = term.rows[0];
  row.direction = patch.normal;
  row.distance = patch.normal.dot(pair.from_mean);
  term.distance_sq = row.distance * row.distance / variance;
  term.kernel = 1.f / (1.f + term.distance_sq / kKernelWidthSq);
  row.weight = term.kernel * term.kernel / variance;
  return term;
}

NdtMatcher::Term NdtMatcher::UprightTerm(const Pair& pair, float reach_var) const {
  const SurfacePatch& patch = map_.patch(pair.cell);
  const auto num_here = static_cast<float>(cell_counts_[static_cast<std::size_t>(pair.cell)]);
  const float shared = 1.f + num_here / patch.num_points;  // the mean's own error
  const float across_std = 1.f / patch.tangent1_per_std.norm();
  Term term;
  term.num_rows = 2;
  term.rows[0].direction = patch.normal;
  term.rows[1].direction = across_std * patch.tangent1_per_std;
  const std::array<float, 2> variance{patch.thickness_var * shared + reach_var,
                                      across_std * across_std * shared + reach_var};
  for (std::size_t i = 0; i < 2; ++i) {
    Row& row = term.rows[i];
    row.distance = row.direction.dot(pair.from_mean);
    term.distance_sq += row.distance * row.distance / variance[i];
  }
  term.kernel = 1.f / (1.f + term.distance_sq / kKernelWidthSq);
  for (std::size_t i = 0; i < 2; ++i) {
    term.rows[i].weight = term.kernel * term.kernel / variance[i];
  }
  return term;
}

double NdtMatcher::HeldCost(const MatchInput& input, const Pose& T_map_imu) const {
  const Pose T_grid_imu = GridFromMap() * T_map_imu;
  double cost = 0.0;
  for (const Pair& pair : pairs_) {
    const Term term = TermOf(pair, 0.f);
    if (term.distance_sq > kGateSq) continue;
    const Vector3 point = input.points_imu[static_cast<std::size_t>(pair.point)].cast<double>();
    const Vector3 moved = T_grid_imu * point - paired_at_ * point;
    for (int i = 0; i < term.num_rows; ++i) {
      const Row& row = term.rows[static_cast<std::size_t>(i)];
      const double distance = row.distance + row.direction.cast<double>().dot(moved);
      cost += 0.5 * row.weight * distance * distance;
    }
  }
  return cost;
}

NdtMatcher::System NdtMatcher::Linearize(std::span<const Eigen::Vector3f> points,
                                         const Pose& T_grid_imu, float reach_var,
                                         Scores* scores) const {
  System system;
  const Eigen::Matrix3f to_imu = T_grid_imu.rotation.conjugate().toRotationMatrix().cast<float>();
  for (const Pair& pair : pairs_) {
    const Term term = TermOf(pair, reach_var);
    if (term.distance_sq > kGateSq) continue;
    const Eigen::Vector3f& point = points[static_cast<std::size_t>(pair.point)];
    const SurfacePatch& patch = map_.patch(pair.cell);
    if (patch.kind == SurfacePatch::Kind::kPlane) {
      const Vector6f tangent1 = JacobianRow(point, to_imu * patch.tangent1_per_std);
      const Vector6f tangent2 = JacobianRow(point, to_imu * patch.tangent2_per_std);
      const float feigned = term.rows[0].weight * patch.thickness_var / patch.num_points;
      const Matrix6f noise =
          feigned * (tangent1 * tangent1.transpose() + tangent2 * tangent2.transpose());
      system.feigned += noise.cast<double>();
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(term.num_rows); ++i) {
      const Row& row = term.rows[i];
      const Vector6f jacobian = JacobianRow(point, to_imu * row.direction);
      const Vector6f gradient = system.Add(jacobian, row, term);
      if (scores == nullptr) continue;
      Scores::Cell& cell = scores->Of(pair.cell);
      cell.gradient += gradient;
      if (term.num_rows == 2) cell.per_metre[i] += row.weight * jacobian;
    }
    ++system.num_matched;
  }
  return system;
}

// Mean over the matched points of (points this scan adds to the cell) / (points in it after).
double NdtMatcher::NewContentShare() const {
  if (pairs_.empty()) return 1.0;
  double sum = 0.0;
  for (const Pair& pair : pairs_) {
    if (map_.IsFrozen(pair.cell)) continue;
    const double here = cell_counts_[static_cast<std::size_t>(pair.cell)];
    const double before = static_cast<double>(map_.patch(pair.cell).num_points);
    sum += here / (before + here);
  }
  return sum / static_cast<double>(pairs_.size());
}

void NdtMatcher::Finish(const MatchInput& input, const Pose& T_grid_imu, MatchResult& result) {
  Associate(input.points_imu, T_grid_imu, input.shift_std_m > kMaxShiftStd_m);
  score_slots_.resize(map_.cell_capacity(), kNoSlot);
  Scores scores{score_slots_, {}};
  const System system = Linearize(input.points_imu, T_grid_imu, 0.f, &scores);
  for (const Pair& pair : pairs_) score_slots_[static_cast<std::size_t>(pair.cell)] = kNoSlot;
  result.T_map_imu = GridFromMap().Inverse() * T_grid_imu;
  result.num_matched = system.num_matched;
  result.new_content_share = NewContentShare();
  if (system.num_matched < kMinMatched) {
    result.status = MatchStatus::kTooFewPoints;
    return;
  }
  const DirectionSplit split = SplitDirections(system.information, system.feigned);
  // The sandwich wants the robust cost's own curvature, which is less than the information.
  const double curvature =
      std::clamp(system.curvature_sum / system.information_sum, kMinCurvature, 1.0);
  const Matrix6 score_cov = scores.Covariance() / (curvature * curvature);
  // The residual step at hand costs nothing, and the iteration stopped at a finite one.
  const Vector6 last_step = StepInHeldDirections(split, system.gradient);
  if (last_step.norm() < kMaxLastStep) {
    result.T_map_imu = result.T_map_imu * ExpSe3(last_step);
  }
  result.information = system.information;
  result.eigenvalues = split.eigenvalues;
  result.weak_mask = split.weak_mask;
  result.held_cov = CovarianceFromScores(split, score_cov);
  result.cov = result.held_cov + WeakCovariance(split);
  result.residual_rms_m = std::sqrt(system.residual_sq_sum / system.weight_sum);
  if (split.weak_mask != 0 && result.status == MatchStatus::kConverged) {
    result.status = MatchStatus::kDegenerate;
  }
}

MatchResult NdtMatcher::Match(const MatchInput& input) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  if (map_.num_cells() == 0) return result;
  Pose T_grid_imu = GridFromMap() * input.T_map_imu_guess;
  double reach = InitialReach(input.guess_cov);
  result.status = MatchStatus::kMaxIterations;
  const int max_iterations =
      options_.max_iterations * (input.is_far_off ? kFarOffIterationFactor : 1);
  while (result.iterations < max_iterations) {
    ++result.iterations;
    if (reach < kMinReach_m) reach = 0.0;
    Associate(input.points_imu, T_grid_imu, input.shift_std_m > kMaxShiftStd_m);
    const System system =
        Linearize(input.points_imu, T_grid_imu, static_cast<float>(reach * reach), nullptr);
    if (system.num_matched < kMinMatched) break;
    const DirectionSplit split = SplitDirections(system.information, system.feigned);
    const Vector6 step = StepInHeldDirections(split, system.gradient);
    if (!step.allFinite()) {
      result.status = MatchStatus::kDiverged;
      return result;
    }
    T_grid_imu = T_grid_imu * ExpSe3(step);
    if (reach == 0.0 && step.head<3>().norm() < options_.converged_step_m &&
        step.tail<3>().norm() < options_.converged_step_rad) {
      result.status = MatchStatus::kConverged;
      break;
    }
    reach *= kReachShrink;
  }
  Finish(input, T_grid_imu, result);
  return result;
}

}  // namespace lio
