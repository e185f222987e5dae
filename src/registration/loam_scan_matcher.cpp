// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/loam_scan_matcher.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "lio/registration/registration_parameters.hpp"
#include "registration/loam_terms.hpp"
#include "registration/match_loop.hpp"
#include "registration/ring_grid.hpp"

namespace lio {
namespace {

Pose PartOf(const Pose& motion, double ratio) {
  return ratio == 1.0 ? motion : Interpolate(Pose::Identity(), motion, ratio);
}

}  // namespace

LoamScanMatcher::LoamScanMatcher(const LoamOptions& options)
    : options_(options),
      edges_(std::make_unique<RingGrid>()),
      surfaces_(std::make_unique<RingGrid>()),
      terms_(std::make_unique<LoamTerms>(options)) {}

LoamScanMatcher::~LoamScanMatcher() = default;

void LoamScanMatcher::Clear() {
  edges_->Clear();
  surfaces_->Clear();
}

ScanMatcher::MapSize LoamScanMatcher::map_size() const {
  const std::size_t num_points = edges_->size() + surfaces_->size();
  return {num_points, num_points * sizeof(Eigen::Vector4f)};
}

void LoamScanMatcher::Insert(const ScanView& scan, const Pose& T_map_imu) {
  if (scan.tags.size() != scan.points_imu.size()) {
    throw std::invalid_argument("LoamScanMatcher: every point needs a tag");
  }
  Clear();
  T_map_last_ = T_map_imu;
  for (std::size_t i = 0; i < scan.points_imu.size(); ++i) {
    RingGrid& grid = scan.tags[i].IsEdge() ? *edges_ : *surfaces_;
    grid.Add(scan.points_imu[i], scan.tags[i].ring);
  }
}

void LoamScanMatcher::AddEdge(std::int32_t number, const Eigen::Vector3f& place, float search_m) {
  const RingGrid::Found found =
      edges_->Search(place, search_m, {0.f, LoamScanParameters::kMinAcross_m});
  if (found.nearest < 0 || found.other_ring < 0) return;
  const Vector3 a = edges_->point(found.nearest).cast<double>();
  const Vector3 b = edges_->point(found.other_ring).cast<double>();
  const double length = (b - a).norm();
  if (length < LoamParameters::kMinLineLength_m) return;
  const double end_std = options_.edge_std_m / length;
  terms_->Add(EdgeTerm{number, static_cast<std::int32_t>(surfaces_->num_parts()) + found.part, a,
                       (b - a) / length, 2.0 * end_std * end_std});
}

void LoamScanMatcher::AddPlane(std::int32_t number, const Eigen::Vector3f& place, float search_m) {
  const RingGrid::Found found = surfaces_->Search(
      place, search_m, {LoamScanParameters::kMinBaseline_m, LoamScanParameters::kMinAcross_m});
  if (found.nearest < 0 || found.same_ring < 0 || found.other_ring < 0) return;
  const Vector3 a = surfaces_->point(found.nearest).cast<double>();
  const Vector3 along = surfaces_->point(found.same_ring).cast<double>() - a;
  const Vector3 up = surfaces_->point(found.other_ring).cast<double>() - a;
  const Vector3 area = along.cross(up);
  if (area.norm() < LoamScanParameters::kMinTriangle * along.norm() * up.norm()) return;
  PlaneTerm term;
  term.point = number;
  term.part = found.part;
  term.on_plane = a;
  term.axes.col(0) = area.normalized();
  term.axes.col(1) = along.normalized();
  term.axes.col(2) = term.axes.col(0).cross(term.axes.col(1));
  const double height = area.norm() / along.norm();
  const double noise_var = 2.0 * options_.surface_std_m * options_.surface_std_m;
  term.normal_var = {noise_var / along.squaredNorm(), noise_var / (height * height)};
  terms_->Add(term);
}

void LoamScanMatcher::Associate(const MatchInput& input, std::span<const float> sweep_ratios,
                                const Pose& T_last_imu, const SearchRadius& radius) {
  terms_->Clear();
  scores_.Reset(edges_->num_parts() + surfaces_->num_parts(), input.T_imu_lidar);
  for (std::size_t i = 0; i < input.points_imu.size(); ++i) {
    const FeatureKind kind = input.tags[i].kind;
    if (kind != FeatureKind::kSharp && kind != FeatureKind::kFlat) continue;
    const double ratio = sweep_ratios.empty() ? 1.0 : double{sweep_ratios[i]};
    const Vector3 point_imu = input.points_imu[i].cast<double>();
    const Vector3 place = PartOf(T_last_imu, ratio) * point_imu;
    const double range = point_imu.norm();
    const double search = std::min(
        CorrespondenceParameters::kSearchSigmas * radius.StdAt(range) +
            std::max(LoamScanParameters::kMinSearch_m, LoamScanParameters::kSearchPerRange * range),
        LoamScanParameters::kMaxSearch_m);
    const auto add =
        kind == FeatureKind::kSharp ? &LoamScanMatcher::AddEdge : &LoamScanMatcher::AddPlane;
    (this->*add)(static_cast<std::int32_t>(i), place.cast<float>(), static_cast<float>(search));
  }
}

double LoamScanMatcher::FixedCorrespondenceCost(const MatchInput& input,
                                                const Pose& T_map_imu) const {
  return terms_->FixedCorrespondenceCost(input.points_imu, T_map_last_.Inverse() * T_map_imu);
}

void LoamScanMatcher::Finish(const MatchInput& input, std::span<const float> sweep_ratios,
                             const Pose& T_last_imu, MatchResult& result) {
  result.T_map_imu = T_map_last_ * T_last_imu;
  result.num_matched = static_cast<int>(terms_->size());
  result.new_content_share = 1.0;  // nothing of the scan before is kept
  if (terms_->size() < LoamScanParameters::kMinMatched) {
    result.status = MatchStatus::kTooFewPoints;
    return;
  }
  std::vector<Eigen::Vector3f> points(input.points_imu.begin(), input.points_imu.end());
  if (!sweep_ratios.empty()) {  // every point with its part of the motion taken off
    const Pose T_imu_last = T_last_imu.Inverse();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pose part = T_imu_last * PartOf(T_last_imu, double{sweep_ratios[i]});
      points[i] = (part * points[i].cast<double>()).cast<float>();
    }
  }
  const MatchSums sums = terms_->Linearize(points, T_last_imu, &scores_);
  const Vector6 last_step = Summarise(sums, scores_.Covariance(), result).last_step;
  if (sweep_ratios.empty()) TakeLastStep(last_step, result);
}

