// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Faults of the data that the counts of a run show: sensors that are missing, doubled, saturated or
// noisy, and drives that stand still.
#pragma once

#include <vector>

#include "lio/base/counters.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/verdict/run_tally.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct DataFindingParameters {
  // Shares of messages. Chosen; drives with a right rig stay below all three
  // (docs/experiments/verdict.md).
  double max_clipped_share = 0.02;
  double max_doubled_share = 0.2;    // chosen: two senders of equal rate double one half
  double max_bad_chunk_share = 0.1;  // chosen: what a lossy network tears is less
  // s. A sensor is missing at the end. Chosen: lidar-only odometry began a second before
  // (kImuGap.segment).
  double max_without_s = 2.0;
  // s. The motion along a direction was guessed for so long. Physics: a body that accelerates by 1
  // m/s^2 is then 2 m from where a constant velocity would have led it.
  double max_guessed_s = 2.0;
  // The IMU's noise over the rig's. Measured: engines and roads in the simulator and KITTI give up
  // to 16 (docs/experiments/verdict.md); two powers of two above.
  double max_noise_ratio = 64.0;
  // Roads shake a good IMU by more than that, and the filter takes what it shows. It is no use to
  // the filter where its noise is above these, rad/s/sqrt(Hz) and m/s^2/sqrt(Hz). Physics: over a
  // sweep of 0.1 s they let the attitude go by 0.2 deg and the velocity by 0.1 m/s.
  double max_gyro_density = 0.01;
  double max_accel_density = 0.3;
};

inline constexpr DataFindingParameters kDataFindings;

// `imu`: as the rig has it; null where it is not used.
[[nodiscard]] std::vector<Cause> FindDataFaults(const Counters& counters, const RunTally& tally,
                                                const ImuRig* imu);

}  // namespace lio
