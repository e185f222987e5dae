// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_writer.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "covariance_rows.hpp"
#include "lio/base/counters_fields.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/pcd_file.hpp"
#include "lio/io/ply_file.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/io/verdict_report.hpp"
#include "state_rows.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kNumStages> kStageNames = {"decode", "reduce", "deskew", "match",
                                                             "insert", "filter", "total"};
constexpr std::array<const char*, 3> kSeverityNames = {"info", "warning", "error"};
constexpr std::array<const char*, 6> kMatchStatusNames = {
    "converged", "max_iterations", "too_few_points", "empty_map", "diverged", "degenerate"};

std::string RegistrationHeader() {
  std::string header =
      "t_s,scan_seq,num_raw,num_used,num_matched,iterations,status,fused,residual_rms_m,nis,"
      "degenerate_mask";
  for (int i = 0; i < 6; ++i) header += fmt::format(",information_eigenvalue_{}", i);
  for (std::size_t i = 0; i < LevelCounts().size(); ++i)
    header += fmt::format(",matched_level_{}", i);
  header += ",matches";
  for (const char* stage : kStageNames) header += fmt::format(",{}_ms", stage);
  return header + "\n";
}

double Milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

std::string RegistrationRow(const ScanReport& scan) {
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{},{:.9e},{:.9e},{}", StampText(scan.stamp), scan.scan_seq,
                  scan.num_raw, scan.num_used, scan.num_matched, scan.iterations,
                  kMatchStatusNames.at(static_cast<std::size_t>(scan.status)), scan.fused ? 1 : 0,
                  scan.residual_rms_m, scan.nis, scan.degenerate_mask);
  for (const double eigenvalue : scan.information_eigenvalues) {
    row += fmt::format(",{:.9e}", eigenvalue);
  }
  for (const int num : scan.num_matched_at) row += fmt::format(",{}", num);
  row += fmt::format(",{}", scan.num_matches);
  for (const std::int64_t ns : scan.stage_ns) row += fmt::format(",{:.6f}", Milliseconds(ns));
  return row + "\n";
}

Json Summary(const QuantileSketch& values) {
  if (values.empty()) return {{"median", nullptr}, {"p99", nullptr}, {"max", nullptr}};
  const auto rounded = [](double value) { return std::round(value * 1e6) * 1e-6; };
  return {{"median", rounded(values.Quantile(0.5))},
          {"p99", rounded(values.Quantile(0.99))},
          {"max", rounded(values.max())}};
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

RunWriter::Track RunWriter::OpenTrack(const std::string& frame) const {
  Track track{OpenOutput(folder_ / ("trajectory" + frame + ".tum")),
              OpenOutput(folder_ / ("covariance" + frame + ".csv"))};
  track.covariances.stream << CovarianceHeader();
  return track;
}

void RunWriter::WriteRow(const StampedPose& pose, const Matrix6& cov, Track& track) {
  track.poses.stream << TumRow(pose) << '\n';
  track.covariances.stream << CovarianceRow(pose.stamp, cov);
}

RunWriter::RunWriter(const std::filesystem::path& folder, const Options& options)
    : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error("cannot create " + folder.string() + ": " + error.message());
  }
  for (const char* stale :
       {"stats.json", "verdict.json", "map.pcd", "map.ply", "trajectory_base.tum", "report.html"})
    std::filesystem::remove(folder / stale, error);
  OutputFile options_file = OpenOutput(folder_ / "options.yaml");
  options_file.stream << PrintResultOptions(options);
  Close(options_file);
  in_map_ = OpenTrack("");
  in_world_ = OpenTrack("_world");
  level_.emplace(folder_);
  if (options.rig.T_base_imu) base_ = OpenOutput(folder_ / "trajectory_base.tum");
  imu_rate_ = OpenOutput(folder_ / "trajectory_imu_rate.tum");
  states_ = OpenOutput(folder_ / "states.csv");
  states_.stream << StateHeader();
  notices_ = OpenOutput(folder_ / "notices.tsv");
  notices_.stream << "t_s\tseverity\ttext\n";
  registration_ = OpenOutput(folder_ / "registration.csv");
  registration_.stream << RegistrationHeader();
}

