// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The constants of the stream: times after which messages are taken for late, missing or wrong.
#pragma once

#include <cstddef>

#include "lio/base/time.hpp"

namespace lio {

// All values of this file are chosen, by how far real messages come late, jump or stand out: a
// line says what each one has to tell apart.
struct StreamParameters {
  // The mean of the time before stands in for a gap (kImuGap.bridged). It spans both steps of a
  // walker (1.8 steps a second): over one alone the body turns.
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
  // Another lidar on the channel is taken once the first one has been silent for so long.
  Duration replaces_lidar_after{1'000'000'000};
  // Clocks that are farther apart than this are different clocks: no message is as late.
  double clocks_apart_s = 2.0;
  // A sweep may begin this much before the first inertial sample: the first reading holds there.
  Duration stamp_slack{20'000'000};
  // A step of the inertial clock is held back so long, by its stamps, until a sweep tells whether
  // the lidar's clock stepped as well; ten sweeps of a slow lidar.
  Duration wait_for_lidar{1'000'000'000};
  // The same as a count of messages, where stamps do not advance.
  std::size_t max_judged_messages = 3000;
  // Messages that wait while a match is out, at most: two minutes of a 400 Hz IMU. More are
  // dropped, newest first, and counted.
  std::size_t max_waiting_messages = 65536;
  // The same of their points: 160 MB, ten seconds of a fast lidar; chosen.
  std::size_t max_waiting_points = 8 << 20;
  // Raw samples that are kept at most, where stamps do not advance: those of 20 kHz.
  std::size_t max_imu_samples = 1 << 17;
};

inline constexpr StreamParameters kStream;

// The bounds on an inertial sample before anything is integrated (imu_preprocessor.hpp).
struct ImuPreprocessorParameters {
  double max_force_mps2 = 2000.0;   // beyond any accelerometer (200 g)
  Duration jitter{80'000'000};      // a shorter step back is none: drivers deliver in bursts
  double hole_in_mean_steps = 1.5;  // a sample is missing from here on
  std::size_t confirmations = 5;    // a stray stamp does not come five times in a row
  // A clock that is set right steps forward by as much as it had gone back, but for so much, and no
  // more than this share of it.
  double max_set_right_error_s = 0.1;
  double set_right_share = 0.25;
};
inline constexpr ImuPreprocessorParameters kImuPreprocessor;

// An axis at the end of its range (saturation_detector.hpp).
struct SaturationParameters {
  int min_equal = 5;  // equal readings in a row; fewer may be chance where readings are coarse
  // No sensor's range is smaller. An axis that never reads anything, or gravity without noise, is
  // not saturated.
  double min_rate_radps = 0.04;
  double min_force_mps2 = 12.0;
};
inline constexpr SaturationParameters kSaturation;

// Did the lidar's clock step as well? (clock_step_arbiter.hpp)
struct ClockStepParameters {
  // The step lies somewhere between two inertial samples, which need not come on time.
  Duration step_uncertainty{30'000'000};
  Duration wild{5'000'000'000};     // a chunk that is so far off tells nothing
  Duration silence{1'000'000'000};  // a lidar without chunks for so long is not seen
  std::size_t num_chunks = 4;       // that are remembered
  std::size_t num_lags = 9;         // the lidar may step a message earlier, so their median counts
};
inline constexpr ClockStepParameters kClockStep;

// Which chunks make a sweep (scan_assembler.hpp).
struct ScanAssemblerParameters {
  Duration max_sweep_span{500'000'000};  // no lidar turns slower than twice a second
  Duration jitter{20'000'000};           // of a sweep's length
  Duration apart{1'000'000'000};         // sweeps that follow each other are nearer
  std::size_t max_open_sweeps = 2;
  std::size_t max_closed_names = 16;  // later stragglers are dropped as late sweeps
  std::size_t max_points = 4 << 20;   // of a sweep: four times those of the largest lidars
};
inline constexpr ScanAssemblerParameters kScanAssembler;

// When sweeps leave for matching (scan_gate.hpp).
struct ScanGateParameters {
  double max_wait_s = 5.0;            // for inertial samples that come late
  Duration far_ahead{2'000'000'000};  // a longer step forward may be a wrong stamp
  Duration bears_out{500'000'000};    // no second wrong stamp comes so near to the first
  int max_late_in_a_row = 5;          // then the lidar's clock has moved back for good
  // Sweeps and points that wait at most, where stamps do not advance: five seconds of a lidar at
  // 100 Hz, and 160 MB.
  std::size_t max_sweeps = 512;
  std::size_t max_points = 8 << 20;
};
inline constexpr ScanGateParameters kScanGate;

}  // namespace lio
