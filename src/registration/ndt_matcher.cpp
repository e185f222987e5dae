// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/ndt_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lio/map/grazing_incidence.hpp"
#include "lio/map/surface_sides.hpp"
#include "lio/registration/registration_parameters.hpp"
#include "registration/bent_scan.hpp"
#include "registration/common_radius.hpp"
#include "registration/match_loop.hpp"
#include "registration/ndt_term.hpp"
#include "registration/well_constrained_translation.hpp"

namespace lio {
namespace {

constexpr double kLever_m = CorrespondenceParameters::kLever_m;

// Turns the map's axes into the voxel grid's by a fixed odd rotation.
const Pose& GridFromMap() {
  static const Pose kPose{ExpSo3(Vector3(NdtParameters::kGridRotation_rad.data())),
                          Vector3(NdtParameters::kGridTranslation_m.data())};
  return kPose;
}

// Turns the lidar's axes into the voxel grid's.
Eigen::Matrix3f GridFromLidar(const Pose& T_grid_imu, const Pose& T_imu_lidar) {
  return (T_grid_imu.rotation * T_imu_lidar.rotation).toRotationMatrix().cast<float>();
}

MultiResolutionMap MakeMap(const NdtOptions& options) {
  return MultiResolutionMap(options, static_cast<int>(kNumFinerLevels),
                            static_cast<int>(kNumCoarserLevels));
}

bool HasMoved(const Pose& from, const Pose& to) {
  const Pose motion = from.Inverse() * to;
  return motion.translation.norm() + kLever_m * LogSo3(motion.rotation).norm() >
         NdtParameters::kCountsHold_m;
}

}  // namespace

NdtMatcher::NdtMatcher(const NdtOptions& options, int num_threads)
    : options_(options), workers_(num_threads), map_(MakeMap(options)) {}

void NdtMatcher::Clear() {
  map_ = MakeMap(options_);
  width_ = {};
  share_on_surfaces_ = {};
  inserted_at_.reset();
}

void NdtMatcher::SetUp(const Vector3& up_map) {
  up_grid_ = GridFromMap().rotation * up_map;
  map_.SetUp(up_grid_);
}

std::vector<Vector3> NdtMatcher::InGrid(std::span<const Eigen::Vector3f> points,
                                        const Pose& T_grid_points) const {
  const Matrix3 rotation = T_grid_points.rotation.toRotationMatrix();
  std::vector<Vector3> points_grid(points.size());
  workers_.ForEachBlock(points_grid.size(), [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      points_grid[i] = rotation * points[i].cast<double>() + T_grid_points.translation;
    }
  });
  return points_grid;
}

std::vector<SeenBeam> NdtMatcher::BeamsOf(const ScanView& scan,
                                          const Eigen::Matrix3f& grid_from_lidar) const {
  std::vector<SeenBeam> beams;
  if (scan.beam_points.size() != scan.points_imu.size() || scan.corrected == nullptr) return beams;
  beams.reserve(scan.beam_points.size() / SeenBeams::kSampling + 1);
  for (std::size_t i = 0; i < scan.beam_points.size(); i += SeenBeams::kSampling) {
    const ScanPoint& point = scan.beam_points[i];
    SeenBeam& beam = beams.emplace_back();
    beam.ring = point.ring;
    beam.axes = Turned(AxesOf(point.position), grid_from_lidar);
    beam.correction_m = Displacement(*scan.corrected, point.ring, beam.axes);
  }
  return beams;
}

void NdtMatcher::Teach(const MatchInput& input, const Pose& T_grid_imu) const {
  const Eigen::Matrix3f grid_from_lidar = GridFromLidar(T_grid_imu, input.T_imu_lidar);
  const std::size_t step = scores_.size() / BeamCalibrationParameters::kMaxRows + 1;
  input.calibration->BeginScan(path_m_, static_cast<int>(step));
  for (std::size_t i = 0; i < scores_.size(); i += step) {
    if (scores_[i].num_rows != 1) continue;
    const SurfacePatch& patch = map_.patch(pairs_[i].cell);
    const CellBeams& cell = map_.beams(pairs_[i].cell);
    const auto num_remembered = static_cast<float>(SeenBeams::kSampling * cell.num_points);
    if (num_remembered < BeamCalibrationParameters::kMinRemembered * patch.num_points) continue;
    const ScanPoint& point = input.beam_points[i];
    const PointScore::OfRow& row = scores_[i].rows[0];
    input.calibration->Add({.ring = point.ring,
                            .axes = Turned(AxesOf(point.position), grid_from_lidar),
                            .cell = &cell,
                            .normal = patch.normal,
                            .residual_m = row.residual_m,
                            .height_m = pairs_[i].height_m,
                            .weight = row.weight,
                            .jacobian = row.jacobian});
  }
}

