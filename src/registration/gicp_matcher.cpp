// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/gicp_matcher.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lio/registration/registration_parameters.hpp"
#include "registration/match_loop.hpp"
#include "registration/scan_normals.hpp"
#include "registration/well_constrained_translation.hpp"

namespace lio {
namespace {

using Correspondence = CorrespondenceParameters;

// A point has one of these as last neighbour where there is none: not sought yet, or none within
// the first search.
constexpr std::int32_t kUnknown = -1;
constexpr std::int32_t kNowhere = -2;

KeyframeMapOptions MapOptions(const GicpOptions& options) {
  return {.max_points = options.max_points,
          .max_distance_m = options.max_distance_m,
          .num_near = options.num_near_keyframes,
          .num_hull = options.num_hull_keyframes};
}

}  // namespace

GicpMatcher::GicpMatcher(const GicpOptions& options)
    : options_(options),
      map_(MapOptions(options)),
      normals_(std::make_unique<ScanNormals>(options)) {}

GicpMatcher::~GicpMatcher() = default;

void GicpMatcher::Clear() {
  map_ = KeyframeMap(MapOptions(options_));
  openness_m_ = 0.0;
}

ScanMatcher::MapSize GicpMatcher::map_size() const {
  return {map_.num_points(), map_.memory_bytes()};
}

void GicpMatcher::UpdateOpenness(std::span<const Eigen::Vector3f> points_imu) {
  if (points_imu.empty()) return;
  std::vector<float> ranges;
  ranges.reserve(points_imu.size());
  for (const Eigen::Vector3f& point : points_imu) ranges.push_back(point.norm());
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  const auto median = static_cast<double>(*middle);
  constexpr double kKeep = GicpParameters::kOpennessKeep;
  openness_m_ = openness_m_ == 0.0 ? median : kKeep * openness_m_ + (1.0 - kKeep) * median;
}

bool GicpMatcher::IsKeyframe(const Pose& T_map_imu) const {
  const KeyframeMap::Nearest nearest = map_.NearestKeyframe(T_map_imu.translation);
  if (nearest.keyframe < 0) return true;
  const Pose motion = nearest.T_map_kf.Inverse() * T_map_imu;
  const double distance = std::clamp(options_.keyframe_openness_ratio * openness_m_,
                                     options_.min_keyframe_m, options_.max_keyframe_m);
  return motion.translation.norm() > distance ||
         LogSo3(motion.rotation).norm() > options_.keyframe_deg * std::numbers::pi / 180.0;
}

void GicpMatcher::Insert(const ScanView& scan, const Pose& T_map_imu) {
  if (openness_m_ == 0.0) UpdateOpenness(scan.points_imu);
  if (!IsKeyframe(T_map_imu)) return;
  normals_->SetScan(scan.points_imu);
  std::vector<PointWithNormal> points;
  points.reserve(scan.points_imu.size());
  for (const Eigen::Vector3f& point : scan.points_imu) points.push_back(normals_->At(point));
  map_.Add(points, T_map_imu);
}

void GicpMatcher::MovePairs(const Pose& T_map_imu) {
  for (Pair& pair : pairs_) {
    const Vector3 point = source_[static_cast<std::size_t>(pair.point)].position.cast<double>();
    pair.offset -= (T_map_imu * point - paired_at_ * point).cast<float>();
  }
  paired_at_ = T_map_imu;
}

void GicpMatcher::Associate(const Pose& T_map_imu, const SearchRadius& radius) {
  const bool is_first = near_.empty();
  const Pose motion = sought_at_.Inverse() * T_map_imu;
  if (!is_first &&
      motion.translation.norm() + Correspondence::kLever_m * LogSo3(motion.rotation).norm() <
          GicpParameters::kKeepPairs_m) {
    MovePairs(T_map_imu);
    return;
  }
  if (is_first) near_.assign(source_.size(), kUnknown);
  pairs_.clear();
  paired_at_ = sought_at_ = T_map_imu;
  const Matrix3 rotation = T_map_imu.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < source_.size(); ++i) {
    if (near_[i] == kNowhere) continue;
    const Vector3 point_imu = source_[i].position.cast<double>();
    const double range = point_imu.norm();
    const double search =
        Correspondence::kSearchSigmas * radius.StdAt(range) +
        std::max(GicpParameters::kMinSearch_m, GicpParameters::kSearchPerRange * range);
    const KeyframeMap::Hit hit =
        map_.FindNearest(rotation * point_imu + T_map_imu.translation, search, near_[i]);
    near_[i] = hit.point;
    if (hit.point >= 0) pairs_.push_back({static_cast<std::int32_t>(i), hit.point, hit.from_query});
    // The first search goes as far as the guess may be off: later ones would find nothing either.
    if (hit.point < 0 && is_first && !is_far_off_) near_[i] = kNowhere;
  }
}

