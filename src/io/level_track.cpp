// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/level_track.hpp"

#include <algorithm>
#include <stdexcept>

#include "covariance_rows.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPoses = "trajectory_level.tum";
constexpr const char* kCovariances = "covariance_level.csv";

// Returns the mean square error of `pose` as an estimate of what `T_world_imu` estimates: its
// covariance and the square of the known step between the two.
Matrix6 CovarianceOf(const Pose& pose, const Pose& T_world_imu, const Matrix6& world_cov) {
  Vector6 step;
  step << T_world_imu.translation - pose.translation,
      LogSo3(pose.rotation.conjugate() * T_world_imu.rotation);
  return world_cov + step * step.transpose();
}

}  // namespace

LevelTrack::LevelTrack(const fs::path& folder, bool turns_map)
    : folder_(folder), rows_path_(folder / "trajectory_level.rows"), turns_map_(turns_map) {
  std::error_code error;
  for (const char* stale : {kPoses, kCovariances}) fs::remove(folder / stale, error);
  if (fs::is_symlink(rows_path_, error)) fs::remove(rows_path_, error);
  rows_.open(rows_path_, std::ios::binary | std::ios::trunc | std::ios::in | std::ios::out);
  if (!rows_) throw OutputError("cannot write " + rows_path_.string());
}

void LevelTrack::Put(const Pose& pose, double (&to)[7]) {
  std::copy_n(pose.translation.data(), 3, to);
  std::copy_n(pose.rotation.coeffs().data(), 4, to + 3);
}

Pose LevelTrack::Get(const double (&from)[7]) {
  return {Quaternion(from[6], from[3], from[4], from[5]), Vector3(from[0], from[1], from[2])};
}

void LevelTrack::Add(const FilterReport& filter, Duration clock_correction) {
  last_.stamp_ns = filter.nav.stamp.ns;
  last_.clock_correction_ns = clock_correction.ns;
  Put(filter.nav.T_map_imu, last_.T_map_imu);
  Put(filter.nav.T_world_imu, last_.T_world_imu);
  Put(filter.T_imu_lidar, last_.T_imu_lidar);
  Eigen::Map<Matrix6>(last_.pose_cov) = filter.nav.pose_cov;
  is_level_known_ = !filter.g_world_mps2.isZero();
  rows_.write(reinterpret_cast<const char*>(&last_), sizeof last_);
}

Quaternion LevelTrack::R_level_map() const {
  if (!is_level_known_ || !turns_map_) return Quaternion::Identity();
  const Vector3 up_imu = Get(last_.T_world_imu).rotation.conjugate() * Vector3::UnitZ();
  const Vector3 up_map = Get(last_.T_map_imu).rotation * up_imu;
  return Quaternion::FromTwoVectors(up_map, Vector3::UnitZ());
}

// The row has the body as its own extrinsic made it: this is the one of the last extrinsic.
Pose LevelTrack::LastImuPose(const Row& row) const {
  const Pose T_map_imu = Get(row.T_map_imu);
  if (std::ranges::equal(row.T_imu_lidar, last_.T_imu_lidar)) return T_map_imu;
  return T_map_imu * Get(row.T_imu_lidar) * Get(last_.T_imu_lidar).Inverse();
}

void LevelTrack::Flush() {
  if (!rows_.flush()) throw WriteError("cannot write " + rows_path_.string() + " in full");
}

void LevelTrack::WriteFiles() {
  const Pose T_level_map{R_level_map(), Vector3::Zero()};
  OutputFile poses(folder_ / kPoses);
  OutputFile covariances(folder_ / kCovariances);
  covariances.Write(CovarianceHeader());
  Row row;
  while (rows_.read(reinterpret_cast<char*>(&row), sizeof row)) {
    const Timestamp stamp{row.stamp_ns + last_.clock_correction_ns - row.clock_correction_ns};
    const Pose pose = T_level_map * LastImuPose(row);
    poses.Write(TumRow({stamp, pose}) + "\n");
    const Matrix6 world_cov = Eigen::Map<const Matrix6>(row.pose_cov);
    covariances.Write(CovarianceRow(stamp, CovarianceOf(pose, Get(row.T_world_imu), world_cov)));
  }
  poses.Close();
  covariances.Close();
}

void LevelTrack::Finish() {
  Flush();
  rows_.seekg(0);
  if (is_level_known_) WriteFiles();
  const bool is_whole = rows_.eof() || !is_level_known_;
  rows_.close();
  std::error_code error;
  fs::remove(rows_path_, error);
  if (!is_whole) throw std::runtime_error("cannot read " + rows_path_.string());
}

}  // namespace lio
