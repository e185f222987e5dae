// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the consistency as text and as JSON. The JSON's keys are a contract: docs/evaluation.md
// lists them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lio/eval/consistency.hpp"

namespace lio {

[[nodiscard]] std::string ConsistencyText(const Consistency& consistency);
[[nodiscard]] nlohmann::ordered_json ConsistencyJson(const Consistency& consistency);

// Returns the data that tools/plot/plot_consistency.py draws: the JSON above with the series over
// time.
[[nodiscard]] nlohmann::ordered_json ConsistencyPictureData(const Consistency& consistency);

}  // namespace lio
