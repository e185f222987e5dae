// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/level_track.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "covariance_rows.hpp"
#include "lio/filter/clock_smoother.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPoses = "trajectory_level.tum";
constexpr const char* kCovariances = "covariance_level.csv";
// So many rows are read at once where they are read backwards. Chosen: half a megabyte.
constexpr std::int64_t kRowsAtOnce = 1024;

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
  last_.has_clock = filter.found_clock.has_value();
  if (filter.found_clock) {
    last_.clock_as_of_ns = filter.found_clock->as_of.ns;
    Eigen::Map<Eigen::Vector2d>(last_.clock_mean) = filter.found_clock->mean;
    Eigen::Map<Eigen::Matrix2d>(last_.clock_cov) = filter.found_clock->cov;
  }
  Put(filter.nav.T_map_imu, last_.T_map_imu);
  Put(filter.nav.T_world_imu, last_.T_world_imu);
  Put(filter.T_imu_lidar, last_.T_imu_lidar);
  Eigen::Map<Matrix6>(last_.pose_cov) = filter.nav.pose_cov;
  is_level_known_ = !filter.g_world_mps2.isZero();
  rows_.write(reinterpret_cast<const char*>(&last_), sizeof last_);
  ++num_rows_;
}

std::optional<ClockEstimate> LevelTrack::ClockOf(const Row& row) {
  if (!row.has_clock) return std::nullopt;
  return ClockEstimate{Eigen::Map<const Eigen::Vector2d>(row.clock_mean),
                       Eigen::Map<const Eigen::Matrix2d>(row.clock_cov),
                       {row.clock_as_of_ns}};
}

void LevelTrack::SmoothClock() {
  ClockSmoother smoother;
  std::vector<Row> rows;
  for (std::int64_t end = num_rows_; end > 0; end -= static_cast<std::int64_t>(rows.size())) {
    rows.resize(static_cast<std::size_t>(std::min(end, kRowsAtOnce)));
    const auto size = static_cast<std::streamsize>(rows.size() * sizeof(Row));
    const std::streamoff begin = end * static_cast<std::streamoff>(sizeof(Row)) - size;
    rows_.seekg(begin);
    if (!rows_.read(reinterpret_cast<char*>(rows.data()), size)) return;
    std::for_each(rows.rbegin(), rows.rend(), [&](Row& row) {
      const std::optional<double> offset_s = smoother.Back({row.stamp_ns}, ClockOf(row));
      if (!offset_s) return;
      row.stamp_ns += Duration::FromSeconds(*offset_s).ns - row.clock_correction_ns;
    });
    rows_.seekp(begin);
    rows_.write(reinterpret_cast<const char*>(rows.data()), size);
  }
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
  Timestamp stamp{std::numeric_limits<std::int64_t>::min()};
  while (rows_.read(reinterpret_cast<char*>(&row), sizeof row)) {
    // A clock that was found anew may move a row before the one ahead of it.
    stamp = Timestamp{std::max(row.stamp_ns, stamp.ns + 1)};
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
  if (is_level_known_) SmoothClock();
  rows_.seekg(0);
  if (is_level_known_) WriteFiles();
  const bool is_whole = rows_.eof() || !is_level_known_;
  rows_.close();
  std::error_code error;
  fs::remove(rows_path_, error);
  if (!is_whole) throw std::runtime_error("cannot read " + rows_path_.string());
}

}  // namespace lio