// A neighbour that is far along the surface may lie where the surface has bent away from its plane.
// The pair's covariance C_q + R C_p R' has its least eigenvalue along the bisector of the normals.
GicpMatcher::Term GicpMatcher::TermOf(const Pair& pair, const Eigen::Matrix3f& rotation,
                                      float radius_var) const {
  const PointWithNormal& source = source_[static_cast<std::size_t>(pair.point)];
  const PointWithNormal& target = map_.point(pair.target);
  Term term;
  if (!source.HasNormal() && !uses_rank_deficient_) return term;
  float variance = radius_var;
  float bend_var = 0.f;
  if (source.HasNormal()) {
    const Eigen::Vector3f normal = rotation * source.normal;
    const float cosine = normal.dot(target.normal);
    const float aligned = std::abs(cosine);
    if (aligned < GicpParameters::kMinCosine) return term;
    term.direction = (target.normal + std::copysign(1.f, cosine) * normal).normalized();
    variance += 0.5f * (1.f + aligned) * (source.thickness_var + target.thickness_var) +
                (1.f - aligned) * GicpParameters::kTangentVar_m2;
    term.tilt_var = 0.25f * (source.normal_var + target.normal_var);
    bend_var = 2.f * (source.bend_var + target.bend_var);  // the same way, at worst
  } else {
    term.direction = target.normal;
    variance += target.thickness_var + GicpParameters::kNoNormalVar_m2;
    term.tilt_var = target.normal_var;
    bend_var = target.bend_var;
  }
  term.distance = term.direction.dot(pair.offset);
  const float apart_sq = pair.offset.squaredNorm() - term.distance * term.distance;
  variance += bend_var * apart_sq * apart_sq;
  term.distance_sq = term.distance * term.distance / variance;
  if (RobustKernel::IsOutlier(term.distance_sq)) return term;
  term.kernel = RobustKernel(term.distance_sq);
  term.weight = term.kernel.weight() / variance;
  return term;
}

MatchSums GicpMatcher::Linearize(const Pose& T_map_imu, const SearchRadius& radius,
                                 MatchScores* scores) {
  uses_rank_deficient_ = false;
  const MatchSums sums = SumTerms(T_map_imu, radius, scores);
  const bool is_observable = sums.num_matched >= MatchParameters::kMinMatched &&
                             SplitDirections(sums).degenerate_mask == 0;
  if (is_observable || !has_rank_deficient_) return sums;
  uses_rank_deficient_ = true;
  return SumTerms(T_map_imu, radius, scores);
}

MatchSums GicpMatcher::SumTerms(const Pose& T_map_imu, const SearchRadius& radius,
                                MatchScores* scores) const {
  MatchSums sums;
  const Eigen::Matrix3f rotation = T_map_imu.rotation.toRotationMatrix().cast<float>();
  VoxelIndex clusters;
  if (scores != nullptr) scores->Reset(pairs_.size(), T_imu_lidar_);
  for (const Pair& pair : pairs_) {
    const Eigen::Vector3f& point = source_[static_cast<std::size_t>(pair.point)].position;
    const double std = radius.StdAt(point.norm());
    const Term term = TermOf(pair, rotation, static_cast<float>(std * std));
    if (term.weight == 0.f) continue;
    const Eigen::Vector3f normal = rotation.transpose() * term.direction;
    const Vector6f row = JacobianRow(point, normal);
    // The distance falls as the point moves on.
    const Vector6f score = sums.AddRow(row, -term.distance, term.weight, term.kernel);
    const Eigen::Vector3f tangent = normal.unitOrthogonal();
    for (const Eigen::Vector3f& axis : {tangent, Eigen::Vector3f(normal.cross(tangent))}) {
      sums.noise_information.Add(JacobianRow(point, axis), term.weight * term.tilt_var);
    }
    ++sums.num_matched;
    if (scores == nullptr) continue;
    const Vector3 place = (T_map_imu * point.cast<double>()) / GicpParameters::kClusterVoxel_m;
    const auto cell = [](double v) { return static_cast<std::int32_t>(std::floor(v)); };
    const VoxelKey key = PackVoxel(cell(place.x()), cell(place.y()), cell(place.z()));
    scores->Add(point, {clusters.FindOrAdd(key).voxel, term.weight, row, score});
  }
  return sums;
}

