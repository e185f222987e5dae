// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "map/convex_hull.hpp"

#include <algorithm>
#include <numeric>

namespace lio {

std::vector<std::size_t> ConvexHull(const std::vector<Eigen::Vector2d>& places) {
  std::vector<std::size_t> sorted(places.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    const Eigen::Vector2d& p = places[a];
    const Eigen::Vector2d& q = places[b];
    if (p.x() != q.x()) return p.x() < q.x();
    return p.y() != q.y() ? p.y() < q.y() : a < b;
  });
  if (sorted.size() < 3) return sorted;
  std::vector<std::size_t> hull;
  const auto add = [&](std::size_t i, std::size_t floor) {
    while (hull.size() >= floor + 2) {
      const Eigen::Vector2d a = places[hull[hull.size() - 1]] - places[hull[hull.size() - 2]];
      const Eigen::Vector2d b = places[i] - places[hull[hull.size() - 2]];
      if (a.x() * b.y() - a.y() * b.x() > 0) break;
      hull.pop_back();
    }
    hull.push_back(i);
  };
  for (const std::size_t i : sorted) add(i, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto i = sorted.rbegin() + 1; i != sorted.rend(); ++i) add(*i, lower);
  hull.pop_back();  // the first one again
  return hull;
}

}  // namespace lio
