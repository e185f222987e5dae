// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking passes over the scans of a lidar that repeats itself.
#include <utility>

#include "lio/scan/repeated_sweep.hpp"
#include "pipeline/scan_step.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

bool Tracking::HasMovedUntil(Timestamp middle) const {
  if (!last_middle_ || *last_middle_ < history_.start_stamp()) return false;
  const Pose moved =
      history_.At(*last_middle_).state.T_map_imu.Inverse() * history_.At(middle).state.T_map_imu;
  return moved.translation.norm() > kRepeatedSweep.moved_m ||
         LogSo3(moved.rotation).norm() > kRepeatedSweep.moved_rad;
}

// A lidar that repeats itself tells nothing of where the body is, and is as silent.
void Tracking::PassOver(const MatchedScan& scan, std::int64_t begin_ns) {
  ++context_.counters.num_scans_repeated;
  if (!std::exchange(is_stale_told_, true)) {
    context_.outputs.Notify(scan.end(), Notice::Severity::kWarning,
                            "the lidar sends the same points again while the body moves: its scans "
                            "are not used until they change; look at its driver");
  }
  imu_agreement_.Restart();
  const Health::Verdict verdict = health_.AddScan(scan.end(), scan.outcome.match, 0, false);
  if (verdict.is_newly_lost) TellLost(scan.end());
  Publish(scan, MakeScanReport(scan.outcome), history_.At(scan.end()), begin_ns);
}

}  // namespace lio
