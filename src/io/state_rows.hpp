// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the rows of states.csv: what the filter says of itself after each scan, beside the pose.
#pragma once

#include <string>

#include "lio/pipeline/outputs.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

[[nodiscard]] std::string StateHeader();
// `segment`: 1, and one more each time the clock went back.
[[nodiscard]] std::string StateRow(int segment, const FilterReport& filter, Trust trust);

}  // namespace lio
