// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_writer.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lio/base/counters_fields.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/pcd_file.hpp"
#include "lio/io/ply_file.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/io/verdict_report.hpp"
#include "stage_names.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

// Chosen: what kill -9 or a loss of power may cost is a second, and a row is some time on its way.
// So few rows are kept that all files of a replay, which is faster than real time, end within a
// second of sensor time of each other, too.
constexpr std::chrono::milliseconds kFlushInterval(500);
constexpr int kMaxKeptRows = 100;
constexpr Duration kStepBack{100'000'000};  // chosen: a sweep at 10 Hz

constexpr std::array<const char*, 3> kSeverityNames = {"info", "warning", "error"};

Json Summary(const QuantileSketch& values) {
  if (values.empty()) return {{"median", nullptr}, {"p99", nullptr}, {"max", nullptr}};
  const auto rounded = [](double value) { return std::round(value * 1e6) * 1e-6; };
  return {{"median", rounded(values.Quantile(0.5))},
          {"p99", rounded(values.Quantile(0.99))},
          {"max", rounded(values.max())}};
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  const double mean = sum / static_cast<double>(values.size());
  return std::round(std::sqrt(mean) * 1e7) / 1e7;
}

// How large the errors of the beams are over all rings, and how well they are known.
Json BeamStats(const std::optional<LidarBeams>& beams) {
  if (!beams) return nullptr;
  const auto of = [](const std::vector<double>& errors, const std::vector<double>& stds) -> Json {
    return {{"rms", RootMeanSquare(errors)}, {"std", RootMeanSquare(stds)}};
  };
  return {{"range_m", of(beams->range_m, beams->range_std_m)},
          {"elevation_rad", of(beams->elevation_rad, beams->elevation_std_rad)},
          {"azimuth_rad", of(beams->azimuth_rad, beams->azimuth_std_rad)}};
}

Json CounterStats(const Counters& counters) {
  Json json;
  for (const CounterField& field : kCounterFields) {
    json[std::string(field.name)] = counters.*field.count;
  }
  return json;
}

double PeakMemoryMb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 * 1e-6;
}

}  // namespace

fs::path RunWriter::FolderOf(int segment) const {
  return segment == 1 ? folder_ : folder_ / fmt::format("segment_{}", segment);
}

RunWriter::RunWriter(const fs::path& folder, const Options& options, StartIn start_in)
    : folder_(folder),
      has_base_(options.rig.T_base_imu),
      turns_map_(start_in == StartIn::kNewMap),
      whole_(folder, has_base_, turns_map_),
      notices_(folder_ / "notices.tsv") {
  std::error_code error;
  for (const char* stale :
       {"stats.json", "verdict.json", "beams.yaml", "map.pcd", "map.ply", "report.html"}) {
    fs::remove(folder / stale, error);
  }
  for (int segment = 2; fs::exists(FolderOf(segment) / "registration.csv"); ++segment) {
    fs::remove_all(FolderOf(segment), error);
  }
  WriteText(folder_ / "options.yaml", PrintResultOptions(options));
  notices_.Write("t_s\tseverity\ttext\n");
  Flush();
}

template <typename Action>
void RunWriter::Try(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    if (!failure_) failure_ = error.what();
  }
}

void RunWriter::Flush() {
  if (failure_) return;
  num_kept_ = 0;
  last_flush_ = std::chrono::steady_clock::now();
  Try([this] {
    whole_.Flush();
    if (segment_) segment_->Flush();
    notices_.Flush();
  });
}

void RunWriter::Write(const Output& output) {
  Summarize(output);
  if (failure_) return;
  Try([&] { WriteRows(output); });
  const bool is_due = ++num_kept_ >= kMaxKeptRows ||
                      std::chrono::steady_clock::now() - last_flush_ >= kFlushInterval;
  if (is_due) Flush();
}

void RunWriter::WriteRows(const Output& output) {
  if (const auto* notice = std::get_if<Notice>(&output)) {
    notices_.Write(fmt::format("{}\t{}\t{}\n", StampText(notice->stamp),
                               kSeverityNames.at(static_cast<std::size_t>(notice->severity)),
                               notice->text));
  }
  if (StepsBack(output)) {
    if (segment_) segment_->Finish();
    segment_.emplace(FolderOf(++num_segments_), has_base_, turns_map_);
  }
  whole_.Write(output, num_segments_);
  if (segment_) segment_->Write(output, num_segments_);
}