double GicpMatcher::FixedCorrespondenceCost(const MatchInput& /*input*/,
                                            const Pose& T_map_imu) const {
  const Eigen::Matrix3f rotation = paired_at_.rotation.toRotationMatrix().cast<float>();
  double cost = 0.0;
  for (const Pair& pair : pairs_) {
    const Term term = TermOf(pair, rotation, 0.f);
    const Vector3 point = source_[static_cast<std::size_t>(pair.point)].position.cast<double>();
    const Vector3 moved = T_map_imu * point - paired_at_ * point;
    const double distance = term.distance - term.direction.cast<double>().dot(moved);
    cost += 0.5 * term.weight * distance * distance;
  }
  return cost;
}

double GicpMatcher::NewContentShare(const MatchInput& input, const Pose& T_map_imu) const {
  if (!pairs_.empty() && !IsKeyframe(T_map_imu)) return 0.0;
  const double added = InsertedPerMatched(input);
  NewContentMean mean;
  for (const Pair& pair : pairs_) {
    const Vector3 point = source_[static_cast<std::size_t>(pair.point)].position.cast<double>();
    mean.Add(map_.CountAt(T_map_imu * point), added);
  }
  return mean.share();
}

void GicpMatcher::Finish(const MatchInput& input, const Pose& T_map_imu, MatchResult& result) {
  const SearchRadius none(Matrix6::Zero());
  T_imu_lidar_ = input.T_imu_lidar;
  Associate(T_map_imu, none);
  const MatchSums sums = Linearize(T_map_imu, none, &scores_);
  result.T_map_imu = T_map_imu;
  result.new_content_share = NewContentShare(input, T_map_imu);
  FinishMatch(sums, scores_, sums.num_matched >= MatchParameters::kMinMatched, result);
}

MatchResult GicpMatcher::Match(const MatchInput& input) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  const std::span<const Eigen::Vector3f> scan =
      input.scan_points_imu.empty() ? input.points_imu : input.scan_points_imu;
  UpdateOpenness(scan);
  if (map_.num_keyframes() == 0) return result;
  normals_->SetScan(scan);
  has_rank_deficient_ = !IsTranslationWellConstrained(input);
  source_.clear();
  for (const Eigen::Vector3f& point : input.points_imu) {
    const PointWithNormal with_normal = normals_->At(point);
    if (with_normal.HasNormal() || has_rank_deficient_) source_.push_back(with_normal);
  }
  map_.ChooseSubmap(input.T_map_imu_guess.translation);
  near_.clear();
  is_far_off_ = input.is_far_off;

  Pose T_map_imu = input.T_map_imu_guess;
  const auto step_at = [&](const Pose& pose, const SearchRadius& radius) -> std::optional<Vector6> {
    Associate(pose, radius);
    const MatchSums sums = Linearize(pose, radius, nullptr);
    if (sums.num_matched < MatchParameters::kMinMatched) return std::nullopt;
    return StepInObservableDirections(SplitDirections(sums), sums.gradient);
  };
  const StopRule rule{
      options_.max_iterations * (input.is_far_off ? GicpParameters::kFarOffIterationFactor : 1),
      options_.converged_step_m, options_.converged_step_rad};
  if (StepUntilStill(rule, SearchRadius(input.guess_cov), step_at, T_map_imu, result)) {
    Finish(input, T_map_imu, result);
  }
  return result;
}

}  // namespace lio
