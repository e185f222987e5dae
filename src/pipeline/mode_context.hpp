// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Every mode works with these. Odometry owns all of it and outlives the modes; none of it is about
// the motion, so nothing of a motion crosses a change of mode here (handover.hpp is for that). The
// blind axis is of the map, and begins anew with it.
#pragma once

#include <fmt/format.h>

#include <deque>

#include "lio/base/counters.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/stream/sensor_stream.hpp"
#include "lio/verdict/rig_examiner.hpp"
#include "pipeline/blind_axis.hpp"
#include "pipeline/clock_offset_follower.hpp"
#include "pipeline/extrinsic_follower.hpp"
#include "pipeline/health.hpp"
#include "pipeline/imu_convention_monitor.hpp"
#include "pipeline/imu_noise_watch.hpp"
#include "pipeline/imu_rate_watch.hpp"
#include "pipeline/output_queue.hpp"
#include "pipeline/place_knowledge.hpp"
#include "pipeline/sensor_fixed_errors.hpp"
#include "pipeline/stuck_imu.hpp"

namespace lio {

struct ModeContext {
  const Options& options;
  double nis_limit;  // the gate's, from filter.gate_probability
  ClockNs clock;     // null: no stage times
  Counters& counters;
  OutputQueue& outputs;
  SensorStream& stream;
  // Sweeps that inertial samples cover, oldest first. An initialization looks back on the front
  // ones, so a mode begins with those that the one before has left.
  std::deque<SweepPtr>& sweeps;
  ImuConventionMonitor& convention;
  ClockOffsetFollower& clocks;
  ExtrinsicFollower& extrinsic;
  ImuNoiseWatch& imu_noise;
  ImuRateWatch& imu_rate;
  StuckImuDetector& stuck_imu;
  SensorFixedErrors& sensor_errors;
  BlindAxis& blind_axis;
  RigExaminer& examiner;
  const PlaceKnowledge& place;

  // The oldest sweep has its row. Used: it was fused, or a map begins with it.
  void EndSweep(bool is_used) const {
    counters.ledgers.scans.Settle(is_used ? ScanFate::kUsed : ScanFate::kRejected);
    sweeps.pop_front();
  }
  // The oldest sweeps get no row: a start, or one anew, comes after them.
  void ForgetSweeps(std::size_t num) const {
    counters.ledgers.scans.Settle(ScanFate::kBeforeStart, num);
    sweeps.erase(sweeps.begin(), sweeps.begin() + static_cast<std::ptrdiff_t>(num));
  }

  std::int64_t NowNs() const { return clock == nullptr ? 0 : clock(); }
};

inline void NotifyLost(Timestamp stamp, OutputQueue& outputs) {
  outputs.Notify(stamp, Notice::Severity::kWarning,
                 fmt::format("lost: no scan has matched the map for {:g} s; the pose drifts until "
                             "one matches again, so look at what the lidar sees there",
                             kHealth.lost_after_s));
}

}  // namespace lio
