// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/recorder.hpp"

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lio/io/event_log.hpp"
#include "lio/io/lcm_codec.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/sim/messages.hpp"
#include "rig_file.hpp"
#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr const char* kLogFile = "log.lcm";
constexpr const char* kRigFile = "config.yaml";
constexpr const char* kTruthFile = "truth.tum";
constexpr const char* kStatesFile = "truth_states.csv";
constexpr Duration kEpoch{1'700'000'000'000'000'000};
constexpr Duration kImuDelay{300'000};        // from an IMU sample to its receipt
constexpr Duration kChunkDelay{500'000};      // from a chunk's last point to its receipt
constexpr Duration kDisorder{2'000'000'000};  // messages are held this long to be put in order
constexpr double kSweepMotion_m = 20.0;       // at most, of a lidar during a sweep

// Writes truth.tum and truth_states.csv.
class TruthWriter {
 public:
  explicit TruthWriter(const std::filesystem::path& folder)
      : tum_(folder / kTruthFile), states_(folder / kStatesFile) {
    row_.precision(12);
    states_.Write(
        "t_s,vx_world_mps,vy_world_mps,vz_world_mps,"
        "gyro_bias_x_radps,gyro_bias_y_radps,gyro_bias_z_radps,"
        "accel_bias_x_mps2,accel_bias_y_mps2,accel_bias_z_mps2,"
        "wx_imu_radps,wy_imu_radps,wz_imu_radps,"
        "ax_world_mps2,ay_world_mps2,az_world_mps2\n");
  }

  void Write(const SimulatedImu& imu) {
    const Timestamp stamp = StampOf(imu.sample.stamp.ns);
    tum_.Write(TumRow({stamp, imu.truth.T_world_imu}) + "\n");
    row_.str({});
    row_ << StampText(stamp);
    for (const Vector3& v : {imu.truth.v_world_mps, imu.gyro_bias_radps, imu.accel_bias_mps2,
                             imu.truth.w_imu_radps, imu.truth.a_world_mps2}) {
      row_ << ',' << v.x() << ',' << v.y() << ',' << v.z();
    }
    row_ << '\n';
    states_.Write(row_.view());
  }

  void Close() {
    tum_.Close();
    states_.Close();
  }

 private:
  OutputFile tum_;
  OutputFile states_;
  std::ostringstream row_;
};

// Splits a sweep into chunks of at most kMaxChunkPoints, each stamped with its own first point.
std::vector<ScanChunk> SplitSweep(const SimulatedSweep& sweep, std::int64_t index) {
  const std::size_t num = sweep.points.size();
  const std::size_t size = kMaxChunkPoints;
  const std::size_t num_chunks = std::max<std::size_t>(1, (num + size - 1) / size);
  std::vector<ScanChunk> chunks(num_chunks);
  for (std::size_t i = 0; i < num_chunks; ++i) {
    ScanChunk& chunk = chunks[i];
    chunk.scan_seq = static_cast<std::int32_t>(index);
    chunk.chunk_index = static_cast<std::int16_t>(i);
    chunk.chunk_count = static_cast<std::int16_t>(num_chunks);
    const auto first = sweep.points.begin() + static_cast<std::ptrdiff_t>(i * size);
    const auto last =
        sweep.points.begin() + static_cast<std::ptrdiff_t>(std::min(num, (i + 1) * size));
    chunk.points.assign(first, last);
    const std::uint32_t offset_ns = chunk.points.empty() ? 0 : chunk.points.front().t_offset_ns;
    for (LidarPoint& point : chunk.points) point.t_offset_ns -= offset_ns;
    chunk.stamp = StampOf(sweep.begin_ns + offset_ns);
  }
  return chunks;
}

ImuEffects EffectsOn(const Scenario& scenario, ImuEffects effects) {
  effects.has_engine = effects.has_engine && scenario.is_on_car;
  return effects;
}

// Returns, in the field, the shaking by the carrier's motors, and the faults asked for after it: a
// sensor at the end of its range does not show how it is shaken.
std::vector<Fault> FaultsOn(const Scenario& scenario, const RecordOptions& options) {
  std::vector<Fault> faults;
  if (options.imu_effects.vibrates && scenario.shake_accel_mps2 > 0.0) {
    const double start_s = std::max(0.0, kStartRest_s - scenario.begin_s);
    faults.push_back(ParseFault(fmt::format("shaking:start={},accel={},gyro={}", start_s,
                                            scenario.shake_accel_mps2, scenario.shake_gyro_radps)));
  }
  faults.insert(faults.end(), options.faults.begin(), options.faults.end());
  return faults;
}

class Recording {
 public:
  Recording(const Scenario& scenario, const RecordOptions& options,
            const std::filesystem::path& folder)
      : options_(options),
        end_s_(scenario.begin_s + scenario.duration_s),
        begin_s_(scenario.begin_s),
        imu_({options.imu, options.imu_variant, options.gravity_mps2,
              EffectsOn(scenario, options.imu_effects), options.seed},
             *scenario.trajectory),
        clocks_(options.clock_errors, options.seed, StampOf(std::llround(scenario.begin_s * 1e9))),
        faults_(FaultsOn(scenario, options), options.seed,
                StampOf(std::llround(scenario.begin_s * 1e9))),
        log_(folder / kLogFile, OutputFile::Links::kReplaced),
        truth_(folder) {}

  // Sweeps must come in order.
  void AddSweep(const SimulatedSweep& sweep, std::int64_t index) {
    stats_.num_sweeps += 1;
    stats_.num_rays += sweep.num_rays;
    const auto count = [&](EchoKind kind) {
      return std::count(sweep.kinds.begin(), sweep.kinds.end(), kind);
    };
    stats_.num_in_between += count(EchoKind::kInBetween);
    stats_.num_mirrored += count(EchoKind::kMirrored);
    stats_.num_through_glass += count(EchoKind::kThroughGlass);
    stats_.num_points += static_cast<std::int64_t>(sweep.points.size());
    for (ScanChunk& chunk : SplitSweep(sweep, index)) AddChunk(std::move(chunk));
  }

  void AddChunk(ScanChunk chunk) {
    const std::uint32_t last_ns = chunk.points.empty() ? 0 : chunk.points.back().t_offset_ns;
    const Timestamp arrival = chunk.stamp + Duration{last_ns} + kChunkDelay;
    AddImuUntil(arrival - kEpoch);
    Send({arrival, std::move(chunk)});
    stats_.num_chunks += 1;
    WriteUntil(arrival - kDisorder);
  }

  RecordStats Finish() {
    AddImuUntil(StampOf(std::llround(end_s_ * 1e9)) - kEpoch);
    WriteUntil({std::numeric_limits<std::int64_t>::max()});
    log_.Close();
    truth_.Close();
    return stats_;
  }

 private:
  // Adds the IMU samples up to a trajectory time; their instants are whole microseconds, as on the
  // wire.
  void AddImuUntil(Timestamp limit) {
    for (;; ++stats_.num_imu) {
      const double t_s = begin_s_ + static_cast<double>(stats_.num_imu) / options_.imu.rate_hz;
      const std::int64_t t_ns = 1000 * std::llround(t_s * 1e6);
      if (t_ns > limit.ns || t_s > end_s_ + 1e-9) return;
      SimulatedImu imu = imu_.Sample(t_ns);
      truth_.Write(imu);
      imu.sample.stamp = StampOf(t_ns);
      const auto seq = static_cast<std::int32_t>(stats_.num_imu);
      Send({imu.sample.stamp + kImuDelay, ImuMessage{imu.sample, seq}});
    }
  }

  void Send(Message message) {
    clocks_.Stamp(message);
    for (Message& sent : faults_.Apply(std::move(message))) queue_.Push(std::move(sent));
  }

  void WriteUntil(Timestamp limit) {
    while (const std::optional<Message> message = queue_.PopBefore(limit)) {
      const std::int64_t utime = message->arrival.Microseconds();
      if (const auto* imu = std::get_if<ImuMessage>(&message->body)) {
        log_.Write(utime, "LIO_IMU", EncodeImu(imu->sample, imu->seq));
      } else {
        log_.Write(utime, "LIO_SCAN", EncodeChunk(std::get<ScanChunk>(message->body)));
      }
    }
  }

  const RecordOptions& options_;
  double end_s_;
  double begin_s_;
  ImuSimulator imu_;
  Clocks clocks_;
  FaultInjector faults_;
  EventLogWriter log_;
  TruthWriter truth_;
  ArrivalQueue queue_;
  RecordStats stats_;
};

// Returns the model with a narrow view turned to where the body's front is.
LidarModel FacingForward(LidarModel model, const Scenario& scenario) {
  if (!model.rosette && model.view_rad >= 2.0 * std::numbers::pi) return model;
  const Quaternion R_body_lidar =
      scenario.trajectory->T_body_imu().rotation * scenario.T_imu_lidar.rotation;
  const Vector3 forward = R_body_lidar.conjugate() * Vector3::UnitX();
  model.view_azimuth_rad = std::atan2(forward.y(), forward.x());
  return model;
}

struct NumberedSweep {
  std::int64_t index = 0;
  SimulatedSweep sweep;
};

// Casts sweeps on all threads and hands them over in order.
void CastSweeps(const LidarSimulator& lidar, double end_s, int num_threads,
                const std::function<void(NumberedSweep)>& take) {
  std::int64_t next = 0;
  const auto number = [&](tbb::flow_control& control) {
    if (lidar.SweepEnd_s(next) > end_s) {
      control.stop();
      return next;
    }
    return next++;
  };
  const auto cast = [&](std::int64_t index) { return NumberedSweep{index, lidar.Sweep(index)}; };
  tbb::task_arena arena(num_threads);
  arena.execute([&] {
    tbb::parallel_pipeline(
        static_cast<std::size_t>(2 * num_threads),
        tbb::make_filter<void, std::int64_t>(tbb::filter_mode::serial_in_order, number) &
            tbb::make_filter<std::int64_t, NumberedSweep>(tbb::filter_mode::parallel, cast) &
            tbb::make_filter<NumberedSweep, void>(tbb::filter_mode::serial_in_order, take));
  });
}

void CopyScans(const std::filesystem::path& log, Recording& recording) {
  EventLogReader reader(log);
  LogEvent event;
  while (reader.Next(event)) {
    ScanChunk chunk;
    if (event.channel != "LIO_SCAN") continue;
    if (DecodeChunk(event.data, chunk) != DecodeStatus::kOk) {
      throw std::runtime_error("a scan cannot be read in " + log.string());
    }
    recording.AddChunk(std::move(chunk));
  }
}

}  // namespace

Timestamp StampOf(std::int64_t trajectory_ns) {
  return Timestamp{trajectory_ns} + kEpoch;
}

std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder) {
  return {folder / kLogFile, folder / kRigFile, folder / kTruthFile, folder / kStatesFile};
}

RecordStats Record(const Scenario& scenario, const RecordOptions& options,
                   const std::filesystem::path& folder,
                   const std::function<void(double)>& progress) {
  std::filesystem::create_directories(folder);
  WriteRigFile(folder / kRigFile, scenario, options);
  Recording recording(scenario, options, folder);
  if (!options.scans.empty()) {
    CopyScans(options.scans, recording);
    return recording.Finish();
  }
  // A mirrored ray goes as far again from its mirror.
  const double reach_m = 2.0 * options.lidar.max_range_m + kSweepMotion_m;
  const Scene scene(scenario.world, reach_m);
  LidarErrors errors = options.lidar_errors;
  const std::vector<Dust> dust = DustOf(options.faults, scenario.begin_s);
  errors.dust.insert(errors.dust.end(), dust.begin(), dust.end());
  const double end_s = scenario.begin_s + scenario.duration_s;
  if (scenario.dust_per_m > 0.0) errors.dust.push_back({0.0, end_s, scenario.dust_per_m});
  const LidarSimulator lidar({FacingForward(options.lidar, scenario), scenario.T_imu_lidar, errors,
                              options.seed, scenario.begin_s},
                             scene, *scenario.trajectory);
  CastSweeps(lidar, end_s, options.num_threads, [&](const NumberedSweep& numbered) {
    recording.AddSweep(numbered.sweep, numbered.index);
    const double done_s = static_cast<double>(numbered.sweep.begin_ns) * 1e-9 - scenario.begin_s;
    if (progress) progress(done_s / scenario.duration_s);
  });
  return recording.Finish();
}

}  // namespace lio::sim
