// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the name that was probably meant by a mistyped one, for "did you mean ...?".
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lio {

// Returns the least number of insertions, deletions, substitutions and swaps of neighbours that
// turn `a` into `b`.
[[nodiscard]] int EditDistance(std::string_view a, std::string_view b);

// Returns the name with the smallest edit distance, the first of equal ones; empty when there are
// no names. A dotted name also counts as near when only its last part is near.
[[nodiscard]] std::string NearestName(std::string_view wrong, std::span<const std::string> names);

}  // namespace lio