void RunWriter::Write(const Output& output, std::optional<Trust> trust) {
  if (const auto* scan = std::get_if<ScanOutput>(&output)) WriteScan(*scan, trust);
  if (const auto* notice = std::get_if<Notice>(&output)) {
    notices_.stream << fmt::format("{}\t{}\t{}\n", StampText(notice->stamp),
                                   kSeverityNames.at(static_cast<std::size_t>(notice->severity)),
                                   notice->text);
  }
  const auto* nav = std::get_if<NavOutput>(&output);
  if (nav == nullptr || nav->source != OdometrySource::kImuPropagated) return;
  if (last_imu_rate_ && nav->stamp <= *last_imu_rate_) {
    ++num_rows_not_later_;
    return;
  }
  last_imu_rate_ = nav->stamp;
  imu_rate_.stream << TumRow({nav->stamp, nav->T_map_imu}) << '\n';
}

void RunWriter::WriteScan(const ScanOutput& output, std::optional<Trust> trust) {
  registration_.stream << RegistrationRow(output.scan);
  for (std::size_t i = 0; i < kNumStages; ++i) {
    stage_ms_[i].Add(Milliseconds(output.scan.stage_ns[i]));
  }
  if (!output.filter) return;
  const NavOutput& nav = output.filter->nav;
  const ImuNoiseRatios& noise = output.filter->imu_noise;
  if (noise.gyro > 0.0) gyro_noise_ratio_.Add(noise.gyro);
  if (noise.accel > 0.0) accel_noise_ratio_.Add(noise.accel);
  if (last_scan_ && nav.stamp <= *last_scan_) {
    ++num_rows_not_later_;
    return;
  }
  last_scan_ = nav.stamp;
  WriteRow({nav.stamp, nav.T_map_imu}, output.filter->map_as_world_cov, in_map_);
  WriteRow({nav.stamp, nav.T_world_imu}, nav.pose_cov, in_world_);
  level_->Add(*output.filter);
  states_.stream << StateRow(*output.filter, trust);
  if (base_ && nav.base) base_->stream << TumRow({nav.stamp, nav.base->T_map_base}) << '\n';
}

void RunWriter::WriteMap(std::span<const Eigen::Vector3f> points_map, MapFormat format) {
  const Eigen::Matrix3f R_level_map = level_->R_level_map().toRotationMatrix().cast<float>();
  std::vector<Eigen::Vector3f> points_level;
  points_level.reserve(points_map.size());
  for (const Eigen::Vector3f& point : points_map) points_level.push_back(R_level_map * point);
  if (format == MapFormat::kPly) {
    WritePly(folder_ / "map.ply", points_level);
  } else {
    WritePcd(folder_ / "map.pcd", points_level);
  }
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
  json["num_rows_not_later"] = num_rows_not_later_;
  for (const auto& [name, count] : stats.extra) json[name] = count;
  json["log_duration_s"] = stats.log_duration_s;
  json["wall_s"] = stats.wall_s;
  json["realtime_factor"] = stats.wall_s > 0 ? stats.log_duration_s / stats.wall_s : 0.0;
  json["rss_peak_mb"] = PeakMemoryMb();
  json["imu_noise_per_rig"] = {{"gyro", Summary(gyro_noise_ratio_)},
                               {"accel", Summary(accel_noise_ratio_)}};
  for (std::size_t i = 0; i < kNumStages; ++i) {
    json["stage_ms"][kStageNames[i]] = Summary(stage_ms_[i]);
  }
  OutputFile file = OpenOutput(folder_ / "stats.json");
  file.stream << json.dump(2) << "\n";
  Close(file);
}

void RunWriter::Finish(const RunStats& stats) {
  for (Track* track : {&in_map_, &in_world_}) {
    Close(track->poses);
    Close(track->covariances);
  }
  for (OutputFile* file : {&imu_rate_, &states_, &notices_, &registration_}) Close(*file);
  if (base_) Close(*base_);
  level_->Finish();
  WriteStats(stats);
  WriteVerdict(folder_, stats.verdict);
}

}  // namespace lio
