// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which scans grow the map: those that show something new. From a standstill every scan repeats the
// same rings, and a map of many such scans holds the vehicle back when it drives off.
#pragma once

#include <optional>

#include "lio/base/pose.hpp"

namespace lio {

class KeyframePolicy {
 public:
  // Would a scan at this pose grow the map? Says yes for a few scans at one place, then only after
  // moving. Call Accept() when it did.
  bool IsKeyframe(const Pose& T_map_imu) const;
  void Accept(const Pose& T_map_imu);
  void Reset() { *this = {}; }

 private:
  bool HasMoved(const Pose& T_map_imu) const;

  std::optional<Pose> last_;  // where the map was last grown after moving
  int num_here_ = 0;          // scans that grew it since
};

}  // namespace lio
