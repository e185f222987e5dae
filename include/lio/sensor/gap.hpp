// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the one definition of a gap: a time without messages of a stream that its clock did not
// cause. (A clock that was set is a clock step; stream/clock_step_arbiter.hpp tells the two apart.)
// The length of a gap decides what follows from it, and every module takes the lengths from here:
//
//   samples apart by
//     30 ms    sparse      process noise is added, and turns say    filter/filter_history,
//                          nothing of the clock offset              filter/clock_offset
//     100 ms   unmeasured  no initialization in motion, and no      imu/moving_start,
//                          calibration, uses the motion across it   calib/rotation_calibration
//     150 ms   bridged     the mean of the time before stands in    stream/imu_buffer
//     200 ms   confirmed   it is counted as num_imu_gaps, once the  stream/imu_preprocessor
//                          samples after it bear the stamps out
//     1 s      segment     the state is carried over by itself      stream/imu_preprocessor
//     3 s      unknown     an outage: the place is sought again     pipeline/segment_jump
//
//   scans apart by
//     250 ms   missing     it is counted as num_scan_gaps           stream/scan_gate
//     250 ms   unjoined    from pose to pose: they are no step of   verdict/motion_record,
//                          the motion, and time between them has    verdict/run_tally
//                          no pose
//     500 ms   unrelated   no motion is measured across it          filter/clock_offset,
//                                                                   imu/motion_evidence,
//                                                                   pipeline/zero_velocity_detector
#pragma once

#include "lio/base/time.hpp"

namespace lio {

struct ImuGapParameters {
  // A line between two samples no longer follows the motion. Chosen: three periods at 100 Hz, six
  // at 200 Hz.
  Duration sparse{30'000'000};
  // Chosen: a sweep at 10 Hz, so that no sweep is without samples of its own.
  Duration unmeasured{100'000'000};
  // Samples are missing, whatever the unit. Arithmetic: one and a half periods at 10 Hz, the
  // slowest.
  Duration bridged{150'000'000};
  // One stamp alone may be wrong, so a step of this length is believed only when more samples
  // follow it. Chosen: two periods at 10 Hz.
  Duration confirmed{200'000'000};
  // A lidar goes on without a unit that has been silent for so long. Arithmetic: 3 m/s^2 of unknown
  // acceleration (ImuOutageParameters) displace the body by 1.5 m meanwhile, about as far as
  // matching searches (CorrespondenceParameters::kMaxStd_m).
  Duration segment{1'000'000'000};
  // A longer one is an outage (pipeline/outage.hpp): the doubt about the motion is 13 m by then,
  // and the place is sought. At a clock step the doubt does not grow beyond that of so long a time.
  // Chosen.
  Duration unknown{3'000'000'000};
};
inline constexpr ImuGapParameters kImuGap;

struct ScanGapParameters {
  // Sweeps are missing when one starts so long after the end of the one before. Chosen: two missing
  // sweeps of a 10 Hz lidar leave 200 ms; the rest is for stamps that jitter.
  Duration missing{250'000'000};
  // No step joins two matched poses that are so far apart. Chosen: one of a 10 Hz lidar may be
  // lacking, and half a period is for stamps that jitter.
  Duration unjoined{250'000'000};
  // Sweeps are unrelated when their ends are so far apart. Chosen: five periods at 10 Hz.
  Duration unrelated{500'000'000};
};
inline constexpr ScanGapParameters kScanGap;

}  // namespace lio
