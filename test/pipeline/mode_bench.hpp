// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Owns everything that a mode of the estimator works with, so that a test drives one mode alone:
// events in, actions out. Inertial samples are those of a perfect IMU along a motion; outcomes of
// matching are poses of that motion, in a map whose frame the first scan after a cleared map fixes.
#pragma once

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "lio/base/chi_square.hpp"
#include "pipeline/mode_context.hpp"
#include "support/motion.hpp"

namespace lio::test {

inline constexpr double kImuStep_s = 0.01;
inline constexpr double kSweepSpan_s = 0.1;
inline constexpr double kSpeed_mps = 8.0;  // speed of a car on a straight road
inline constexpr double kStandardGravity_mps2 = 9.80665;

inline Options WithoutImu() {
  Options options;
  options.pipeline.use_imu = false;
  return options;
}

// Drives straight ahead along x from the origin.
inline Motion Straight(double speed_mps) {
  return [speed_mps](double t_s) {
    return Pose{Quaternion::Identity(), Vector3(speed_mps * t_s, 0, 0)};
  };
}

class ModeBench {
 public:
  explicit ModeBench(const Options& options = {})
      : examiner(options.rig, true),
        options_(options),
        stream_(MakeStreamOptions(options), counters),
        convention_(options_.rig, stream_.imu()),
        clocks_(options_),
        extrinsic_(options_) {}
  ModeBench(const ModeBench&) = delete;  // modes refer to its parts
  ModeBench& operator=(const ModeBench&) = delete;

  ModeContext context() {
    return {options_,    ChiSquareQuantile6(options_.filter.gate_probability),
            nullptr,     counters,
            outputs_,    stream_,
            sweeps,      convention_,
            clocks_,     extrinsic_,
            imu_noise_,  imu_rate_,
            stuck_imu_,  sensor_errors_,
            blind_axis_, examiner,
            place};
  }

  const ExtrinsicFollower& extrinsic() const { return extrinsic_; }

  RigExaminer examiner;
  PlaceKnowledge place{false, false};

  // Units that the messages are sent in, per SI unit.
  double force_scale = 1.0;
  double rate_scale = 1.0;

  // Feeds the samples of [from_s, to_s) to the stream and gives what the stream makes of them.
  std::vector<ImuReady> FeedImu(const Motion& motion, double from_s, double to_s) {
    const auto num_samples = static_cast<int>(std::lround((to_s - from_s) / kImuStep_s));
    for (int i = 0; i < num_samples; ++i) {
      ImuSample sample = ExactSample(motion, from_s + i * kImuStep_s);
      sample.f_imu_mps2 *= force_scale;
      sample.w_imu_radps *= rate_scale;
      stream_.AddImu(sample);
    }
    std::vector<ImuReady> ready;
    while (const std::optional<StreamEvent> event = stream_.Next(0)) {
      if (const auto* imu = std::get_if<ImuReady>(&*event)) ready.push_back(*imu);
    }
    return ready;
  }

  // A sweep of 0.1 s that joins the queue.
  SweepPtr AddSweep(double start_s) {
    auto sweep = std::make_shared<Sweep>();
    sweep->start = StampAt(start_s);
    sweep->end = StampAt(start_s + kSweepSpan_s);
    sweep->scan_seq = num_sweeps_++;
    sweeps.push_back(sweep);
    return sweep;
  }

  // Returns the outcome of a worker that matches every scan to the centimetre.
  MatchOutcome Matched(const MatchJob& job, const Motion& motion) {
    MatchOutcome outcome = Unmatched(job);
    const Pose T_world_imu = motion(SecondsOf(job.sweep->middle()));
    if (std::holds_alternative<FindVelocity>(job.task)) {
      const MotionState first = StateOf(motion, SecondsOf(sweeps.front()->middle()));
      outcome.v_map_imu_mps = first.T_world_imu.rotation.conjugate() * first.v_world_imu;
      return outcome;
    }
    if (job.map_action == MapAction::kClear) {
      outcome.match.status = MatchStatus::kEmptyMap;
      T_map_world_ = job.prior.T_map_imu * T_world_imu.Inverse();
      return outcome;
    }
    outcome.match.status = MatchStatus::kConverged;
    outcome.match.T_map_imu = T_map_world_ * T_world_imu;
    outcome.match.new_content_share = 0.0;
    outcome.match.cov.diagonal() << Vector3::Constant(1e-4), Vector3::Constant(1e-6);
    outcome.match.observable_cov = outcome.match.cov;
    return outcome;
  }

  // Returns the outcome for a scan of many points that matches the map nowhere.
  static MatchOutcome Unmatched(const MatchJob& job) {
    MatchOutcome outcome;
    outcome.sweep = job.sweep;
    outcome.num_used = 1000;
    outcome.match.status = MatchStatus::kDiverged;
    outcome.match.T_map_imu = job.prior.T_map_imu;
    return outcome;
  }

  // Takes the outputs of one type since the last call; all others are dropped.
  template <class T>
  std::vector<T> Take() {
    std::vector<T> taken;
    for (const Output& output : outputs_.Take()) {
      if (const T* found = std::get_if<T>(&output)) taken.push_back(*found);
    }
    return taken;
  }
  bool HasNotified(Notice::Severity severity) {
    bool has_notified = false;
    for (const Notice& notice : Take<Notice>()) has_notified |= notice.severity == severity;
    return has_notified;
  }

  SensorStream& stream() { return stream_; }
  SensorFixedErrors& sensor_errors() { return sensor_errors_; }
  Pose T_map_world() const { return T_map_world_; }

  Counters counters;
  std::deque<SweepPtr> sweeps;

 private:
  static StreamOptions MakeStreamOptions(const Options& options) {
    StreamOptions stream;
    stream.use_imu = options.pipeline.use_imu;
    stream.units = options.rig.imu.units;
    return stream;
  }

  Options options_;
  OutputQueue outputs_;
  SensorStream stream_;
  ImuConventionMonitor convention_;
  ImuNoiseWatch imu_noise_;
  ImuRateWatch imu_rate_;
  StuckImuDetector stuck_imu_;
  SensorFixedErrors sensor_errors_;
  BlindAxis blind_axis_;
  ClockOffsetFollower clocks_;
  ExtrinsicFollower extrinsic_;
  std::int32_t num_sweeps_ = 0;
  Pose T_map_world_;
};

}  // namespace lio::test
