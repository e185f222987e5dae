// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a log of what liod would send on a drive round a circle, for the test of lio-view:
//   lio_view_log OUT.lcm SECONDS POINTS_A_SCAN
// The pose is at angle 0.1 t on a circle of 30 m about (0, 30, 0), at height 1 m; it starts at the
// origin and comes with each tenth of a second, and 100 times a second between scans. The points
// are spread over a square of 240 m around the pose, so that nearly all have a voxel of their own.
#include <cmath>
#include <cstdlib>
#include <random>

#include "lio/io/event_log.hpp"
#include "lio/io/status_report.hpp"

namespace lio {
namespace {

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
constexpr double kRadius_m = 30.0;
constexpr double kRate_radps = 0.1;
constexpr int kPointsAChunk = 3000;

NavOutput NavAt(std::int64_t t_us, OdometrySource source) {
  const double angle = kRate_radps * 1e-6 * static_cast<double>(t_us);
  NavOutput nav;
  nav.stamp = Timestamp::FromMicroseconds(kStart_us + t_us);
  nav.status = TrackingStatus::kOk;
  nav.source = source;
  nav.T_map_imu.translation = {kRadius_m * std::sin(angle), kRadius_m * (1.0 - std::cos(angle)),
                               1.0};
  nav.T_map_imu.rotation = Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
  nav.T_world_imu = nav.T_map_imu;
  nav.v_world_imu_mps = kRadius_m * kRate_radps * Vector3(std::cos(angle), std::sin(angle), 0.0);
  nav.pose_cov.diagonal() << 0.04, 0.01, 0.09, 1e-4, 1e-4, 1e-4;
  return nav;
}

ScanChunk CloudAt(std::int64_t t_us, std::int32_t seq, int num_points, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-120.0F, 120.0F);
  std::uniform_real_distribution<float> height(-1.0F, 8.0F);
  const Eigen::Vector3f here =
      NavAt(t_us, OdometrySource::kScanUpdate).T_map_imu.translation.cast<float>();
  ScanChunk chunk;
  chunk.stamp = Timestamp::FromMicroseconds(kStart_us + t_us);
  chunk.scan_seq = seq;
  chunk.sensor_id = -1;
  for (int i = 0; i < num_points; ++i) {
    chunk.points.push_back(
        {.x_m = here.x() + place(random), .y_m = here.y() + place(random), .z_m = height(random)});
  }
  return chunk;
}

StatusReport StatusAt(std::int64_t t_us) {
  StatusReport report;
  report.utime = kStart_us + t_us;
  report.start_utime = kStart_us;
  report.state = TrackingStatus::kOk;
  report.latency = {3.0F, 6.0F, 9.0F};
  report.counters.num_scans = t_us / 100'000;
  report.note = "a made-up drive <b>round</b> a circle";
  return report;
}

void WriteScan(EventLogWriter& writer, std::int64_t t_us, std::int32_t seq, int num_points,
               std::mt19937& random) {
  const std::int64_t utime = kStart_us + t_us;
  FilterReport filter;
  filter.nav = NavAt(t_us, OdometrySource::kScanUpdate);
  filter.gyro_bias_radps = {1e-3, 2e-3, -1e-3};
  filter.accel_bias_mps2 = {0.01, 0.02, -0.01};
  filter.nis = 4.0 + std::sin(1e-6 * static_cast<double>(t_us));
  filter.nis_dof = 6;
  filter.cov = Eigen::MatrixXd::Identity(21, 21) * 1e-4;
  ScanReport scan;
  scan.stamp = filter.nav.stamp;
  scan.num_used = 2000;
  scan.num_matched = 1900;
  scan.residual_rms_m = 0.04;
  writer.Write(utime, "LIO_ODOM", EncodeOdometry(filter.nav));
  writer.Write(utime, "LIO_STATE", EncodeFilterState(filter));
  writer.Write(utime, "LIO_REG", EncodeRegistration(scan));
  for (int left = num_points; left > 0; left -= kPointsAChunk) {
    writer.Write(utime, "LIO_CLOUD",
                 EncodeChunk(CloudAt(t_us, seq, std::min(left, kPointsAChunk), random)));
  }
}

int Main(const char* out, int num_seconds, int num_points) {
  EventLogWriter writer(out);
  std::mt19937 random(1);
  constexpr std::int64_t kStep_us = 10'000;
  const std::int64_t num_steps = std::int64_t{num_seconds} * 100;
  for (std::int64_t step = 0; step <= num_steps; ++step) {
    const std::int64_t t_us = step * kStep_us;
    if (step % 100 == 0)
      writer.Write(kStart_us + t_us, "LIO_STATUS", EncodeStatus(StatusAt(t_us), "0.1.0"));
    if (step % 10 == 0) {
      WriteScan(writer, t_us, static_cast<std::int32_t>(step / 10), num_points, random);
    }
    writer.Write(kStart_us + t_us, "LIO_ODOM_IMU",
                 EncodeOdometry(NavAt(t_us, OdometrySource::kImuPropagated)));
  }
  writer.Close();
  return 0;
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return lio::Main(argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
}
