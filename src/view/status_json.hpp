// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the parts of a frame that are text: lights, verdict, rates, latencies and losses.
#pragma once

#include <string>

#include "view/view_state.hpp"

namespace lio {

[[nodiscard]] std::string StatusJson(const ViewState& view, std::int64_t now_utime);
[[nodiscard]] std::string TimelineJson(const Timeline& timeline);

}  // namespace lio
