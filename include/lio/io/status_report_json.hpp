// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The daemon's status as JSON, for viewers and exports.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lio/io/status_report.hpp"

namespace lio {

// State, trust, note, latencies, load and memory: all of a status report but stamps and counts.
[[nodiscard]] nlohmann::ordered_json StatusReportJson(const StatusReport& report);

// One line. Bytes that are no UTF-8, which a note may have, are replaced.
[[nodiscard]] std::string TextOf(const nlohmann::ordered_json& json);

}  // namespace lio
