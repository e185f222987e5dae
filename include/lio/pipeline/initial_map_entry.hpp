// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The initial map's matcher waits beside that of the new map, which scans make until their place in
// the initial map is found; then both change places. Points that scans add after that stay in the
// initial map.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "lio/pipeline/initial_map.hpp"
#include "lio/registration/match_budget.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/place_seeker.hpp"

namespace lio {

class InitialMapEntry {
 public:
  // `waiting`: a matcher with an empty map. Throws std::invalid_argument when it has no use for
  // points, and when they spread over more than 4 km.
  InitialMapEntry(const InitialMap& map, std::unique_ptr<ScanMatcher> waiting);

  // Seeks the place of the new map by a scan that it has located.
  [[nodiscard]] std::optional<FoundPlace> Seek(const LocatedScan& scan,
                                               std::span<const Eigen::Vector3f> all_points_imu,
                                               const Pose& T_imu_lidar, MatchBudget& budget);
  // `matcher`, that of the new map, becomes that of the initial one.
  void Enter(std::unique_ptr<ScanMatcher>& matcher);
  // A new map begins: `matcher` becomes that of the new map, if it was that of the initial one.
  void Leave(std::unique_ptr<ScanMatcher>& matcher);
  // Scans are matched in the initial map.
  [[nodiscard]] bool is_inside() const { return is_inside_; }

 private:
  PlaceIndex index_;
  PlaceSeeker seeker_;
  std::unique_ptr<ScanMatcher> waiting_;
  bool is_inside_ = false;
};

}  // namespace lio
