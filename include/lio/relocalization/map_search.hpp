// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds where a small cloud may lie in a whole map, at any place and any turn about the vertical:
// branch and bound over a StructurePyramid, best first, so that the first place that comes out is
// the best of all (W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016; with a
// height besides where the pyramid is not flat). A search may take many steps of bounded cost. The
// cloud is in axes whose z is up, like the map's; with a flat pyramid its z is 0.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "lio/relocalization/place_search.hpp"
#include "lio/relocalization/structure_pyramid.hpp"

namespace lio {

struct ScoredPlace {
  PlanarPose pose;       // the cloud's axes in those of the map
  float height_m = 0.f;  // the axes'; 0 with a flat pyramid
  int score = 0;         // points that lie on one of the map, or within reach
};

class MapSearch {
 public:
  // The turn is searched about `centre`, whose place must be in the map. `around`: around `middle`,
  // a place of the axes; absent: all over the map. `pyramid` must outlive the search.
  struct Around {
    PlanarPose middle;
    PlanarRange range;
    float height_m = 0.f;  // the axes'; not asked with a flat pyramid
    float range_up_m = std::numeric_limits<float>::infinity();
  };
  MapSearch(const StructurePyramid& pyramid, std::span<const Eigen::Vector3f> points,
            const Eigen::Vector3f& centre, const std::optional<Around>& around);

  // Goes on for at most about so many look-ups. True: the search is over.
  bool GoOn(std::int64_t max_lookups);
  // They stand best first, at most 16, no two of them the same.
  [[nodiscard]] const std::vector<ScoredPlace>& places() const { return places_; }

 private:
  // Holds all shifts of a cube of 2^level cells, at one turn.
  struct Node {
    std::int32_t score = 0;  // upper bound: no place of the node has more points on the map
    std::int16_t x = 0;      // cell that `centre` comes to, the least of the cube
    std::int16_t y = 0;
    std::int16_t z = 0;
    std::int16_t turn = 0;
    std::int16_t level = 0;

    [[nodiscard]] Eigen::Vector3i cell() const { return {x, y, z}; }
  };
  struct IsWorse {
    bool operator()(const Node& a, const Node& b) const;
  };

  // Less than `least` where it cannot be as many.
  [[nodiscard]] int NumOnMap(const Node& node, int least);
  void Push(Node node);
  void AddRoots();
  void Expand(const Node& node);
  [[nodiscard]] ScoredPlace PlaceOf(const Node& node) const;
  // Returns the pose of the axes if the centre comes to `at`, and back.
  [[nodiscard]] PlanarPose PoseAt(const Eigen::Vector2f& at, float turn_rad) const;
  [[nodiscard]] Eigen::Vector3f CentreAt(const PlanarPose& pose, float height_m) const;
  [[nodiscard]] float TurnOf(const Node& node) const;
  // Returns from the first cell of a node to its last one.
  [[nodiscard]] Eigen::Vector3f WidthOf(const Node& node) const;
  [[nodiscard]] PlanarPose Refined(const PlanarPose& pose);
  [[nodiscard]] int NumExactlyOnMap(const std::vector<Eigen::Vector2f>& turned,
                                    const Eigen::Vector2f& shift) const;
  [[nodiscard]] bool IsInRange(const Node& node) const;
  [[nodiscard]] bool IsTaken(const Node& node) const;
  [[nodiscard]] int MinScore() const;

  const StructurePyramid* pyramid_;
  Eigen::Vector3f centre_;
  std::vector<Eigen::Vector3f> points_;
  std::optional<Around> around_;
  int num_points_;
  int num_turns_;
  std::vector<std::array<std::int16_t, 3>> cells_;  // by turn, then point: from the centre's
  int next_root_turn_ = 0;
  std::int64_t lookups_left_ = 0;
  std::priority_queue<Node, std::vector<Node>, IsWorse> nodes_;
  std::vector<ScoredPlace> places_;
};

}  // namespace lio
