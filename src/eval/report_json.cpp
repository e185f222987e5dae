// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/report.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

Json StatsJson(const ErrorStats& stats) {
  return {{"rmse", stats.rmse}, {"mean", stats.mean}, {"median", stats.median}, {"max", stats.max}};
}

Json RelativeJson(const RelativeErrors& errors) {
  return {{"count", errors.translation_m.count},
          {"translation_m", StatsJson(errors.translation_m)},
          {"rotation_deg", StatsJson(errors.rotation_deg)}};
}

Json VectorJson(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

Json AssociationJson(const Association& a) {
  const bool is_by_index = a.method == AssociationMethod::kByIndex;
  const char* const interpolated = a.method == AssociationMethod::kTruthInterpolated
                                       ? "truth_interpolated"
                                       : "estimate_interpolated";
  return {{"method", is_by_index ? "index" : interpolated},
          {"max_gap_s", is_by_index ? Json() : Json(a.max_gap_s)},
          {"is_max_gap_automatic", a.is_max_gap_automatic},
          {"num_truth", a.num_truth},
          {"num_estimate", a.num_estimate},
          {"num_pairs", a.pairs.size()},
          {"num_outside", a.num_outside},
          {"num_in_gap", a.num_in_gap},
          {"num_missing_frames", a.num_missing_frames},
          {"coverage_ratio", a.coverage_ratio},
          {"truth_period_s", is_by_index ? Json() : Json(a.truth_period_s)},
          {"estimate_period_s", is_by_index ? Json() : Json(a.estimate_period_s)}};
}

Json AlignmentJson(const PathAlignment& alignment) {
  const Quaternion& q = alignment.T_truth_estimate.rotation;
  const char* const mode = alignment.mode == AlignMode::kSe3   ? "se3"
                           : alignment.mode == AlignMode::kYaw ? "yaw"
                                                               : "none";
  return {{"mode", mode},
          {"translation_m", VectorJson(alignment.T_truth_estimate.translation)},
          {"rotation_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"used_attitude", alignment.used_attitude},
          {"rotation_uncertainty_deg", alignment.rotation_uncertainty_deg}};
}

Json OffsetJson(const RotationOffset& offset) {
  return {{"detected", offset.is_detected},    {"removed", offset.is_removed},
          {"angle_deg", offset.angle_deg},     {"axis", VectorJson(offset.axis)},
          {"scatter_deg", offset.scatter_deg}, {"name", offset.name}};
}

Json ApeJson(const AbsoluteErrors& ape) {
  return {{"position_m", StatsJson(ape.position_m)},
          {"horizontal_m", StatsJson(ape.horizontal_m)},
          {"vertical_m", StatsJson(ape.vertical_m)},
          {"rotation_deg", StatsJson(ape.rotation_deg)},
          {"rotation_without_offset_deg", StatsJson(ape.rotation_without_offset_deg)}};
}

Json DriftJson(const Drift& drift) {
  Json by_length = Json::array();
  for (const SegmentErrors& row : drift.by_length) {
    by_length.push_back({{"length_m", row.length_m},
                         {"num_segments", row.num_segments},
                         {"translation_percent", row.translation_percent},
                         {"rotation_deg_per_100m", row.rotation_deg_per_100m}});
  }
  const bool has_any = drift.num_segments > 0;
  return {{"translation_percent", has_any ? Json(drift.translation_percent) : Json()},
          {"rotation_deg_per_100m", has_any ? Json(drift.rotation_deg_per_100m) : Json()},
          {"num_segments", drift.num_segments},
          {"is_kitti_lengths", drift.is_kitti_lengths},
          {"by_length", by_length}};
}

Json StepJson(const StepErrors& step) {
  Json json = {{"interval_s", step.interval_s > 0 ? Json(step.interval_s) : Json()}};
  json.update(RelativeJson(step.errors));
  return json;
}

Json HeightJson(const HeightDrift& height) {
  return {{"end_m", height.end_m},
          {"end_percent", height.end_percent},
          {"rmse_m", height.rmse_m},
          {"max_m", height.max_m}};
}

Json EndJson(const EndErrors& end) {
  return {{"error_m", end.error_m},
          {"error_percent", end.error_percent},
          {"rotation_error_deg", end.rotation_error_deg},
          {"estimate_gap_m", end.estimate_gap_m},
          {"truth_gap_m", end.truth_gap_m}};
}

}  // namespace

Json EvaluationJson(const Evaluation& e, const ReportedFiles& files) {
  Json rpe = Json::object();
  for (const RpeRow& row : e.rpe) rpe[row.span] = row.errors ? RelativeJson(*row.errors) : Json();
  return {{"truth", files.truth},
          {"estimate", files.estimate},
          {"association", AssociationJson(e.association)},
          {"alignment", AlignmentJson(e.alignment)},
          {"rotation_offset", OffsetJson(e.rotation_offset)},
          {"path_length_m", e.path_length_m},
          {"duration_s", e.duration_s > 0 ? Json(e.duration_s) : Json()},
          {"ape", ApeJson(e.ape)},
          {"tilt_deg", e.tilt_deg ? StatsJson(*e.tilt_deg) : Json()},
          {"step", StepJson(e.step)},
          {"rpe", rpe},
          {"drift", DriftJson(e.drift)},
          {"end", EndJson(e.end)},
          {"z_drift", e.height ? HeightJson(*e.height) : Json()},
          {"notes", e.notes}};
}

}  // namespace lio
