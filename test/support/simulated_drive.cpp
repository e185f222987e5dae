// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/simulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "lio/pipeline/registration_worker.hpp"
#include "support/random_state.hpp"

namespace lio::test {
namespace {

void AddImuMessages(const DriveOptions& options, Messages& messages) {
  std::mt19937_64 random(21);
  const double white = 1.0 / std::sqrt(options.imu_step_s);
  const auto num_samples =
      static_cast<int>(std::lround((options.to_s - options.imu_from_s) / options.imu_step_s)) + 1;
  for (int i = 0; i < num_samples; ++i) {
    Message message;
    message.sample =
        ExactSample(options.motion, options.imu_from_s + i * options.imu_step_s, options.g_world);
    message.sample.w_imu_radps +=
        options.gyro_bias + options.gyro_density * white * RandomVector<3>(random);
    message.sample.f_imu_mps2 +=
        options.accel_bias + options.accel_density * white * RandomVector<3>(random);
    message.arrival = message.sample.stamp;
    messages.push_back(message);
  }
}

// Cuts a sweep into chunks of equal numbers of points, each sent with its last point.
void AddChunks(const std::vector<LidarPoint>& points, Timestamp start, int scan_seq, int num_chunks,
               Messages& messages) {
  const std::size_t per_chunk = points.size() / static_cast<std::size_t>(num_chunks) + 1;
  for (int index = 0; index < num_chunks; ++index) {
    const std::size_t first = static_cast<std::size_t>(index) * per_chunk;
    const std::size_t last = std::min(points.size(), first + per_chunk);
    Message message;
    message.is_imu = false;
    message.chunk.scan_seq = scan_seq;
    message.chunk.chunk_index = static_cast<std::int16_t>(index);
    message.chunk.chunk_count = static_cast<std::int16_t>(num_chunks);
    message.chunk.points.assign(points.begin() + static_cast<std::ptrdiff_t>(first),
                                points.begin() + static_cast<std::ptrdiff_t>(last));
    const std::uint32_t begin_ns = message.chunk.points.front().t_offset_ns;
    message.chunk.stamp = start + Duration{begin_ns};
    message.arrival = start + Duration{message.chunk.points.back().t_offset_ns};
    for (LidarPoint& point : message.chunk.points) point.t_offset_ns -= begin_ns;
    messages.push_back(std::move(message));
  }
}

void AddLidarMessages(const Scene& scene, const DriveOptions& options, Messages& messages) {
  std::mt19937_64 random(22);
  const Lidar lidar = TestLidar();
  const double span_s = options.to_s - options.lidar_from_s;
  const auto num_sweeps = static_cast<int>(std::floor(span_s / lidar.period_s + 1e-9));
  for (int seq = 0; seq < num_sweeps; ++seq) {
    const double start_s = options.lidar_from_s + seq * lidar.period_s;
    AddChunks(CastSweep(scene, lidar, options.motion, start_s, random), StampAt(start_s), seq,
              options.chunks_per_sweep, messages);
  }
}

void Collect(Odometry& odometry, RunResult& result) {
  for (Output& output : odometry.TakeOutputs()) {
    if (auto* scan = std::get_if<ScanOutput>(&output)) result.scans.push_back(std::move(*scan));
    if (auto* nav = std::get_if<NavOutput>(&output)) result.navs.push_back(*nav);
    if (auto* notice = std::get_if<Notice>(&output)) result.notices.push_back(std::move(*notice));
  }
}

// Plays the matching thread: it holds each job's outcome back for `lag` messages.
class SlowMatching {
 public:
  SlowMatching(const Options& options, int lag) : matching_(options), lag_(lag) {}

  void AfterMessage(Odometry& odometry) {
    if (outcome_ && ++held_for_ < lag_) return;
    Finish(odometry);
    while (auto job = odometry.NextJob()) {
      outcome_ = matching_.Run(*job);
      held_for_ = 0;
      if (lag_ > 0) return;
      Finish(odometry);
    }
  }
  void FinishAll(Odometry& odometry) {
    Finish(odometry);
    while (auto job = odometry.NextJob()) {
      outcome_ = matching_.Run(*job);
      Finish(odometry);
    }
  }

 private:
  void Finish(Odometry& odometry) {
    if (!outcome_) return;
    matching_.Insert(odometry.FinishJob(std::move(*outcome_)));
    outcome_.reset();
  }

