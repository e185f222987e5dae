// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/loam_matcher.hpp"

#include <cmath>
#include <stdexcept>

#include "lio/registration/registration_parameters.hpp"
#include "registration/loam_terms.hpp"
#include "registration/match_loop.hpp"
#include "registration/neighbour_fit.hpp"

namespace lio {
namespace {

constexpr std::size_t kMinTerms = MatchParameters::kMinMatched;

PointMapOptions MapOptions(const LoamOptions& options, double leaf_m) {
  return {leaf_m, options.max_leaf_points, options.max_leaves, options.max_distance_m};
}

}  // namespace

LoamMatcher::LoamMatcher(const LoamOptions& options)
    : options_(options),
      edge_map_(MapOptions(options, options.edge_leaf_m)),
      surface_map_(MapOptions(options, options.surface_leaf_m)),
      terms_(std::make_unique<LoamTerms>(options)) {}

LoamMatcher::~LoamMatcher() = default;

void LoamMatcher::Clear() {
  edge_map_ = PointMap(MapOptions(options_, options_.edge_leaf_m));
  surface_map_ = PointMap(MapOptions(options_, options_.surface_leaf_m));
}

ScanMatcher::MapSize LoamMatcher::map_size() const {
  return {edge_map_.num_voxels() + surface_map_.num_voxels(),
          edge_map_.memory_bytes() + surface_map_.memory_bytes()};
}

void LoamMatcher::Insert(const ScanView& scan, const Pose& T_map_imu) {
  if (scan.tags.size() != scan.points_imu.size()) {
    throw std::invalid_argument("LoamMatcher: every point needs a tag");
  }
  std::vector<Vector3> edges, surfaces;
  for (std::size_t i = 0; i < scan.points_imu.size(); ++i) {
    (scan.tags[i].IsEdge() ? edges : surfaces)
        .push_back(T_map_imu * scan.points_imu[i].cast<double>());
  }
  edge_map_.Insert(edges, T_map_imu.translation);
  surface_map_.Insert(surfaces, T_map_imu.translation);
}

void LoamMatcher::Associate(const MatchInput& input, const Pose& T_map_imu,
                            const SearchRadius& radius) {
  terms_->Clear();
  scores_.Reset(surface_map_.block_capacity() + edge_map_.block_capacity(), input.T_imu_lidar);
  const auto first_edge_block = static_cast<std::int32_t>(surface_map_.block_capacity());
  const int wanted = options_.num_neighbours;
  for (std::size_t i = 0; i < input.points_imu.size(); ++i) {
    const Vector3 point_imu = input.points_imu[i].cast<double>();
    const Vector3 point = T_map_imu * point_imu;
    const double search_radius =
        CorrespondenceParameters::kSearchSigmas * radius.StdAt(point_imu.norm());
    const auto number = static_cast<std::int32_t>(i);
    if (input.tags[i].IsEdge()) {
      const double search = search_radius + LoamParameters::kLeavesPerSearch * options_.edge_leaf_m;
      const PointMap::Neighbours near = edge_map_.FindNearest(point, wanted, search);
      const std::optional<LineFit> line = FitLine(near, options_);
      if (!line ||
          line->direction.cross(line->centre).norm() > search_radius + LoamParameters::kGate_m)
        continue;
      terms_->Add(EdgeTerm{number, first_edge_block + near.list[0].block, point + line->centre,
                           line->direction, line->direction_var});
    } else {
      const double search =
          search_radius + LoamParameters::kLeavesPerSearch * options_.surface_leaf_m;
      const PointMap::Neighbours near = surface_map_.FindNearest(point, wanted, search);
      const std::optional<PlaneFit> plane = FitPlane(near, options_);
      if (!plane ||
          std::abs(plane->normal.dot(plane->centre)) > search_radius + LoamParameters::kGate_m)
        continue;
      terms_->Add(PlaneTerm{number, near.list[0].block, point + plane->centre, plane->axes,
                            plane->normal_var});
    }
  }
}

double LoamMatcher::FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const {
  return terms_->FixedCorrespondenceCost(input.points_imu, T_map_imu);
}

double LoamMatcher::NewContentShare(const MatchInput& input, const Pose& T_map_imu) const {
  const double added = InsertedPerMatched(input);
  NewContentMean mean;
  const auto add = [&](const PointMap& map, std::int32_t point) {
    const Vector3 point_imu = input.points_imu[static_cast<std::size_t>(point)].cast<double>();
    const PointMap::Content content = map.ContentAt(T_map_imu * point_imu);
    content.is_frozen ? mean.AddFrozen() : mean.Add(content.num_points, added);
  };
  for (const EdgeTerm& term : terms_->edges()) add(edge_map_, term.point);
  for (const PlaneTerm& term : terms_->planes()) add(surface_map_, term.point);
  return mean.share();
}

void LoamMatcher::Finish(const MatchInput& input, const Pose& T_map_imu, MatchResult& result) {
  Associate(input, T_map_imu, SearchRadius(Matrix6::Zero()));
  const MatchSums sums = terms_->Linearize(input.points_imu, T_map_imu, &scores_);
  result.T_map_imu = T_map_imu;
  result.new_content_share = NewContentShare(input, T_map_imu);
  FinishMatch(sums, scores_, terms_->size() >= kMinTerms, result);
}

Pose LoamMatcher::SolveRound(const MatchInput& input, Pose T_map_imu) {
  const StopRule rule{options_.max_iterations, options_.converged_step_m,
                      options_.converged_step_rad};
  for (int i = 0; i < rule.max_steps; ++i) {
    const MatchSums sums = terms_->Linearize(input.points_imu, T_map_imu, nullptr);
    const Vector6 step = StepInObservableDirections(SplitDirections(sums), sums.gradient);
    T_map_imu = T_map_imu * ExpSe3(step);
    if (rule.IsSmall(step)) break;
  }
  return T_map_imu;
}

MatchResult LoamMatcher::Match(const MatchInput& input) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  if (edge_map_.num_voxels() + surface_map_.num_voxels() == 0) return result;
  if (input.tags.size() != input.points_imu.size()) {
    throw std::invalid_argument("LoamMatcher: every point needs a tag");
  }
  Pose T_map_imu = input.T_map_imu_guess;
  const int factor = input.is_far_off ? LoamParameters::kFarOffRoundFactor : 1;
  const StopRule rule{factor * options_.max_rounds, options_.converged_step_m,
                      options_.converged_step_rad};
  const auto step_at = [&](const Pose& pose, const SearchRadius& radius) -> std::optional<Vector6> {
    Associate(input, pose, radius);
    if (terms_->size() < kMinTerms) return std::nullopt;
    const Pose solved = SolveRound(input, pose);
    const double share = result.iterations > factor * LoamParameters::kFullRounds ? 0.5 : 1.0;
    return share * LogSe3(pose.Inverse() * solved);
  };
  if (StepUntilStill(rule, SearchRadius(input.guess_cov), step_at, T_map_imu, result)) {
    Finish(input, T_map_imu, result);
  }
  return result;
}

}  // namespace lio
