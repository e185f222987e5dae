// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Every counter of the estimator named once, with its meaning. stats.json, LIO_STATUS and the table
// of docs/messages.md come from this list, so a new counter is one line here and one in Counters.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lio/base/counters.hpp"

namespace lio {

struct CounterField {
  std::string_view name;  // in stats.json; in status_t without "num_"
  std::int64_t Counters::*count;
  std::string_view meaning;
};

// The counters are in the order of Counters, which is the order of status_t on the wire as well.
inline constexpr std::array kCounterFields = std::to_array<CounterField>({
    {"num_imu", &Counters::num_imu, "inertial samples that arrived"},
    {"num_imu_nonfinite", &Counters::num_imu_nonfinite,
     "inertial samples refused: a value is NaN or infinite"},
    {"num_imu_duplicate", &Counters::num_imu_duplicate,
     "inertial samples refused: the same stamp as the one before"},
    {"num_imu_late", &Counters::num_imu_late,
     "inertial samples refused: stamped before samples that are fused already"},
    {"num_imu_out_of_range", &Counters::num_imu_out_of_range,
     "inertial samples refused: a value or a stamp that no sensor sends"},
    {"num_imu_clipped", &Counters::num_imu_clipped,
     "inertial samples used although an axis is at the end of its range"},
    {"num_imu_gaps", &Counters::num_imu_gaps, "gaps in the stream of inertial samples"},
    {"num_imu_stuck", &Counters::num_imu_stuck,
     "times that lidar-only odometry took over since an axis of the IMU had stopped"},
    {"num_imu_contradicted", &Counters::num_imu_contradicted,
     "times that it took over since scans contradicted the IMU"},
    {"num_chunks", &Counters::num_chunks, "chunks of scans that arrived"},
    {"num_chunks_duplicate", &Counters::num_chunks_duplicate,
     "chunks refused: the same one has arrived already"},
    {"num_chunks_late", &Counters::num_chunks_late, "chunks refused: their sweep is closed"},
    {"num_chunks_missing", &Counters::num_chunks_missing,
     "chunks that had not arrived when their sweep was closed"},
    {"num_chunks_bad", &Counters::num_chunks_bad,
     "chunks refused: index, count or time span are inconsistent"},
    {"num_points_nonfinite", &Counters::num_points_nonfinite,
     "points left out: a coordinate is NaN or infinite"},
    {"num_scans", &Counters::num_scans, "sweeps that were closed, empty ones included"},
    {"num_scans_empty", &Counters::num_scans_empty, "sweeps without a point; not used"},
    {"num_scans_dropped", &Counters::num_scans_dropped,
     "sweeps dropped because too many were waiting; only when live"},
    {"num_scans_late", &Counters::num_scans_late,
     "sweeps not used: stamped before what is fused already"},
    {"num_scans_without_imu", &Counters::num_scans_without_imu,
     "sweeps that the inertial samples do not cover"},
    {"num_scan_gaps", &Counters::num_scan_gaps, "gaps in the stream of sweeps"},
    {"num_scans_repeated", &Counters::num_scans_repeated,
     "sweeps not used: the points of the one before, although the body moved"},
    {"num_matches_rejected", &Counters::num_matches_rejected,
     "matches that were not fused, for whatever reason"},
    {"num_gated", &Counters::num_gated,
     "matches not fused: too far from the prediction for both covariances"},
    {"num_standstills", &Counters::num_standstills,
     "zero-velocity updates: sweeps taken at rest; not a loss"},
    {"num_clock_jumps", &Counters::num_clock_jumps, "clock steps of a sensor"},
    {"num_restarts", &Counters::num_restarts, "times that the estimator started again"},
    {"num_lost", &Counters::num_lost,
     "those restarts where the way had been lost: the map began anew at a guess"},
    {"num_imu_foreign", &Counters::num_imu_foreign,
     "inertial samples refused: of a second sender on the channel"},
    {"num_chunks_foreign", &Counters::num_chunks_foreign,
     "chunks refused: of a second lidar on the channel"},
});
static_assert(kCounterFields.size() * sizeof(std::int64_t) + sizeof(Ledgers) == sizeof(Counters),
              "a counter has no line in kCounterFields");

}  // namespace lio
