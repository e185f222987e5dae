// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds where a small cloud may lie in a whole map, at any place and any turn, by the things that
// stand up in both: branch and bound over a StructurePyramid, best first, so that the first place
// that comes out is the best of all (W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM",
// ICRA 2016). A search may take many steps of bounded cost. Structures are in axes whose z is up,
// like the map's.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "lio/relocalization/place_search.hpp"
#include "lio/relocalization/structure_pyramid.hpp"

namespace lio {

struct ScoredPlace {
  PlanarPose pose;  // the structures' axes in those of the map
  int score = 0;    // structures that lie on one of the map, or beside it
};

class MapSearch {
 public:
  // The turn is searched about `centre`, whose place must be in the map. `range`: around `middle`,
  // a place of the axes; absent: all over the map. `pyramid` must outlive the search.
  struct Around {
    PlanarPose middle;
    PlanarRange range;
  };
  MapSearch(const StructurePyramid& pyramid, std::span<const Eigen::Vector2f> structures,
            const Eigen::Vector2f& centre, const std::optional<Around>& around);

  // Goes on for at most about so many look-ups. True: the search is over.
  bool GoOn(std::int64_t max_lookups);
  // They stand best first, at most 40, no two of them the same.
  [[nodiscard]] const std::vector<ScoredPlace>& places() const { return places_; }

 private:
  // Holds all shifts of a square of 2^level cells, at one turn.
  struct Node {
    std::int32_t score = 0;  // upper bound: no place of the node has more structures on the map
    std::int16_t x = 0;      // cell that `centre` comes to, the least of the square
    std::int16_t y = 0;
    std::int16_t turn = 0;
    std::int16_t level = 0;
  };
  struct IsWorse {
    bool operator()(const Node& a, const Node& b) const;
  };

  // Less than `least` where it cannot be as many.
  [[nodiscard]] int NumOnMap(const Node& node, int least);
  void Push(Node node);
  void AddRoots();
  void Expand(const Node& node);
  [[nodiscard]] PlanarPose PoseOf(const Node& node) const;
  [[nodiscard]] PlanarPose Refined(const PlanarPose& pose);
  [[nodiscard]] int NumExactlyOnMap(const std::vector<Eigen::Vector2f>& turned,
                                    const Eigen::Vector2f& shift) const;
  [[nodiscard]] bool IsInRange(const Node& node) const;
  [[nodiscard]] bool IsTaken(const Node& node) const;
  [[nodiscard]] int MinScore() const;

  const StructurePyramid* pyramid_;
  Eigen::Vector2f centre_;
  std::vector<Eigen::Vector2f> structures_;
  std::optional<Around> around_;
  int num_structures_;
  int num_turns_;
  std::vector<std::array<std::int16_t, 2>> cells_;  // by turn, then structure: from the centre's
  int next_root_turn_ = 0;
  std::int64_t lookups_left_ = 0;
  std::priority_queue<Node, std::vector<Node>, IsWorse> nodes_;
  std::vector<ScoredPlace> places_;
};

}  // namespace lio