  RegistrationWorker matching_;
  int lag_;
  int held_for_ = 0;
  std::optional<MatchOutcome> outcome_;
};

class ByteWriter {
 public:
  void Add(double value) { Append(&value, sizeof value); }
  void Add(std::int64_t value) { Append(&value, sizeof value); }
  template <class Derived>
  void Add(const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      for (Eigen::Index row = 0; row < values.rows(); ++row) {
        Add(static_cast<double>(values(row, column)));
      }
    }
  }
  void Add(const Pose& pose) {
    Add(pose.translation);
    Add(pose.rotation.coeffs());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void Append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

void AddFilter(const FilterReport& filter, ByteWriter& writer) {
  const NavOutput& nav = filter.nav;
  writer.Add(nav.stamp.ns);
  writer.Add(nav.scan_seq);
  writer.Add(static_cast<std::int64_t>(nav.status));
  writer.Add(nav.T_world_imu);
  writer.Add(nav.T_map_imu);
  writer.Add(nav.pose_cov);
  writer.Add(nav.v_world_imu_mps);
  writer.Add(nav.velocity_cov);
  writer.Add(nav.w_imu_radps);
  writer.Add(nav.map_pose_cov);
  writer.Add(filter.v_map_imu_mps);
  writer.Add(filter.map_velocity_cov);
  writer.Add(filter.map_as_world_cov);
  if (nav.base) {
    writer.Add(nav.base->T_world_base);
    writer.Add(nav.base->T_map_base);
    writer.Add(nav.base->velocity_cov);
  }
  writer.Add(filter.gyro_bias_radps);
  writer.Add(filter.accel_bias_mps2);
  writer.Add(filter.g_world_mps2);
  writer.Add(filter.nis);
  writer.Add(filter.cov);
}

}  // namespace

Messages SimulateDrive(const Scene& scene, const DriveOptions& options) {
  Messages messages;
  AddImuMessages(options, messages);
  AddLidarMessages(scene, options, messages);
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.arrival < b.arrival; });
  return messages;
}

Options DriveRig() {
  const DriveOptions drive;
  Options options;
  options.rig.T_imu_lidar = TestLidar().T_imu_lidar;
  options.rig.imu.gyro_noise_density = drive.gyro_density;
  options.rig.imu.accel_noise_density = drive.accel_density;
  return options;
}

RunResult RunOdometry(const Messages& messages, const Options& options, int lag,
                      const FoundSensors& known) {
  Odometry odometry(options, nullptr, StartIn::kNewMap, &known);
  SlowMatching matching(options, lag);
  RunResult result;
  for (const Message& message : messages) {
    if (message.is_imu) {
      odometry.AddImu(message.sample);
    } else {
      odometry.AddChunk(message.chunk);
    }
    matching.AfterMessage(odometry);
    Collect(odometry, result);
  }
  odometry.Flush();
  matching.FinishAll(odometry);
  Collect(odometry, result);
  result.counters = odometry.counters();
  result.status = odometry.status();
  result.verdict = odometry.Judge();
  result.found = odometry.found_sensors();
  return result;
}

std::string Bytes(const std::vector<ScanOutput>& scans) {
  ByteWriter writer;
  for (const ScanOutput& output : scans) {
    const ScanReport& scan = output.scan;
    for (const std::int64_t value :
         {scan.stamp.ns, scan.scan_seq, std::int64_t{scan.num_raw}, std::int64_t{scan.num_used},
          std::int64_t{scan.num_matched}, std::int64_t{scan.iterations},
          std::int64_t{static_cast<int>(scan.status)}, std::int64_t{scan.fused},
          std::int64_t{scan.degenerate_mask}}) {
      writer.Add(value);
    }
    writer.Add(scan.residual_rms_m);
    writer.Add(scan.information_eigenvalues);
    writer.Add(scan.nis);
    if (output.filter) AddFilter(*output.filter, writer);
  }
  return writer.bytes();
}

TrackError ErrorAgainst(const Motion& motion, const std::vector<ScanOutput>& scans, double from_s,
                        double shift_s) {
  TrackError error;
  std::optional<Pose> T_true_world;  // from the output's world to the motion's
  for (const ScanOutput& output : scans) {
    if (!output.filter) continue;
    const double t_s = SecondsOf(output.filter->nav.stamp) - shift_s;
    if (t_s < from_s) continue;
    const Pose& estimate = output.filter->nav.T_map_imu;
    const Pose truth = motion(t_s);
    if (!T_true_world) T_true_world = truth * estimate.Inverse();
    const Pose off = truth.Inverse() * (*T_true_world * estimate);
    error.end_m = off.translation.norm();
    error.max_m = std::max(error.max_m, error.end_m);
    error.max_rad = std::max(error.max_rad, LogSo3(off.rotation).norm());
    const Vector3 up = estimate.rotation.conjugate() * Vector3::UnitZ();
    const Vector3 true_up = truth.rotation.conjugate() * Vector3::UnitZ();
    error.max_tilt_rad = std::max(error.max_tilt_rad, up.cross(true_up).norm());
  }
  return error;
}

bool HasNotice(const RunResult& run, const std::string& part) {
  return std::any_of(run.notices.begin(), run.notices.end(), [&](const Notice& notice) {
    return notice.text.find(part) != std::string::npos;
  });
}

}  // namespace lio::test
