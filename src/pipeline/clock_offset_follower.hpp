// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Follows what is left of the offset between the clocks of lidar and IMU
// (filter.estimate_clock_offset), says by how much sweeps are to be moved
// (stream/stamp_correction.hpp), and announces an offset that matters once it is known.
#pragma once

#include <optional>
#include <string>

#include "lio/filter/clock_offset.hpp"
#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/match_job.hpp"
#include "lio/pipeline/options.hpp"

namespace lio {

class ClockOffsetFollower {
 public:
  // Does nothing where the options switch it off. `belief` is about the first scan.
  explicit ClockOffsetFollower(const Options& options, const ClockBelief& belief = {});

  // Begins anew, knowing nothing: what was found was wrong.
  void Restart();
  // There is no IMU any more.
  void Stop();
  // There is one again, whose clock may be another.
  void Resume();
  // A scan was lost: the next turn is not measured.
  void Interrupt();

  // To be added to the stamps of sweeps, as known now.
  [[nodiscard]] Duration correction() const;
  // Takes a scan that matching has dealt with. Gated ones as well: a wrong offset is what may have
  // them gated. Returns what to announce, once for each time the offset becomes known.
  // `gyro_density` is the gyro's noise as it is now, rad/s/sqrt(Hz).
  [[nodiscard]] std::optional<std::string> AddScan(const MatchOutcome& outcome,
                                                   const FilterHistory& history,
                                                   double gyro_density);

  bool is_running() const { return offset_.has_value(); }
  // To be added to the lidar's stamps, rig.lidar.clock_offset_s included [s].
  double total_s() const;
  double std_s() const { return offset_ ? offset_->std_s() : 0.0; }
  // The stamps may be off by so much as they are corrected now: by all that is sought before the
  // offset is known, then by what is not followed yet and three standard deviations. Absent where
  // it is not estimated.
  std::optional<double> error_s() const;
  // Returns what is known beyond rig.lidar.clock_offset_s, once stamps are moved by it.
  std::optional<ClockEstimate> Found() const { return offset_ ? offset_->Found() : std::nullopt; }
  // Returns what the drive tells of its first scan, beyond rig.lidar.clock_offset_s, where it tells
  // anything. If the IMU fell silent, what was found before comes first.
  ClockBelief AtFirstScan() const;

 private:
  const Options* options_;
  std::optional<ClockOffset> offset_;
  ClockBelief at_first_scan_;  // as found before the last Stop
  bool is_announced_ = false;
};

}  // namespace lio
