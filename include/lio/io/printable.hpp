// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Text from files, made fit for a terminal: names in a recording may hold anything.
#pragma once

#include <string>
#include <string_view>

namespace lio {

// The text with control characters and what is no UTF-8 as \xNN, a line feed as \n: it stays on one
// line and changes nothing in a terminal.
[[nodiscard]] std::string Printable(std::string_view text);

// Returns the same of the first `max_bytes`; "..." stands for the rest.
[[nodiscard]] std::string Excerpt(std::string_view text, std::size_t max_bytes = 60);

}  // namespace lio