void NdtMatcher::Insert(const ScanView& scan, const Pose& T_map_imu) {
  if (width_.is_unknown()) width_.Add(scan.points_imu, options_.voxel_m);
  const Pose T_grid_imu = GridFromMap() * T_map_imu;
  if (inserted_at_) path_m_ += static_cast<float>((T_map_imu.translation - *inserted_at_).norm());
  inserted_at_ = T_map_imu.translation;
  map_.SetRangeStd(scan.range_std_m);
  const std::vector<SeenBeam> beams = BeamsOf(scan, GridFromLidar(T_grid_imu, scan.T_imu_lidar));
  map_.Insert(InGrid(scan.points_imu, T_grid_imu), T_grid_imu * scan.T_imu_lidar.translation,
              workers_, LevelsInUse().finest, {beams, path_m_});
}

bool NdtMatcher::InsertKept(std::span<const Eigen::Vector3f> points_map) {
  std::vector<Eigen::Vector3f> sides = SurfaceSides(points_map, workers_);
  const Eigen::Matrix3f rotation = GridFromMap().rotation.toRotationMatrix().cast<float>();
  for (Eigen::Vector3f& side : sides) side = rotation * side;
  map_.InsertKept(InGrid(points_map, GridFromMap()), sides, workers_);
  return true;
}

void NdtMatcher::Associate(const MatchInput& input, const Pose& T_grid_imu, double radius_m) {
  const std::span<const Eigen::Vector3f> points = input.points_imu;
  const MultiResolutionMap::Levels levels = LevelsFor(input, radius_m);
  const float relief = input.calibration == nullptr ? 0.f : input.calibration->relief();
  pairs_.resize(points.size());
  paired_at_ = T_grid_imu;
  const Vector3 sensor_grid = T_grid_imu * input.T_imu_lidar.translation;
  const Matrix3 rotation = T_grid_imu.rotation.toRotationMatrix();
  workers_.ForEachBlock(points.size(), [&](const Block& block) {
    std::array<Vector3, Workers::kBlockSize> points_grid;
    std::array<GaussianMap::Hit, Workers::kBlockSize> hits;
    const std::size_t count = block.end - block.begin;
    for (std::size_t i = 0; i < count; ++i) {
      points_grid[i] = rotation * points[block.begin + i].cast<double>() + T_grid_imu.translation;
    }
    map_.FindAll({points_grid.data(), count}, levels, hits);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f view = (points_grid[i] - sensor_grid).cast<float>();
      pairs_[block.begin + i] = PairOf(hits[i], view, relief);
    }
  });
  if (!counted_at_ || HasMoved(*counted_at_, T_grid_imu)) CountByCell();
}

MultiResolutionMap::Levels NdtMatcher::LevelsInUse() const {
  const std::size_t coarsest = CoarsestOfOptions();
  if (width_.is_narrow()) return {0, coarsest - kNumFinerLevels};
  return {kNumFinerLevels, share_on_surfaces_.is_low() ? map_.num_levels() - 1 : coarsest};
}

MultiResolutionMap::Levels NdtMatcher::LevelsFor(const MatchInput& input, double radius_m) const {
  const auto [finest, coarsest] = LevelsInUse();
  if (input.is_far_off) return {std::min(CoarsestOfOptions(), coarsest), coarsest};
  return {std::clamp(map_.LevelFor(radius_m), finest, coarsest), coarsest};
}

void NdtMatcher::CountByCell() {
  counted_at_ = paired_at_;
  ++count_number_;
  cell_counts_.resize(map_.cell_capacity());
  for (const Pair& pair : pairs_) {
    if (pair.cell == GaussianMap::kNoCell) continue;
    CellCount& cell = cell_counts_[static_cast<std::size_t>(pair.cell)];
    cell.num_points = 1 + (cell.count_number == count_number_ ? cell.num_points : 0);
    cell.count_number = count_number_;
  }
}

