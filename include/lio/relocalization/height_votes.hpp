// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// At which heights may a cloud lie in a map, if its place and turn seen from above are known? Each
// of its points votes for the differences to the heights of the map's points in its column; floors
// on floors agree, so that each storey of a building gets a peak.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lio/relocalization/place_search.hpp"

namespace lio {

class HeightVotes {
 public:
  explicit HeightVotes(std::span<const Eigen::Vector3f> points_map);

  // Returns heights of the cloud's axes in the map [m], those with most votes first; at most four.
  [[nodiscard]] std::vector<float> Find(std::span<const Eigen::Vector3f> points,
                                        const PlanarPose& pose) const;

 private:
  using Column = std::int64_t;
  static Column ColumnOf(const Eigen::Vector2f& point);

  std::vector<std::pair<Column, std::int32_t>> heights_;  // in bins; in order, each once
  int lowest_ = 0;
  int highest_ = 0;
};

}  // namespace lio
