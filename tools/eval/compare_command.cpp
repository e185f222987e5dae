// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lio {
namespace {

std::string Percent(const Drift& drift) {
  return drift.num_segments > 0 ? fmt::format("{:.3f}", drift.translation_percent) : "";
}

}  // namespace

std::string ComparisonText(const std::vector<ScoredRun>& runs) {
  std::size_t width = 3;
  for (const ScoredRun& run : runs) width = std::max(width, run.name.size());
  std::string text =
      fmt::format("{:<{}} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "run", width,
                  "path m", "APE m", "max m", "rot deg", "drift %", "end m", "covered", "offset s");
  for (const ScoredRun& run : runs) {
    const Evaluation& e = run.evaluation;
    text += fmt::format(
        "{:<{}} {:>9.1f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8} {:>8.3f} {:>7.1f}% {:>8.4f}\n", run.name,
        width, e.path_length_m, e.ape.position_m.rmse, e.ape.position_m.max,
        e.ape.rotation_without_offset_deg.rmse, Percent(e.drift), e.end.error_m,
        100.0 * e.association.coverage_ratio, run.time_offset_s);
  }
  return text;
}

std::string ComparisonCsv(const std::vector<ScoredRun>& runs) {
  std::string text =
      "run,path_length_m,ape_rmse_m,ape_max_m,rotation_rmse_deg,drift_percent,end_error_m,"
      "coverage_ratio,time_offset_s\n";
  for (const ScoredRun& run : runs) {
    const Evaluation& e = run.evaluation;
    std::string name = run.name;  // RFC 4180: quotes are doubled
    for (std::size_t at = name.find('"'); at != std::string::npos; at = name.find('"', at + 2)) {
      name.insert(at, "\"");
    }
    text += fmt::format("\"{}\",{:.3f},{:.6f},{:.6f},{:.6f},{},{:.6f},{:.6f},{:.6f}\n", name,
                        e.path_length_m, e.ape.position_m.rmse, e.ape.position_m.max,
                        e.ape.rotation_without_offset_deg.rmse, Percent(e.drift), e.end.error_m,
                        e.association.coverage_ratio, run.time_offset_s);
  }
  return text;
}

}  // namespace lio
