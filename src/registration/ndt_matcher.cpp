// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/ndt_matcher.hpp"

#include <algorithm>
#include <cmath>

#include "lio/registration/match_loop.hpp"

namespace lio {
namespace {

constexpr int kMinMatched = 50;
constexpr float kGateSq = 25.f;  // residuals beyond five sigma do not count
// What is seen of an upright thing depends on the side it is seen from: its cell is off by this.
constexpr double kSideStd_m = 0.15;
constexpr double kMaxShiftStd_m = 0.02;  // a better known shift does without upright things
constexpr float kMaxLever = 4.f;         // cap of a^2/l, where a patch is extrapolated
constexpr double kReachShrink = 0.3;     // of the reach's standard deviation, each iteration
constexpr double kMinReach_m = 0.01;     // a smaller reach is none
constexpr double kMaxReach_m = 2.0;
constexpr double kMaxLastStep = 5e-3;  // m, rad
constexpr int kFarOffIterationFactor = 5;
constexpr double kReachLever_m = 20.0;  // range at which a rotation error of the guess is felt

// Fixed odd rotation between the map's axes and the voxel grid's.
const Pose& GridFromMap() {
  static const Pose kRotation{ExpSo3(Vector3(0.31, -0.23, 0.41)), Vector3(0.37, 0.41, 0.29)};
  return kRotation;
}

// How far off the guess may be, one sigma, at a range of kReachLever_m.
class Reach {
 public:
  explicit Reach(const Matrix6& guess_cov) {
    const double translation_var = guess_cov.topLeftCorner<3, 3>().diagonal().maxCoeff();
    const double rotation_var = guess_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
    Set(std::min(std::sqrt(std::max(0.0, translation_var) +
                           std::max(0.0, rotation_var) * kReachLever_m * kReachLever_m),
                 kMaxReach_m));
  }
  float variance() const { return static_cast<float>(std_m_ * std_m_); }
  void Shrink() { Set(kReachShrink * std_m_); }
  bool IsExhausted() const { return std_m_ == 0.0; }

 private:
  void Set(double std_m) { std_m_ = std_m < kMinReach_m ? 0.0 : std_m; }

  double std_m_ = 0.0;
};

}  // namespace

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
  map_.Insert(points_grid, T_grid_imu * scan.sensor_imu);
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
  term.kernel = RobustKernel(term.distance_sq);
  row.weight = term.kernel.weight() / variance;
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
  term.kernel = RobustKernel(term.distance_sq);
  for (std::size_t i = 0; i < 2; ++i) term.rows[i].weight = term.kernel.weight() / variance[i];
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

MatchSums NdtMatcher::Linearize(std::span<const Eigen::Vector3f> points, const Pose& T_grid_imu,
                                float reach_var, Scores* scores) const {
  MatchSums sums;
  const Eigen::Matrix3f to_imu = T_grid_imu.rotation.conjugate().toRotationMatrix().cast<float>();
  for (const Pair& pair : pairs_) {
    const Term term = TermOf(pair, reach_var);
    if (term.distance_sq > kGateSq) continue;
    const Eigen::Vector3f& point = points[static_cast<std::size_t>(pair.point)];
    const SurfacePatch& patch = map_.patch(pair.cell);
    if (patch.kind == SurfacePatch::Kind::kPlane) {
      const float feigned = term.rows[0].weight * patch.thickness_var / patch.num_points;
      sums.feigned.Add(JacobianRow(point, to_imu * patch.tangent1_per_std), feigned);
      sums.feigned.Add(JacobianRow(point, to_imu * patch.tangent2_per_std), feigned);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(term.num_rows); ++i) {
      const Row& row = term.rows[i];
      const Vector6f jacobian = JacobianRow(point, to_imu * row.direction);
      const Vector6f gradient = sums.AddRow(jacobian, row.distance, row.weight, term.kernel);
      if (scores == nullptr) continue;
      scores->gradient.Add(pair.cell, gradient);
      if (term.num_rows == 2) scores->per_metre[i].Add(pair.cell, row.weight * jacobian);
    }
    ++sums.num_matched;
  }
  return sums;
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
  for (ClusterScores* scores : {&scores_.gradient, &scores_.per_metre[0], &scores_.per_metre[1]}) {
    scores->Reset(map_.cell_capacity());
  }
  const MatchSums sums = Linearize(input.points_imu, T_grid_imu, 0.f, &scores_);
  result.T_map_imu = GridFromMap().Inverse() * T_grid_imu;
  result.num_matched = sums.num_matched;
  result.new_content_share = NewContentShare();
  if (sums.num_matched < kMinMatched) {
    result.status = MatchStatus::kTooFewPoints;
    return;
  }
  const Matrix6 sides = scores_.per_metre[0].SumOfSquares() + scores_.per_metre[1].SumOfSquares();
  const Matrix6 score_cov = scores_.gradient.Covariance() + kSideStd_m * kSideStd_m * sides;
  const Vector6 last_step = Summarise(sums, score_cov, result);
  // The residual step at hand costs nothing, and the iteration stopped at a finite one.
  if (last_step.norm() < kMaxLastStep) {
    result.T_map_imu = result.T_map_imu * ExpSe3(last_step);
  }
}

MatchResult NdtMatcher::Match(const MatchInput& input) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  if (map_.num_cells() == 0) return result;
  Pose T_grid_imu = GridFromMap() * input.T_map_imu_guess;
  const auto step_at = [&](const Pose& pose, const Reach& reach) -> std::optional<Vector6> {
    Associate(input.points_imu, pose, input.shift_std_m > kMaxShiftStd_m);
    const MatchSums sums = Linearize(input.points_imu, pose, reach.variance(), nullptr);
    if (sums.num_matched < kMinMatched) return std::nullopt;
    const DirectionSplit split = SplitDirections(sums.information.Full(), sums.feigned.Full());
    return StepInHeldDirections(split, sums.gradient);
  };
  const StopRule rule{options_.max_iterations * (input.is_far_off ? kFarOffIterationFactor : 1),
                      options_.converged_step_m, options_.converged_step_rad};
  if (StepUntilStill(rule, Reach(input.guess_cov), step_at, T_grid_imu, result)) {
    Finish(input, T_grid_imu, result);
  }
  return result;
}

}  // namespace lio