MatchResult LoamScanMatcher::Match(const MatchInput& input) {
  return MatchSkewed(input, {});
}

MatchResult LoamScanMatcher::MatchSkewed(const MatchInput& input,
                                         std::span<const float> sweep_ratios) {
  MatchResult result;
  result.T_map_imu = input.T_map_imu_guess;
  if (edges_->size() + surfaces_->size() == 0) return result;
  if (input.tags.size() != input.points_imu.size() ||
      (!sweep_ratios.empty() && sweep_ratios.size() != input.points_imu.size())) {
    throw std::invalid_argument("LoamScanMatcher: every point needs a tag, and a ratio if any");
  }
  Pose T_last_imu = T_map_last_.Inverse() * input.T_map_imu_guess;
  const auto step_at = [&](const Pose& pose, const SearchRadius& radius) -> std::optional<Vector6> {
    Associate(input, sweep_ratios, pose, radius);
    if (terms_->size() < LoamScanParameters::kMinMatched) return std::nullopt;
    const Pose solved = terms_->Solve(input.points_imu, sweep_ratios, pose);
    const Vector6 step = LogSe3(pose.Inverse() * solved);
    if (!sweep_ratios.empty()) return step;
    const MatchSums sums = terms_->Linearize(input.points_imu, pose, nullptr);
    const DirectionSplit split = SplitDirections(sums);
    return KeepObservableDirections(split, step);
  };
  const StopRule rule{options_.max_rounds, options_.converged_step_m, options_.converged_step_rad};
  if (StepUntilStill(rule, SearchRadius(input.guess_cov), step_at, T_last_imu, result)) {
    Finish(input, sweep_ratios, T_last_imu, result);
  }
  return result;
}

}  // namespace lio