NdtMatcher::Pair NdtMatcher::PairOf(const GaussianMap::Hit& hit, const Eigen::Vector3f& view,
                                    float relief) const {
  if (hit.cell == GaussianMap::kNoCell) return {};
  const SurfacePatch& patch = map_.patch(hit.cell);
  if (patch.kind == SurfacePatch::Kind::kVertical) {
    if (!matches_vertical_) return {};
  } else if (!patch.is_two_sided && IsFromBehind(patch.normal, view)) {
    return {};
  }
  Pair pair{hit.cell, hit.local - patch.mean};
  if (patch.kind == SurfacePatch::Kind::kPlane && !patch.roughness.is_smooth()) {
    const float range_m = std::max(view.norm(), 1e-6f);
    pair.height_m = patch.roughness.HeightAt(std::abs(patch.normal.dot(view)) / range_m);
    pair.from_mean -= relief * pair.height_m * patch.normal;
  }
  return pair;
}

NdtTerm NdtMatcher::TermOf(const Pair& pair, float radius_var) const {
  const auto num_here = static_cast<float>(CountOf(pair.cell));
  return MakeNdtTerm(map_.patch(pair.cell), pair.from_mean, num_here, radius_var);
}

double NdtMatcher::FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const {
  const Pose T_grid_imu = GridFromMap() * T_map_imu;
  double cost = 0.0;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (pairs_[k].cell == GaussianMap::kNoCell) continue;
    const NdtTerm term = TermOf(pairs_[k], 0.f);
    if (term.IsOutlier()) continue;
    const Vector3 point = input.points_imu[k].cast<double>();
    const Vector3 moved = T_grid_imu * point - paired_at_ * point;
    for (int i = 0; i < term.num_rows; ++i) {
      const NdtRow& row = term.rows[static_cast<std::size_t>(i)];
      const double distance = row.distance + row.direction.cast<double>().dot(moved);
      cost += 0.5 * row.weight * distance * distance;
    }
  }
  return cost;
}

MatchSums NdtMatcher::Linearize(const MatchInput& input, const Pose& T_grid_imu, float radius_var,
                                std::span<PointScore> scores) const {
  const std::span<const Eigen::Vector3f> points = input.points_imu;
  const Eigen::Matrix3f to_imu = T_grid_imu.rotation.conjugate().toRotationMatrix().cast<float>();
  return workers_.SumOverBlocks<MatchSums>(points.size(), [&](const Block& block) {
    MatchSums sums;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (!scores.empty()) scores[i].num_rows = 0;
      if (pairs_[i].cell == GaussianMap::kNoCell) continue;
      const NdtTerm term = TermOf(pairs_[i], radius_var);
      if (term.IsOutlier()) continue;
      const float share = input.shares_of_correction.empty() ? 1.f : input.shares_of_correction[i];
      AddTerm(term, map_.patch(pairs_[i].cell), points[i], share, to_imu, sums,
              scores.empty() ? nullptr : &scores[i]);
    }
    return sums;
  });
}

void NdtMatcher::AddTerm(const NdtTerm& term, const SurfacePatch& patch,
                         const Eigen::Vector3f& point, float share, const Eigen::Matrix3f& to_imu,
                         MatchSums& sums, PointScore* score) {
  if (patch.kind == SurfacePatch::Kind::kPlane) {
    constexpr float kAlikeVar_m2 = NdtParameters::kAlikeStd_m * NdtParameters::kAlikeStd_m;
    const float noise_information =
        term.rows[0].weight * (patch.thickness_var / patch.num_points + kAlikeVar_m2);
    sums.noise_information.Add(JacobianRow(point, to_imu * patch.tangent1_per_std),
                               noise_information);
    sums.noise_information.Add(JacobianRow(point, to_imu * patch.tangent2_per_std),
                               noise_information);
  }
  ++sums.num_matched;
  if (score != nullptr) score->num_rows = term.num_rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(term.num_rows); ++i) {
    const NdtRow& row = term.rows[i];
    const Vector6f jacobian = share * JacobianRow(point, to_imu * row.direction);
    if (patch.kind == SurfacePatch::Kind::kVertical) {
      const Vector6f sure = share * JacobianRow(point, to_imu * row.sure_direction);
      sums.sure_information.Add(sure, row.sure_weight);
    }
    const Vector6f gradient = sums.AddRow(jacobian, row.distance, row.weight, term.kernel);
    if (score != nullptr) score->rows[i] = {gradient, jacobian, row.distance, row.weight};
  }
}

