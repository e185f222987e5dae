// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A request says where to look for a scan that is not where it was predicted.
#pragma once

#include <cstdint>
#include <optional>

#include "lio/base/pose.hpp"

namespace lio {

enum class SearchRegion : std::int8_t {
  // Anywhere, unless the last located scan had degenerate directions: there inertial prediction is
  // better than a search.
  kObservable,
  // For scans that inertial prediction tracks: a match near a sure prior is only checked, and from
  // an unsure one the scan is sought, unless the last located one had degenerate directions.
  kTracked,
  kAnywhere,
};

struct SearchRequest {
  SearchRegion region = SearchRegion::kAnywhere;
  // The pose if no time has passed at a step of the stamps (the clock was set): tried as well.
  std::optional<Pose> T_map_imu_alternative;
};

}  // namespace lio
