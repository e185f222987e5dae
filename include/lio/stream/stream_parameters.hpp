// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The constants of the stream: times after which messages are taken for late, missing or wrong.
#pragma once

#include <cstddef>

#include "lio/base/time.hpp"

namespace lio {

struct StreamParameters {
  // A gap: samples of an IMU of 10 Hz and more are nearer than this to each other. What the sensor
  // did in a longer one is taken from the mean of the time before.
  double imu_gap_s = 0.15;
  // That mean spans both steps of a walker (1.8 steps a second): over one alone the body turns.
  double mean_before_gap_s = 1.1;
  // Made-up samples stand this far from the measured ones at both edges of a gap.
  Duration gap_edge{1'000'000};
  // Raw samples that are kept for an initialization that looks back over 3.5 s of sweeps, twice.
  double imu_buffer_s = 6.0;
  // Sweeps alone for this long mean that the log has no IMU: IMUs start within a second.
  double no_imu_after_s = 2.0;
  // An IMU that comes up after the lidar is used once its samples span this much: a stray sample
  // does not count.
  Duration imu_appears_after{500'000'000};
  // Clocks that are farther apart than this are different clocks: no message is as late.
  double clocks_apart_s = 2.0;
  // A sweep may begin this much before the first inertial sample: the first reading holds there.
  Duration stamp_slack{20'000'000};
  // A step of the inertial clock is held back so long, by its stamps, until a sweep tells whether
  // the lidar's clock stepped as well; ten sweeps of a slow lidar.
  Duration wait_for_lidar{1'000'000'000};
  // The same as a count of messages, where stamps do not advance.
  std::size_t max_judged_messages = 3000;
  // A held sample that is this far ahead of the others tells no time: its stamp is wrong.
  Duration stray{200'000'000};
  // By the lidar's clock, samples are missing at a step of the inertial clock from this on.
  Duration missing_at_step{150'000'000};
  // Messages that wait while a match is out, at most: two minutes of a 400 Hz IMU. More are
  // dropped, newest first, and counted.
  std::size_t max_waiting_messages = 65536;
};

inline constexpr StreamParameters kStream;

}  // namespace lio
