// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the next frame for one client: what changed since its last one, and no more than it can
// take at once. A client that is slow gets the newest pose and scan; those between are left out and
// counted. Nothing waits for it in memory.
#pragma once

#include <cstdint>

#include "view/view_state.hpp"

namespace lio {

// A client has this.
struct ClientCursor {
  struct Rows {
    std::uint32_t generation = 0;
    std::size_t num = 0;
  };
  Rows map, path, states;
  std::uint32_t pose = 0;  // numbers of Numbered
  std::uint32_t scan = 0;
  std::uint32_t status = 0;
  std::uint32_t timeline = 0;
  std::int64_t status_utime = 0;  // when the status was sent last
  std::uint32_t num_scans_left_out = 0;
  std::uint32_t num_poses_left_out = 0;
};

struct FrameBudget {
  std::size_t max_map_points = 16'384;  // 100 kB: half a million a second at 30 frames
  std::size_t max_rows = 8'192;
};

// Gives nothing when the client has everything. `now_utime` is the host's clock; it decides when a
// status is due though none came, which tells that the daemon is silent.
[[nodiscard]] std::optional<Bytes> NextFrame(const ViewState& view, std::int64_t now_utime,
                                             ClientCursor& cursor, const FrameBudget& budget = {});

}  // namespace lio
