// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the daemon's status as JSON, for viewers and exports.
#pragma once

#include <nlohmann/json.hpp>

#include "lio/io/status_report.hpp"

namespace lio {

// State, trust, note, latencies, load and memory: all of a status report but stamps and counts.
[[nodiscard]] nlohmann::ordered_json StatusReportJson(const StatusReport& report);

}  // namespace lio
