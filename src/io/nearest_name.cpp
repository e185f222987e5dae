// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/nearest_name.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace lio {
namespace {

std::string_view LastPart(std::string_view dotted) {
  return dotted.substr(dotted.rfind('.') + 1);  // npos + 1 is 0
}

// A unit that was left out ("voxel" instead of "voxel_m") is a small mistake, however long it is.
int Cost(std::string_view wrong, std::string_view name) {
  const bool lacks_unit = !wrong.empty() && name.size() > wrong.size() && name.starts_with(wrong) &&
                          name[wrong.size()] == '_';
  return lacks_unit ? 1 : EditDistance(wrong, name);
}

}  // namespace

// These are rows i-2, i-1 and i of the table of the Damerau-Levenshtein distance.
int EditDistance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substituted = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string NearestName(std::string_view wrong, std::span<const std::string> names) {
  constexpr int kOtherGroupCost = 2;
  int best = std::numeric_limits<int>::max();
  std::string nearest;
  for (const std::string& name : names) {
    const int cost =
        std::min(Cost(wrong, name), kOtherGroupCost + Cost(LastPart(wrong), LastPart(name)));
    if (cost >= best) continue;
    best = cost;
    nearest = name;
  }
  return nearest;
}

}  // namespace lio
