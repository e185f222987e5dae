// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// "Did you mean ...?": the name that a mistyped one was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lio {

// Insertions, deletions, substitutions and swaps of neighbours that turn a into b.
int EditDistance(std::string_view a, std::string_view b);

// The name with the smallest edit distance, the first of equals; empty without names. A dotted name
// whose last part alone is near counts as near, whatever stands before it.
std::string NearestName(std::string_view wrong, std::span<const std::string> names);

}  // namespace lio
