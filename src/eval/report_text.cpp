// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lio/base/angle.hpp"
#include "lio/eval/report.hpp"

namespace lio {
namespace {

std::string Row(const std::string& name, const char* unit, const ErrorStats& stats) {
  return fmt::format("{:<26}{:>5} {:>10.4f} {:>10.4f} {:>10.4f} {:>10.4f}\n", name, unit,
                     stats.rmse, stats.mean, stats.median, stats.max);
}

std::string MethodText(const Association& association) {
  if (association.method == AssociationMethod::kByIndex) return "row by row (no stamps)";
  const bool is_truth = association.method == AssociationMethod::kTruthInterpolated;
  return fmt::format("{} interpolated across gaps of up to {:.3g} s ({})",
                     is_truth ? "truth" : "denser estimate", association.max_gap_s,
                     association.is_max_gap_automatic ? "automatic" : "--max-gap");
}

std::string PeriodText(double period_s) {
  return period_s > 0 ? fmt::format(", one every {:.4g} s", period_s) : "";
}

std::string AlignmentText(const PathAlignment& alignment) {
  if (alignment.mode == AlignMode::kNone) return "none";
  return fmt::format("{}: estimate turned by {:.2f} deg and moved by {:.3f} m",
                     alignment.mode == AlignMode::kSe3 ? "se3" : "yaw",
                     LogSo3(alignment.T_truth_estimate.rotation).norm() * kDegPerRad,
                     alignment.T_truth_estimate.translation.norm());
}

std::string OffsetText(const Evaluation& evaluation) {
  if (evaluation.rotation_offset.is_detected) return evaluation.rotation_offset.name;
  return fmt::format("none (mean {:.2f} deg, scatter {:.2f} deg)",
                     evaluation.rotation_offset.angle_deg, evaluation.rotation_offset.scatter_deg);
}

std::string Head(const Evaluation& e, const ReportedFiles& files) {
  const Association& a = e.association;
  std::string text;
  text += fmt::format("truth       {}: {} poses{}\n", files.truth, a.num_truth,
                      PeriodText(a.truth_period_s));
  text += fmt::format("estimate    {}: {} poses{}\n", files.estimate, a.num_estimate,
                      PeriodText(a.estimate_period_s));
  text += fmt::format("associated  {} pairs, {}; {} outside the other's time, {} in gaps\n",
                      a.pairs.size(), MethodText(a), a.num_outside, a.num_in_gap);
  text += fmt::format("coverage    {:.1f} % of the truth, {} missing frames\n",
                      a.coverage_ratio * 100, a.num_missing_frames);
  text += fmt::format("alignment   {}\n", AlignmentText(e.alignment));
  text += fmt::format("body offset {}\n", OffsetText(e));
  text += fmt::format("path        {:.2f} m", e.path_length_m);
  return text + (e.duration_s > 0 ? fmt::format(" in {:.2f} s\n\n", e.duration_s) : "\n\n");
}

std::string Table(const Evaluation& e) {
  std::string text =
      fmt::format("{:<31} {:>10} {:>10} {:>10} {:>10}\n", "", "rmse", "mean", "median", "max");
  text += Row("APE position", "m", e.ape.position_m);
  text += Row("    horizontal", "m", e.ape.horizontal_m);
  text += Row("    vertical", "m", e.ape.vertical_m);
  text += Row("    rotation", "deg", e.ape.rotation_deg);
  text += Row("    rotation, mean removed", "deg", e.ape.rotation_without_offset_deg);
  if (e.tilt_deg) text += Row("tilt (roll and pitch)", "deg", *e.tilt_deg);
  text += Row(e.step.interval_s > 0 ? fmt::format("step, {:.3g} s", e.step.interval_s) : "step",
              "m", e.step.errors.translation_m);
  text += Row("", "deg", e.step.errors.rotation_deg);
  for (const RpeRow& row : e.rpe) {
    if (!row.errors) continue;
    text += Row("RPE over " + row.span, "m", row.errors->translation_m);
    text += Row("", "deg", row.errors->rotation_deg);
  }
  return text + "\n";
}

std::string DriftText(const Drift& drift) {
  if (drift.num_segments == 0) return "drift       path too short\n";
  return fmt::format("drift       {:.3f} %, {:.4f} deg/100m; {} segments of {:g} .. {:g} m{}\n",
                     drift.translation_percent, drift.rotation_deg_per_100m, drift.num_segments,
                     drift.by_length.front().length_m, drift.by_length.back().length_m,
                     drift.is_kitti_lengths ? "" : " (path too short for KITTI's 100 m)");
}

}  // namespace

std::string EvaluationText(const Evaluation& e, const ReportedFiles& files) {
  std::string text = Head(e, files) + Table(e) + DriftText(e.drift);
  text += fmt::format(
      "end         error {:.3f} m = {:.2f} % of the path, {:.3f} deg; start-to-end gap {:.3f} m, "
      "truth's {:.3f} m\n",
      e.end.error_m, e.end.error_percent, e.end.rotation_error_deg, e.end.estimate_gap_m,
      e.end.truth_gap_m);
  if (e.height) {
    text += fmt::format(
        "z drift     {:+.3f} m at the end = {:.2f} % of the path; rmse {:.3f} m, max {:.3f} m\n",
        e.height->end_m, e.height->end_percent, e.height->rmse_m, e.height->max_m);
  }
  for (const std::string& note : e.notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace lio
