// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The one definition of rest: the body stands, as far as inertial samples and matched scans show.
// Each alone is deceived, because a motorway at constant speed is calm to the IMU, and a bus
// alongside stands still to the lidar. The question decides how much of each is asked for, and
// every module takes its limits from here:
//
//   question                       asked by                           limits
//   does the drive begin at rest?  pipeline/initializing              kRest.at_start, and the keys
//                                                                     start.max_*_std
//   does the vehicle stop?         pipeline/zero_velocity_detector    kRest.on_the_way
//   did it stand all the time?     verdict/data_findings              kRest.whole_run
//
// Those keys (StartOptions) say how much the IMU may shake while a start takes it for standing.
// They belong to the user, whose engine may shake more than any that was tried.
#pragma once

#include <span>

#include "lio/base/so3.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// Vibration of a body at rest, 1 sigma per axis.
struct VibrationLevel {
  double gyro_std_radps = 0.0;
  double accel_std_mps2 = 0.0;
};

// The tests of rest at the start, over a second.
struct RestAtStart {
  // Scan matching moves by less than this, ... Chosen: more than it errs by over a second; the turn
  // moves what is 5 m away by as much.
  double max_shift_m = 0.05;
  double max_turn_rad = 0.01;
  // ... but where the IMU is calmer than any ride, traffic and bare ground may deceive it by more,
  // and a vehicle that moves without shaking at all is fast. Chosen: no more than an idling engine
  // (RestOnTheWay::idle), and ten times the shift that traffic on a simulated motorway caused.
  VibrationLevel calm{0.005, 0.05};
  double max_shift_calm_m = 0.5;
  // A motion that scans show is no noise from so many of its own sigmas on. Statistics.
  double min_sigmas = 3.0;
};

// On the way. A creep of max_shift_m / window_s that begins without being felt goes undetected.
struct RestOnTheWay {
  // s. Chosen: shorter lets faster creeps pass, longer sees a short stop late.
  double window_s = 1.5;
  // The length of a straight line through where the window's scans were matched, and how far a
  // single one may lie off it. Chosen: single matches of few points scatter by centimetres; a bound
  // of 2 cm on each cut standstills short (docs/experiments/zero_velocity.md).
  double max_shift_m = 0.02;
  double max_scatter_m = 0.05;
  // An idling engine adds this to the sensors' noise. Chosen: idling cars have 0.05 to 0.15 m/s^2
  // at floor and seat rail by the literature on noise and vibration, and turn little.
  VibrationLevel idle{0.005, 0.08};
  // The engine, and errors of the sensors that the filter does not know, leave this in means. The
  // force is measured: what a second of rest tells (docs/experiments/zero_velocity.md). The rate is
  // chosen: 0.03 deg/s, above a consumer unit's bias instability.
  double mean_rate_std_radps = 5e-4;
  double mean_force_std_mps2 = 0.01;
};

// Over a whole run.
struct RestOfRun {
  double max_path_m = 0.5;     // chosen: twice the noise of the map at rest
  double max_turn_rad = 0.05;  // chosen: a nod of 3 deg
};

struct RestParameters {
  // Samples are calm when their spread is below this factor times noise and vibration. Chosen: the
  // spread of 1 s of white noise varies by a few per cent only; the rest is margin for data sheets.
  double max_spread_ratio = 1.5;
  RestAtStart at_start;
  RestOnTheWay on_the_way;
  RestOfRun whole_run;
};
inline constexpr RestParameters kRest;

// Mean and spread of an interval of inertial samples.
struct ImuStatistics {
  int num_samples = 0;
  double span_s = 0.0;
  Vector3 mean_w_radps = Vector3::Zero();  // imu
  Vector3 mean_f_mps2 = Vector3::Zero();   // imu
  double gyro_std_radps = 0.0;             // on the axis of the largest spread
  double accel_std_mps2 = 0.0;             // likewise
};
// All zero without samples.
ImuStatistics Summarise(std::span<const ImuSample> samples);

// True when the spread is not larger than this vibration and the sensors' noise explain. The noise
// of a sample grows with the root of the sample rate.
bool IsCalm(const ImuStatistics& statistics, const ImuRig& imu, const VibrationLevel& vibration);

}  // namespace lio
