// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the place of a new map in a map saved before. Scans go on making their new map meanwhile,
// so that the pose of one map in the other is sought, which stays the same while the body moves:
//
//   gather    half a second of scans
//   search    both clouds at all places and turns (MapSearch): in a building their points, in a
//             larger map the things that stand in them, and then heights
//   contest   matches rank the places, and the next scans tell which one is right (PlaceContest)
//
// Each stage takes a bounded time a scan and as many scans as it needs. A search that ends without
// a place begins again when the body has moved on.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lio/relocalization/gathered_cloud.hpp"
#include "lio/relocalization/height_votes.hpp"
#include "lio/relocalization/map_search.hpp"
#include "lio/relocalization/place_contest.hpp"
#include "lio/relocalization/structure_pyramid.hpp"

namespace lio {

// Holds the parts of a saved map that the search needs. Its z axis must be up to about 10 deg.
struct PlaceIndex {
  // Throws std::invalid_argument when the points spread over more than 4 km.
  explicit PlaceIndex(std::span<const Eigen::Vector3f> points_map);

  StructurePyramid structures;
  std::optional<HeightVotes> heights;  // absent unless the structures are flat
};

// Holds a rough pose of the body at the start: within 10 m, 1.5 m of height and 30 deg.
struct PlaceGuess {
  Vector3 position_m = Vector3::Zero();
  double yaw_rad = 0.0;
};

struct PlaceMatching {
  MatchInInitial match;
  MatchInInitial match_coarsely;
  int max_matches = 0;  // full matches allowed for this scan
};

class PlaceSeeker {
 public:
  // `index` must outlive the seeker.
  PlaceSeeker(const PlaceIndex& index, const std::optional<PlaceGuess>& guess)
      : index_(&index), guess_(guess) {}

  // The new map was cleared.
  void Clear();
  // `all_points_imu` are those of the scan, more than are matched.
  [[nodiscard]] std::optional<FoundPlace> Add(const LocatedScan& scan,
                                              std::span<const Eigen::Vector3f> all_points_imu,
                                              const PlaceMatching& matching);

 private:
  [[nodiscard]] bool IsSearchDue(const Vector3& position_map) const;
  void BeginSearch(const Vector3& position_map);
  void BeginContest();
  // Returns what is sought of the sample, in the new map.
  [[nodiscard]] std::vector<Eigen::Vector3f> Sought() const;
  // Returns the poses of a found place, of which `points_map` of the sample vote for the heights.
  [[nodiscard]] std::vector<Pose> PlacesOf(const ScoredPlace& found,
                                           std::span<const Eigen::Vector3f> points_map) const;
  void GiveUp();

  const PlaceIndex* index_;
  std::optional<PlaceGuess> guess_;
  GatheredCloud cloud_;
  int num_scans_ = 0;        // since the last search began
  bool has_sought_ = false;  // in this new map
  CloudSample sample_;       // sought in the initial map
  std::optional<MapSearch> search_;
  std::optional<PlaceContest> contest_;
  bool is_ranked_ = false;  // the contest's places are
};

}  // namespace lio
