// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_odometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "convert/ordered_log.hpp"
#include "convert/sweep_to_chunks.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

std::vector<Timestamp> ReadTimes(const fs::path& file) {
  RefuseIrregular(file);
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  std::vector<Timestamp> times;
  std::string word;
  while (stream >> word) {
    const auto stamp = ParseStamp(word);
    if (!stamp || (!times.empty() && *stamp <= times.back())) {
      throw InputError(file.string() + ":" + std::to_string(times.size() + 1) +
                       ": no time in seconds after the one before");
    }
    times.push_back(*stamp);
  }
  return times;
}

Pose ReadCameraFromLidar(const fs::path& file) {
  auto rows = ReadKittiCalibration(file);
  const auto& row = rows.contains("Tr") ? rows["Tr"] : rows["Tr_velo_to_cam"];
  if (row.size() != 12) throw InputError(file.string() + ": no row 'Tr:' of twelve numbers");
  return ToPose({row[0], row[1], row[2], row[4], row[5], row[6], row[8], row[9], row[10]},
                {row[3], row[7], row[11]}, file.string() + ": Tr");
}

fs::path FindPoses(const KittiOdometryOptions& options) {
  if (options.poses_file) {
    if (fs::exists(*options.poses_file)) return *options.poses_file;
    throw InputError(options.poses_file->string() + ": no such file");
  }
  const fs::path usual = UsualPoses(options.sequence);
  if (fs::exists(usual)) return usual;
  throw InputError("--truth needs the sequence's poses, which are not at " + usual.string() +
                   ": name them with --poses");
}

void WriteTruth(const KittiOdometryOptions& options, const std::vector<Timestamp>& times,
                KittiOdometryReport& report) {
  report.poses_file = FindPoses(options);
  const Pose T_camera_lidar = ReadCameraFromLidar(options.sequence / "calib.txt");
  Trajectory cameras;
  try {
    cameras = ReadTrajectory(report.poses_file);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
  if (cameras.format != TrajectoryFormat::kKitti) {
    throw InputError(report.poses_file.string() + ": no KITTI poses of twelve numbers a row");
  }
  StampedPoses lidars;
  for (std::size_t i = 0; i < std::min(times.size(), cameras.poses.size()); ++i) {
    lidars.push_back({times[i], CameraToLidarPose(cameras.poses[i].pose, T_camera_lidar)});
  }
  report.num_truth_rows = static_cast<std::int64_t>(lidars.size());
  report.num_poses_missing =
      static_cast<std::int64_t>(times.size()) - static_cast<std::int64_t>(lidars.size());
  WriteTum(*options.truth_file, lidars);
}

}  // namespace

Pose CameraToLidarPose(const Pose& T_camera0_camera, const Pose& T_camera_lidar) {
  return T_camera_lidar.Inverse() * T_camera0_camera * T_camera_lidar;
}

void RaiseElevation(LidarPoint& point, double angle_rad) {
  const double across = std::hypot(point.x_m, point.y_m);
  if (across == 0.0) return;
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  const double new_across = across * cosine - point.z_m * sine;
  const double new_z = across * sine + point.z_m * cosine;
  point.x_m = static_cast<float>(point.x_m * new_across / across);
  point.y_m = static_cast<float>(point.y_m * new_across / across);
  point.z_m = static_cast<float>(new_z);
}

fs::path UsualPoses(const fs::path& sequence) {
  const fs::path whole = WholePath(sequence);
  return whole.parent_path().parent_path() / "poses" / (whole.filename().string() + ".txt");
}

std::vector<fs::path> InputsOf(const KittiOdometryOptions& options) {
  return {options.sequence, options.poses_file.value_or(UsualPoses(options.sequence))};
}

KittiOdometryReport ConvertKittiOdometry(const KittiOdometryOptions& options) {
  const fs::path folder = options.sequence / "velodyne";
  if (!fs::is_directory(folder)) {
    throw InputError(options.sequence.string() + ": no KITTI odometry sequence: no velodyne/");
  }
  KittiOdometryReport report;
  const std::vector<Timestamp> times = ReadTimes(options.sequence / "times.txt");
  auto files = NumberedFiles(folder);
  std::erase_if(files, [&](const auto& f) { return f.first >= static_cast<int>(times.size()); });
  report.num_scans_missing =
      static_cast<std::int64_t>(times.size()) - static_cast<std::int64_t>(files.size());
  if (options.truth_file) WriteTruth(options, times, report);

  OrderedLog log(options.output);
  const double raise_rad = options.vertical_correction_deg * std::numbers::pi / 180.0;
  std::int32_t scan_seq = 0;
  for (const auto& [number, file] : files) {
    if (options.progress) {
      options.progress(static_cast<double>(number) / static_cast<double>(times.size()));
    }
    auto points = ReadKittiScan(file);
    if (!points) {
      ++report.num_scans_damaged;
      continue;
    }
    const Timestamp stamp = times[static_cast<std::size_t>(number)];
    if (raise_rad != 0.0) {
      for (LidarPoint& point : *points) RaiseElevation(point, raise_rad);
    }
    const std::vector<std::int64_t> instants(points->size(), stamp.ns);
    const TimedSweep sweep = SortSweep(std::move(*points), instants);
    report.lidar.Add(stamp, stamp);
    report.num_points += static_cast<std::int64_t>(sweep.points.size());
    for (const SentChunk& sent : SplitSweep(sweep, scan_seq++, stamp)) {
      log.Add(sent.sent, kScanChannel, EncodeChunk(sent.chunk));
    }
  }
  log.Close();
  if (report.lidar.num() == 0) throw InputError(folder.string() + ": not one scan can be read");
  return report;
}

std::string FormatReport(const KittiOdometryReport& report, const KittiOdometryOptions& options) {
  std::string text;
  const auto add = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<13}{}\n", name, value);
  };
  const StreamStats& lidar = report.lidar;
  add("input", options.sequence.string());
  add("lidar",
      fmt::format("{} sweeps at {:.3f} Hz, {:.0f} points each", lidar.num(), lidar.rate_hz(),
                  static_cast<double>(report.num_points) / static_cast<double>(lidar.num())));
  add("", fmt::format("stamps {} to {} ({:.3f} s), longest period {:.1f} ms, {} gaps",
                      StampText(*lidar.first_stamp()), StampText(*lidar.last_stamp()),
                      lidar.span_s(), 1e3 * lidar.longest_gap_s(), lidar.num_gaps()));
  add("point time", "one instant a scan: the release has compensated the motion");
  add("ring", "from the order of the points, counted from below");
  add("elevation", fmt::format("raised by {} deg", options.vertical_correction_deg));
  add("imu", "none: the log serves lidar-only odometry");
  if (options.truth_file) {
    add("truth", fmt::format("{} rows to {}: pose of the lidar in the first lidar frame, from {}",
                             report.num_truth_rows, options.truth_file->string(),
                             report.poses_file.string()));
  }
  if (report.IsDamaged()) {
    add("damaged",
        fmt::format("{} scans missing, {} unreadable, {} poses missing", report.num_scans_missing,
                    report.num_scans_damaged, report.num_poses_missing));
  }
  add("output", options.output.string());
  return text;
}

}  // namespace lio
