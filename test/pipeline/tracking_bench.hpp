// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the mode of tracking alone along a motion, from a state that is right.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/mode_bench.hpp"
#include "pipeline/tracking.hpp"

namespace lio::test {

// Returns the true state of a motion, as sure as after a second of rest.
inline StartState TrueStart(const Motion& motion, double at_s) {
  const MotionState truth = StateOf(motion, at_s);
  StartState start;
  start.g_world = kGravity;
  start.estimate.stamp = StampAt(at_s);
  start.estimate.state.T_world_imu = truth.T_world_imu;
  start.estimate.state.T_map_imu = truth.T_world_imu;
  start.estimate.state.v_world_imu = truth.v_world_imu;
  const auto set = [&](int at, double std) {
    start.estimate.cov.diagonal().segment<3>(at).setConstant(std * std);
  };
  set(kPos, 0.01);
  set(kRot, 0.002);
  set(kVel, 0.05);
  set(kGyroBias, 0.001);
  set(kAccelBias, 0.02);
  return start;
}

// Begins at second 0 of the motion, after a tenth of a second of samples.
struct TrackingBench {
  explicit TrackingBench(const Motion& along, const Options& options = {}, Handover handover = {},
                         bool is_at_rest = false)
      : TrackingBench(along, TrueStart(along, 0.0), options, std::move(handover), is_at_rest) {}
  TrackingBench(const Motion& along, const StartState& start, const Options& options = {},
                Handover handover = {}, bool is_at_rest = false)
      : motion(along),
        bench(options),
        is_fed(!bench.FeedImu(motion, -0.1, kImuStep_s).empty()),
        mode(bench.context(), std::move(handover), start, is_at_rest) {}

  // Gives the mode the samples up to `to_s`, which is not included.
  void FeedImu(double to_s) {
    if (goes_by_stream) {
      for (const ImuReady& ready : bench.FeedImu(motion, imu_from_s, to_s)) mode.AddImu(ready);
    } else {
      for (double t_s = imu_from_s; t_s < to_s - 0.5 * kImuStep_s; t_s += kImuStep_s) {
        mode.AddImu({ExactSample(motion, t_s)});
      }
    }
    imu_from_s = to_s;
  }
  // Gives the mode the samples of the next sweep and then the sweep itself.
  SweepPtr FeedSweep() {
    const double end_s = sweep_start_s + kSweepSpan_s;
    FeedImu(end_s + kImuStep_s);
    const SweepPtr sweep = bench.AddSweep(sweep_start_s);
    mode.AddSweep(*sweep);
    sweep_start_s = end_s;
    return sweep;
  }
  MatchJob NextJob() { return mode.MakeJob(FeedSweep()); }
  std::optional<Transition> Finish(const MatchOutcome& outcome) {
    insert = {};
    return mode.FinishJob(outcome, insert);
  }
  // Each of these runs one scan, which is matched or not.
  std::optional<Transition> Match() { return Finish(bench.Matched(NextJob(), motion)); }
  std::optional<Transition> Miss() { return Finish(bench.Unmatched(NextJob())); }
  // These run so many scans, or end with the first transition.
  std::optional<Transition> Match(int num_scans) {
    for (int i = 0; i < num_scans; ++i) {
      if (auto transition = Match()) return transition;
    }
    return std::nullopt;
  }
  std::optional<Transition> Miss(int num_scans) {
    for (int i = 0; i < num_scans; ++i) {
      if (auto transition = Miss()) return transition;
    }
    return std::nullopt;
  }

  // The sweep to come begins there, and with it the samples that are still to come. The stream no
  // longer judges them, for that is a gap or a step of the clock.
  void GoOnAt(double from_s) {
    sweep_start_s = from_s;
    imu_from_s = from_s;
    goes_by_stream = false;
  }

  // A segment of the inertial stream begins there, one second after the start of the drive.
  void StartSegment(double first_s, ImuPreprocessor::Step step) {
    mode.StartSegment({ExactSample(motion, first_s), step, StampAt(1.0)});
    GoOnAt(first_s);
  }

  Motion motion;
  ModeBench bench;
  bool is_fed;
  Tracking mode;
  InsertTask insert;
  double sweep_start_s = 0.0;
  double imu_from_s = kImuStep_s;
  bool goes_by_stream = true;
};

// Drives straight ahead; one second of it is tracked.
struct AfterOneSecond : TrackingBench {
  AfterOneSecond() : TrackingBench(Straight(kSpeed_mps)) { EXPECT_FALSE(Match(10)); }
};

// The place along the drive at which a job expects the body, and its standard deviation, m.
inline double XOf(const MatchJob& job) {
  return job.prior.T_map_imu.translation.x();
}
inline double StdOf(const MatchJob& job) {
  return std::sqrt(job.prior.cov(0, 0));
}

// The map that the record of the motion counts the next step to, which is added for this.
inline int MapOfNextStep(MotionRecord& record) {
  constexpr double kLate_s = 100.0;
  const std::vector<ImuSample> samples =
      ExactSamples(Straight(0.0), kLate_s, kLate_s + 0.2, kImuStep_s);
  record.Interrupt();
  record.Add({StampAt(kLate_s), {}}, Duration{}, samples);
  record.Add({StampAt(kLate_s + 0.1), {}}, Duration{}, samples);
  record.Interrupt();
  return record.steps().back().map;
}

}  // namespace lio::test
