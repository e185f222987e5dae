// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/scan_fusion.hpp"

namespace lio {

void FuseScan(const MatchOutcome& outcome, FusionSettings settings, const ModeContext& context,
              FilterHistory& history, Health& health, ScanReport& report) {
  const FilterOptions& filter = context.options.filter;
  if (settings.grows_map) context.sensor_errors.Add(outcome.match);
  settings.sensor_error_cov = context.sensor_errors.CovPerReplacement(outcome.match);
  settings.force = outcome.is_relocalized || health.MustForce(filter.max_gated_in_a_row);
  const EventOutcome fused = FuseMatch(outcome, settings, filter, history, report.nis);
  health.AddFusion(fused);
  report.fused = fused == EventOutcome::kApplied;
}

}  // namespace lio
