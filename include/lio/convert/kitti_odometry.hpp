// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts a KITTI odometry sequence to an LCM log without IMU. Its scans are already compensated
// for the car's motion, to the instant of their stamp, so all points of a scan get that one time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lio/convert/kitti_files.hpp"
#include "lio/io/stream_stats.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

struct KittiOdometryOptions {
  std::filesystem::path sequence;  // .../sequences/NN
  std::filesystem::path output;
  std::optional<std::filesystem::path> poses_file;  // default: ../../poses/NN.txt
  std::optional<std::filesystem::path> truth_file;
  double vertical_correction_deg = 0.0;  // added to every point's elevation
  std::function<void(double)> progress;  // called with the share done, 0..1; may be empty
};

struct KittiOdometryReport {
  StreamStats lidar;
  std::int64_t num_points = 0;
  std::int64_t num_scans_missing = 0;
  std::int64_t num_scans_damaged = 0;
  std::int64_t num_truth_rows = 0;
  std::int64_t num_poses_missing = 0;  // stamps that have no pose
  std::filesystem::path poses_file;    // the file that was used

  // Returns true when something was lost, which means exit code 5.
  [[nodiscard]] bool IsDamaged() const {
    return num_scans_missing + num_scans_damaged + num_poses_missing > 0;
  }
};

// Converts a camera pose in the first camera frame to the lidar's pose in the first lidar frame.
[[nodiscard]] Pose CameraToLidarPose(const Pose& T_camera0_camera, const Pose& T_camera_lidar);

// Raises a point's elevation by `angle_rad`.
void RaiseElevation(LidarPoint& point, double angle_rad);

// Returns where the release has the poses of the sequence, whether or not they are there.
[[nodiscard]] std::filesystem::path UsualPoses(const std::filesystem::path& sequence);

// Returns the files and folders that ConvertKittiOdometry reads.
[[nodiscard]] std::vector<std::filesystem::path> InputsOf(const KittiOdometryOptions& options);

// Throws InputError, or std::runtime_error when an output cannot be written.
[[nodiscard]] KittiOdometryReport ConvertKittiOdometry(const KittiOdometryOptions& options);

[[nodiscard]] std::string FormatReport(const KittiOdometryReport& report,
                                       const KittiOdometryOptions& options);

}  // namespace lio
