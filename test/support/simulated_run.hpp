// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator over simulated drives with all errors that sensors have on a vehicle, message
// by message, and measures the error at the end.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lio/io/log_input.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "lio/sim/realism.hpp"
#include "lio/sim/recorder.hpp"
#include "support/temp_dir.hpp"

namespace lio::test {

struct DriveSpec {
  std::string scenario;
  std::string lidar;
  std::optional<double> duration_s = 10.0;  // absent: the scenario's own
  std::uint64_t seed = 1;
  std::vector<sim::Fault> faults = {};  // faults of the world
  double rotation_hz = 0.0;             // 0: the lidar's own
  bool starts_moving = false;           // false: the log begins at rest
  std::string imu = "xsens_mti10";
};

// Holds a simulated drive with the contents of lio-sim's folder.
struct SimulatedLog {
  std::vector<sim::Message> messages;
  StampedPoses truth;
  Options options;

  explicit SimulatedLog(const DriveSpec& spec) {
    const TempDir dir;
    sim::ScenarioOptions scenario;
    scenario.seed = spec.seed;
    scenario.duration_s = spec.duration_s;
    scenario.starts_moving = spec.starts_moving;
    sim::RecordOptions record;
    record.lidar = sim::LoadLidarModel(spec.lidar);
    if (spec.rotation_hz > 0.0) record.lidar.rotation_hz = spec.rotation_hz;
    record.imu = sim::LoadImuModel(spec.imu);
    sim::SetRealism(sim::Realism::kField, {}, record);
    record.seed = spec.seed;
    record.faults = spec.faults;
    sim::Record(sim::MakeScenario(spec.scenario, scenario), record, dir.path(), {});
    truth = ReadTrajectory(dir.path() / "truth.tum").poses;
    options = LoadOptions({dir.path() / "config.yaml"}, {}).options;
    LogInput input(dir.path() / "log.lcm", LogInputOptions());
    std::int32_t seq = 0;
    while (auto item = input.Next()) {
      const Timestamp arrival{1000 * item->utime};
      if (const auto* sample = std::get_if<ImuSample>(&item->data)) {
        messages.push_back({arrival, sim::ImuMessage{*sample, seq++}});
      } else {
        messages.push_back({arrival, std::get<ScanChunk>(std::move(item->data))});
      }
    }
  }
};

struct RunOutcome {
  Counters counters;
  TrackingStatus status = TrackingStatus::kInit;
  int num_rows = 0;
  double end_error_m = 0.0;    // error of the motion in map from the first row to the last
  double end_error_deg = 0.0;  // rotation error of the same motion
  double end_tilt_of_map_deg = 0.0;
  double end_tilt_of_world_deg = 0.0;
};

class RunningEstimator {
 public:
  explicit RunningEstimator(const Options& options) : odometry_(options), worker_(options) {}

  void Take(sim::Message message) {
    if (const auto* imu = std::get_if<sim::ImuMessage>(&message.body)) {
      odometry_.AddImu(imu->sample);
    } else {
      odometry_.AddChunk(std::get<ScanChunk>(std::move(message.body)));
    }
    Match();
  }

  // Returns what was published, once a scan.
  [[nodiscard]] const std::vector<NavOutput>& published() const { return published_; }

  RunOutcome Finish(const StampedPoses& truth) {
    odometry_.Flush();
    Match();
    RunOutcome outcome;
    outcome.counters = odometry_.counters();
    outcome.status = odometry_.status();
    outcome.num_rows = static_cast<int>(rows_.size());
    if (rows_.size() < 2) return outcome;
    const Pose at_end = TruthAt(truth, rows_.back().stamp);
    outcome.end_tilt_of_map_deg = TiltBetween_deg(at_end, rows_.back().pose);
    outcome.end_tilt_of_world_deg = TiltBetween_deg(at_end, published_.back().T_world_imu);
    const Pose motion = rows_.front().pose.Inverse() * rows_.back().pose;
    const Pose expected = TruthAt(truth, rows_.front().stamp).Inverse() * at_end;
    const Pose error = expected.Inverse() * motion;
    outcome.end_error_m = error.translation.norm();
    outcome.end_error_deg = LogSo3(error.rotation).norm() * 57.29578;
    return outcome;
  }

 private:
  static Pose TruthAt(const StampedPoses& truth, Timestamp stamp) {
    std::size_t k = 0;
    while (k + 2 < truth.size() && truth[k + 1].stamp <= stamp) ++k;
    const double span_s = SecondsBetween(truth[k].stamp, truth[k + 1].stamp);
    return Interpolate(truth[k].pose, truth[k + 1].pose,
                       SecondsBetween(truth[k].stamp, stamp) / span_s);
  }
  // Returns the angle between the verticals that two poses of a body imply.
  static double TiltBetween_deg(const Pose& a, const Pose& b) {
    const Vector3 up_a = a.rotation.conjugate() * Vector3::UnitZ();
    const Vector3 up_b = b.rotation.conjugate() * Vector3::UnitZ();
    return std::atan2(up_a.cross(up_b).norm(), up_a.dot(up_b)) * 57.29578;
  }
  void Match() {
    while (const auto job = odometry_.NextJob()) {
      worker_.Insert(odometry_.FinishJob(worker_.Run(*job)));
    }
    for (const Output& output : odometry_.TakeOutputs()) {
      const auto* scan = std::get_if<ScanOutput>(&output);
      if (scan == nullptr || !scan->filter) continue;
      const NavOutput& nav = scan->filter->nav;
      if (!rows_.empty()) {
        EXPECT_GT(nav.stamp, rows_.back().stamp);
      }
      EXPECT_TRUE(nav.T_map_imu.translation.allFinite());
      rows_.push_back({nav.stamp, nav.T_map_imu});
      published_.push_back(nav);
    }
  }

  Odometry odometry_;
  RegistrationWorker worker_;
  StampedPoses rows_;  // in map
  std::vector<NavOutput> published_;
};

inline RunOutcome RunOver(const DriveSpec& spec, bool use_imu) {
  SimulatedLog log(spec);
  log.options.pipeline.use_imu = use_imu;
  RunningEstimator estimator(log.options);
  for (sim::Message& message : log.messages) estimator.Take(std::move(message));
  return estimator.Finish(log.truth);
}

}  // namespace lio::test
