// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fuses a match in the modes that grow a map: with the sensor-fixed errors that the drive has shown
// so far, and beyond the gate where the filter itself must be wrong.
#pragma once

#include "pipeline/health.hpp"
#include "pipeline/mode_context.hpp"
#include "pipeline/scan_step.hpp"

namespace lio {

// Judges and fuses a usable match and tells `health`. Fills in what the report says of the fusion.
void FuseScan(const MatchOutcome& outcome, const FusionSettings& settings,
              const ModeContext& context, FilterHistory& history, Health& health,
              ScanReport& report);

}  // namespace lio