void RunWriter::Summarize(const Output& output) {
  const auto* scan = std::get_if<ScanOutput>(&output);
  if (scan == nullptr) return;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    stage_ms_[i].Add(Milliseconds(scan->scan.stage_ns[i]));
  }
  if (!scan->filter) return;
  const ImuNoiseRatios& noise = scan->filter->imu_noise;
  if (noise.gyro > 0.0) gyro_noise_ratio_.Add(noise.gyro);
  if (noise.accel > 0.0) accel_noise_ratio_.Add(noise.accel);
}

bool RunWriter::StepsBack(const Output& output) {
  const auto* scan = std::get_if<ScanOutput>(&output);
  const auto* nav = std::get_if<NavOutput>(&output);
  if (scan == nullptr && (nav == nullptr || nav->source != OdometrySource::kImuPropagated)) {
    return false;
  }
  const Timestamp stamp = scan != nullptr ? scan->scan.stamp : nav->stamp;
  std::optional<Timestamp>& last = scan != nullptr ? last_sweep_ : last_imu_rate_;
  const bool steps_back = last && *last - stamp > kStepBack;
  if (steps_back) {  // rows of either kind
    last_sweep_.reset();
    last_imu_rate_.reset();
  }
  last = stamp;
  return steps_back;
}

void RunWriter::WriteCloud(std::span<const Eigen::Vector3f> points_map, const fs::path& file) {
  const Eigen::Matrix3f R_level_map =
      (segment_ ? *segment_ : whole_).R_level_map().toRotationMatrix().cast<float>();
  std::vector<Eigen::Vector3f> points_level;
  points_level.reserve(points_map.size());
  for (const Eigen::Vector3f& point : points_map) points_level.push_back(R_level_map * point);
  if (file.extension() == ".ply") {
    WritePly(file, points_level);
  } else {
    WritePcd(file, points_level);
  }
}

void RunWriter::WriteMap(std::span<const Eigen::Vector3f> points_map, MapFormat format) {
  const char* name = format == MapFormat::kPly ? "map.ply" : "map.pcd";
  Try([&] { WriteCloud(points_map, folder_ / name); });
}

std::string RunWriter::SaveMap(std::span<const Eigen::Vector3f> points_map,
                               const std::string& name) {
  try {
    WriteCloud(points_map, folder_ / fs::path(name).filename());
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

void RunWriter::WriteStats(const RunStats& stats) {
  Json json = CounterStats(stats.counters);
  for (int i = 1; i < kNumDecodeStatuses; ++i) {
    const auto name = Name(static_cast<DecodeStatus>(i));
    json[fmt::format("num_messages_{}", name)] =
        stats.input.num_refused[static_cast<std::size_t>(i)];
  }
  json["num_imu_missing"] = stats.input.num_imu_missing;
  json["num_skipped_bytes"] = stats.num_skipped_bytes;
  json["num_rows_not_later"] = whole_.num_rows_not_later();
  json["num_segments"] = num_segments_;
  for (const auto& [name, count] : stats.extra) json[name] = count;
  json["account"] = Json::parse(AccountJson(stats.account, stats.input));
  json["log_duration_s"] = stats.log_duration_s;
  json["num_passes"] = stats.num_passes;
  json["wall_s"] = stats.wall_s;
  json["realtime_factor"] = stats.wall_s > 0 ? stats.log_duration_s / stats.wall_s : 0.0;
  json["rss_peak_mb"] = PeakMemoryMb();
  json["imu_noise_per_rig"] = {{"gyro", Summary(gyro_noise_ratio_)},
                               {"accel", Summary(accel_noise_ratio_)}};
  json["beam_errors"] = BeamStats(stats.beams);
  for (std::size_t i = 0; i < kNumStages; ++i) {
    json["stage_ms"][kStageNames[i]] = Summary(stage_ms_[i]);
  }
  WriteText(folder_ / "stats.json", json.dump(2) + "\n");
}

void RunWriter::Finish(const RunStats& stats) {
  Try([this] { whole_.Finish(); });
  Try([this] {
    if (segment_) segment_->Finish();
  });
  Try([this] { notices_.Close(); });
  Try([&] { WriteStats(stats); });
  Try([&] { WriteVerdict(folder_, stats.verdict); });
  if (stats.beams && stats.verdict.trust != Trust::kNo) {
    Try([&] { WriteText(folder_ / "beams.yaml", PrintBeams(*stats.beams)); });
  }
  if (failure_) throw WriteError(*failure_);
}

}  // namespace lio