MatchSums NdtMatcher::SumsAt(const MatchInput& input, const Pose& T_grid_imu,
                             std::span<PointScore> scores) {
  counted_at_.reset();
  Associate(input, T_grid_imu, 0.0);
  return Linearize(input, T_grid_imu, 0.f, scores);
}

double NdtMatcher::Finish(const MatchInput& input, const Pose& T_grid_imu, MatchResult& result) {
  scores_.resize(input.points_imu.size());
  const MatchSums sums = SumsAt(input, T_grid_imu, scores_);
  if (!input.is_far_off) AddShareOnSurfaces();
  result.T_map_imu = GridFromMap().Inverse() * T_grid_imu;
  CountSupport(result);
  result.new_content_share = NewContentShare();
  if (sums.num_matched < MatchParameters::kMinMatched) {
    result.status = MatchStatus::kTooFewPoints;
    return sums.weight_sum;
  }
  if (input.calibration != nullptr && input.beam_points.size() == input.points_imu.size()) {
    Teach(input, T_grid_imu);
    result.beam_pull.unknown_cov = input.calibration->ScoreCov();
  }
  const SolvedSums solved = Summarise(sums, ScoreCovariance(input), result);
  TakeLastStep(solved.last_step, result);
  result.observability.share_of_last_scan = ShareOfLastScan(sums, solved.inverse);
  gradients_.Complete(sums.curvature_ratio(), result);
  if (!input.from_mid_sweep_s.empty()) {
    result.turn_rate_error = TurnRateError(input.from_mid_sweep_s, sums.curvature_ratio());
  }
  return sums.weight_sum;
}

MatchResult NdtMatcher::Match(const MatchInput& input) {
  if (map_.num_cells() > 0) width_.Add(input.points_imu, options_.voxel_m);
  matches_vertical_ = !IsShiftKnownAsAtRest(input);
  MatchResult result = MatchFromGuess(input);
  if (matches_vertical_ && IsTranslationWellConstrained(input) && ContradictsGuess(result, input)) {
    matches_vertical_ = false;
    result = MatchFromGuess(input);
  }
  return result;
}

MatchResult NdtMatcher::MatchFromGuess(const MatchInput& input) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  if (map_.num_cells() == 0) return result;
  const Pose T_grid_guess = GridFromMap() * input.T_map_imu_guess;
  if (share_on_surfaces_.is_unknown()) {
    Associate(input, T_grid_guess, 0.0);
    AddShareOnSurfaces();
  }
  counted_at_.reset();
  BentScan scan(input);
  const auto scan_at = [&](const Pose& pose) -> const MatchInput& {
    return scan.At(T_grid_guess.Inverse() * pose);
  };
  const auto step_at = [&](const Pose& pose, const CommonRadius& radius) -> std::optional<Vector6> {
    const MatchInput& bent = scan_at(pose);
    Associate(bent, pose, radius.std_m());
    const MatchSums sums = Linearize(bent, pose, radius.variance(), {});
    if (sums.num_matched < MatchParameters::kMinMatched) return std::nullopt;
    if (input.solves_degenerate) {
      return StepTowardsGuess(sums.information.Full(), sums.gradient,
                              {T_grid_guess.Inverse() * pose, input.guess_cov});
    }
    return StepInObservableDirections(SplitDirections(sums), sums.gradient);
  };
  const StopRule rule{options_.max_iterations, options_.converged_step_m,
                      options_.converged_step_rad};
  Pose T_grid_imu = T_grid_guess;
  if (StepUntilStill(rule, CommonRadius(input.guess_cov), step_at, T_grid_imu, result)) {
    const double support = Finish(scan_at(T_grid_imu), T_grid_imu, result);
    if (ContradictsGuess(result, input)) {
      const MatchSums at_guess = SumsAt(scan_at(T_grid_guess), T_grid_guess, {});
      result.support_at_guess = at_guess.weight_sum / support;
    }
  }
  return result;
}

}  // namespace lio
