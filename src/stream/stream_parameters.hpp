// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the constants of the stream: times after which messages are taken for late, missing or
// wrong.
#pragma once

#include <cstddef>

#include "lio/sensor/gap.hpp"

namespace lio {

struct StreamParameters {
  // s. The mean of the time before stands in for a gap (kImuGap.bridged). Measured: both steps of a
  // walker, at 1.8 a second; over one alone the body turns (docs/experiments/imu_gaps.md).
  double mean_before_gap_s = 1.1;
  // s. How far the motion strays from that mean is that of so long before. Chosen: several turns of
  // a walker.
  double spread_before_gap_s = 6.0;
  // Made-up samples stand this far from the measured ones at both edges of a gap. Chosen: less than
  // the period of any unit, so that the line between them takes no time.
  Duration gap_edge{1'000'000};
  // The correlation of the rates is measured at this lag. Chosen: a sweep at 10 Hz, over which a
  // made-up sample must hold.
  Duration correlation_lag{100'000'000};
  // It is taken for no more than this. Chosen: a rate then lasts for 10 s, longer than any gap that
  // is bridged.
  double max_correlation = 0.99;
  // rad/s and m/s^2. A made-up sample states this deviation at least, weighed as that of one
  // sample. Chosen: far below any unit's noise.
  double min_made_up_std = 1e-3;
  // s. Raw samples are kept for so long, for an initialization that looks back. Chosen: 3.5 s of
  // sweeps (InitializingParameters::max_window_s) and 6 s before them (max_turn_back_s), and 10 s
  // for those that wait, as many as the queue holds at 10 Hz.
  double imu_buffer_s = 20.0;
  // s. Sweeps alone for this long mean that the log has no IMU. Chosen: IMUs start within a second.
  double no_imu_after_s = 2.0;
  // An IMU that comes up after the lidar is used once its samples span this much. Chosen: a stray
  // sample does not count, and a start needs no more (docs/experiments/late_imu.md).
  Duration imu_appears_after{500'000'000};
  // Another lidar on the channel is taken once the first one has been silent for so long. Chosen: a
  // lidar that lives is silent for a sweep, 0.2 s, and lost ones.
  Duration replaces_lidar_after{1'000'000'000};
  // s. Clocks that are farther apart than this are different clocks. Chosen: no message is as late.
  double clocks_apart_s = 2.0;
  // A sweep may begin this much before the first inertial sample, whose reading holds there.
  // Chosen: two samples at 100 Hz.
  Duration stamp_slack{20'000'000};
  // A step of the inertial clock is held back so long, by its stamps, until a sweep tells whether
  // the lidar's clock stepped as well. Chosen: ten sweeps at 10 Hz; longer delays all poses.
  Duration wait_for_lidar{1'000'000'000};
  // The same is bounded as a count of messages, where stamps do not advance. Chosen: some seconds
  // of a 400 Hz IMU and a lidar's chunks.
  std::size_t max_judged_messages = 3000;
  // Their points are so many at most: 80 MB. Chosen: those of a sweep (ScanAssemblerParameters).
  std::size_t max_judged_points = 4 << 20;
  // Messages that wait while a match is out, at most; more are dropped, newest first, and counted.
  // Chosen: two minutes of a 400 Hz IMU; it bounds the memory.
  std::size_t max_waiting_messages = 65536;
  // Their points are so many at most: 160 MB, ten seconds of a fast lidar; chosen.
  std::size_t max_waiting_points = 8 << 20;
  // So many raw samples are kept at most, where stamps do not advance. Chosen: those of 6 kHz.
  std::size_t max_imu_samples = 1 << 17;
};

inline constexpr StreamParameters kStream;

// Bounds an inertial sample before anything is integrated (imu_preprocessor.hpp).
struct ImuPreprocessorParameters {
  // Chosen: 200 g, beyond any accelerometer that a vehicle carries.
  double max_force_mps2 = 2000.0;
  // A shorter step back is none. Chosen: drivers deliver in bursts of some samples.
  Duration jitter{80'000'000};
  // A sample is missing from here on. Arithmetic: half way between one step and two.
  double hole_in_mean_steps = 1.5;
  // So many samples in a row must tell of a time already told. Chosen: a stray stamp does not come
  // five times; so the clock steps of docs/experiments/clock_steps.md were judged.
  std::size_t confirmations = 5;
  // s, share. A clock that is set right steps forward by as much as it had gone back, but for so
  // much, and no more than this share of it. Chosen, as before: a gap of another length is none.
  double max_set_right_error_s = 0.1;
  double set_right_share = 0.25;
};
inline constexpr ImuPreprocessorParameters kImuPreprocessor;

// Tunes the finding of an axis at the end of its range (saturation_detector.hpp).
struct SaturationParameters {
  // So many equal readings in a row count. Chosen: fewer may be chance where readings are coarse;
  // used in docs/experiments/gyro_saturation.md.
  int min_equal = 5;
  // No sensor's range is smaller. Chosen: an axis that never reads anything (2 deg/s), or gravity
  // without noise (1.2 g), is not saturated.
  double min_rate_radps = 0.04;
  double min_force_mps2 = 12.0;
};
inline constexpr SaturationParameters kSaturation;

// Did the lidar's clock step as well? (clock_step_arbiter.hpp)
struct ClockStepParameters {
  // The step lies somewhere between two inertial samples, which need not come on time.
  Duration step_uncertainty = kImuGap.sparse;
  // A chunk that is so far off tells nothing. Chosen: no message is delayed by as much.
  Duration wild{5'000'000'000};
  // A lidar without chunks for so long is not seen. Chosen: ten sweeps at 10 Hz.
  Duration silence{1'000'000'000};
  std::size_t num_chunks = 4;  // chunks remembered; chosen: a step among them shows
  // Differences between the streams' stamps whose median counts. Chosen: the lidar may step a
  // message earlier, and the odd burst is outvoted.
  std::size_t num_lags = 9;
};
inline constexpr ClockStepParameters kClockStep;

// Was the lidar's clock set alone? (lidar_clock_corrector.hpp)
struct LidarClockParameters {
  // A chunk that lies farther off than this, beside the spread of lags, may come after a step.
  // Chosen: a message is delayed by less, and the estimated clock offset follows half of it.
  Duration least_step{100'000'000};
  // So many messages tell the usual lag. Chosen: as ClockStepParameters::num_lags.
  std::size_t num_known = 9;
  // The step is believed when so many messages in so long a time bear it out. Chosen: three sweeps
  // at 10 Hz; a burst of late messages is over by then.
  Duration confirmed_after{250'000'000};
  std::size_t num_confirmations = 3;
  // Chunks are held for no longer, by their stamps, and no more of them. Chosen: twice the time in
  // which a step is believed, and four sweeps of a lidar of 128 beams.
  Duration max_held{500'000'000};
  std::size_t max_num_held = 256;
  // Their points are so many at most: 40 MB. Chosen: half a second of 128 beams, and half as much.
  std::size_t max_points_held = 2 << 20;
  // A lidar whose messages are so many strides apart has paused, and its clock may be another.
  // Chosen: two messages that were lost are no pause.
  double pause_in_strides = 3.5;
  // Streams of one clock lie no farther apart. Chosen: a sweep at 5 Hz that is sent at its end, and
  // as much again for the driver.
  Duration usual_lag{400'000'000};
};
inline constexpr LidarClockParameters kLidarClock;

// Which chunks make a sweep (scan_assembler.hpp).
struct ScanAssemblerParameters {
  Duration jitter{20'000'000};  // spread of a sweep's length; chosen: a fifth of one at 10 Hz
  // Sweeps that follow each other are nearer. Chosen: two of kSweep.max_span.
  Duration apart{1'000'000'000};
  // A count of chunks beyond this, and beyond twice that of the sweep before, is believed once two
  // chunks of the sweep tell it. Chosen: three times those of 128 beams at 10 Hz; until a sweep was
  // seen, half as many again as the packets of such a lidar, if each is a chunk.
  int max_believed_chunks = 256;
  int max_first_chunks = 1024;
  // The lone chunk of a sweep whose number is farther from the one before does not tell what is
  // missing. Chosen: an outage of a minute at 10 Hz.
  std::int32_t max_seq_step = 600;
  std::size_t max_open_sweeps = 2;  // chosen: chunks of one sweep mix with the next one's alone
  // Names of closed sweeps: later stragglers are dropped as late. Chosen: 1.6 s at 10 Hz.
  std::size_t max_closed_names = 16;
  std::size_t max_points = 4 << 20;  // in a sweep; chosen: four times those of the largest lidars
};
inline constexpr ScanAssemblerParameters kScanAssembler;

// When sweeps leave for matching (scan_gate.hpp).
struct ScanGateParameters {
  // s. Sweeps wait so long for inertial samples that come late. Chosen: longer is a clock that is
  // ahead, and what waits fills the memory.
  double max_wait_s = 5.0;
  // A longer step forward may be a wrong stamp. Chosen: most gaps are shorter, and pass at once.
  Duration far_ahead{2'000'000'000};
  // The next sweep bears such a step out when it is so near. Chosen: five periods at 10 Hz; no
  // second wrong stamp comes so near to the first.
  Duration bears_out{500'000'000};
  // Late sweeps in a row, after which the lidar's clock has moved back for good. Chosen: half a
  // second at 10 Hz; wild stamps do not come five times.
  int max_late_in_a_row = 5;
  // Sweeps and points that wait at most, where stamps do not advance. Chosen: five seconds of a
  // lidar at 100 Hz, and 160 MB.
  std::size_t max_sweeps = 512;
  std::size_t max_points = 8 << 20;
};
inline constexpr ScanGateParameters kScanGate;

}  // namespace lio
