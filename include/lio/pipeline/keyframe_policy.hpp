// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which scans are keyframes and grow the map? Those that show something new: at a standstill every
// scan repeats the same rings, and a map of many such scans holds the vehicle back when it drives
// off (docs/filter.md, "Ring lock").
#pragma once

#include <optional>

#include "lio/base/pose.hpp"

namespace lio {

struct KeyframeParameters {
  // A scan after this much motion shows other surfaces. Chosen: a fifth of a cell of the map, and
  // the same for what is 7 m away; less lets rings of a crawl repeat, more leaves holes.
  double distance_m = 0.2;
  double angle_rad = 0.03;
  int max_scans_here = 4;  // chosen: enough that cells have the points to count
};

inline constexpr KeyframeParameters kKeyframe;

class KeyframePolicy {
 public:
  // Would a scan at this pose grow the map? Says yes for a few scans at one place, then only after
  // moving. Call Accept() when it did.
  bool IsKeyframe(const Pose& T_map_imu) const;
  void Accept(const Pose& T_map_imu);
  void Reset() { *this = {}; }

 private:
  bool HasMoved(const Pose& T_map_imu) const;

  std::optional<Pose> last_;  // pose at which the map was last grown after moving
  int num_here_ = 0;          // scans that grew it since
};

}  // namespace lio
