// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the rows of states.csv: what the filter says of itself after each scan, beside the pose.
#pragma once

#include <optional>
#include <string>

#include "lio/pipeline/outputs.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

[[nodiscard]] std::string StateHeader();
// `trust` is empty where nobody asked for it while the run went on: the row then has -1.
[[nodiscard]] std::string StateRow(const FilterReport& filter, std::optional<Trust> trust);

}  // namespace lio
