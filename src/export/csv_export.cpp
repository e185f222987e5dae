// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a table of each kind of message. Stamps are sensor time in nanoseconds, `received_ns` is
// the log's.
#include <fmt/format.h>

#include <memory>

#include "export/output_reader.hpp"
#include "lio/base/counters_fields.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/output_file.hpp"

namespace lio {
namespace {

// Writes a file that is made with its first row.
class Table {
 public:
  Table(std::filesystem::path path, std::string header)
      : path_(std::move(path)), header_(std::move(header)) {}

  void Add(const std::string& row) {
    if (file_ == nullptr) {
      file_ = std::make_unique<OutputFile>(path_);
      file_->Write(header_ + "\n");
    }
    file_->Write(row + "\n");
  }
  void Close() {
    if (file_ != nullptr) file_->Close();
  }

 private:
  std::filesystem::path path_;
  std::string header_;
  std::unique_ptr<OutputFile> file_;
};

// Returns values behind commas, with as many digits as bring the same number back.
template <typename Vector>
std::string Values(const Vector& vector) {
  std::string text;
  for (Eigen::Index i = 0; i < vector.size(); ++i) text += fmt::format(",{}", vector(i));
  return text;
}

std::string PoseValues(const Pose& pose) {
  const Quaternion& q = pose.rotation;
  return Values(pose.translation) + fmt::format(",{},{},{},{}", q.x(), q.y(), q.z(), q.w());
}

// Returns the entries on and above the diagonal, row by row.
std::string UpperTriangle(const Matrix6& cov) {
  std::string text;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) text += fmt::format(",{}", cov(row, column));
  }
  return text;
}

std::string OdometryHeader() {
  std::string header =
      "stamp_ns,received_ns,scan_seq,status,x_m,y_m,z_m,qx,qy,qz,qw,vx_mps,vy_mps,vz_mps,"
      "wx_radps,wy_radps,wz_radps,map_x_m,map_y_m,map_z_m,map_qx,map_qy,map_qz,map_qw";
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) header += fmt::format(",cov_{}{}", row, column);
  }
  return header;
}

std::string OdometryRow(const NavOutput& nav, Timestamp received) {
  return fmt::format("{},{},{},{}", nav.stamp.ns, received.ns, nav.scan_seq,
                     static_cast<int>(nav.status)) +
         PoseValues(nav.T_world_imu) + Values(nav.v_world_imu_mps) + Values(nav.w_imu_radps) +
         PoseValues(nav.T_map_imu) + UpperTriangle(nav.pose_cov);
}

constexpr const char* kStateHeader =
    "stamp_ns,received_ns,vx_mps,vy_mps,vz_mps,gyro_bias_x_radps,gyro_bias_y_radps,"
    "gyro_bias_z_radps,accel_bias_x_mps2,accel_bias_y_mps2,accel_bias_z_mps2,gravity_x_mps2,"
    "gravity_y_mps2,gravity_z_mps2,clock_offset_s,clock_offset_std_s,nis,nis_dof";

std::string StateRow(const FilterReport& report, Timestamp received) {
  return fmt::format("{},{}", report.nav.stamp.ns, received.ns) +
         Values(report.nav.v_world_imu_mps) + Values(report.gyro_bias_radps) +
         Values(report.accel_bias_mps2) + Values(report.g_world_mps2) +
         fmt::format(",{},{},{},{}", report.clock_offset_s, report.clock_offset_std_s, report.nis,
                     report.nis_dof);
}

constexpr const char* kRegistrationHeader =
    "stamp_ns,received_ns,scan_seq,num_raw,num_used,num_matched,iterations,status,fused,rms_m,nis,"
    "degenerate_mask,decode_ns,reduce_ns,deskew_ns,match_ns,insert_ns,filter_ns,total_ns";

std::string RegistrationRow(const ScanReport& r, Timestamp received) {
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", r.stamp.ns, received.ns, r.scan_seq,
                  r.num_raw, r.num_used, r.num_matched, r.iterations, static_cast<int>(r.status),
                  r.fused ? 1 : 0, r.residual_rms_m, r.nis, r.degenerate_mask);
  for (const std::int64_t time_ns : r.stage_ns) row += fmt::format(",{}", time_ns);
  return row;
}

std::string StatusHeader() {
  std::string header =
      "utime_us,received_ns,state,trust,latency_p50_ms,latency_p99_ms,latency_max_ms,cpu_cores,"
      "rss_mb,map_mb,clock_offset_s,clock_offset_std_s,kernel_dropped";
  for (const CounterField& field : kCounterFields) header += fmt::format(",{}", field.name);
  return header;
}

std::string StatusRow(const StatusReport& report, Timestamp received) {
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", report.utime, received.ns,
                  static_cast<int>(report.state), static_cast<int>(report.trust),
                  report.latency.p50_ms, report.latency.p99_ms, report.latency.max_ms,
                  report.cpu_load_cores, report.rss_mb, report.map_mb, report.clock_offset.offset_s,
                  report.clock_offset.std_s, report.num_kernel_dropped);
  for (const CounterField& field : kCounterFields) {
    row += fmt::format(",{}", report.counters.*field.count);
  }
  return row;
}

}  // namespace

ExportCounts ExportCsv(const std::filesystem::path& log, const std::filesystem::path& folder,
                       const ExportOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError("cannot create " + folder.string() + ": " + error.message());
  Table odometry(folder / "odometry.csv", OdometryHeader());
  Table odometry_imu(folder / "odometry_imu.csv", OdometryHeader());
  Table state(folder / "state.csv", kStateHeader);
  Table registration(folder / "registration.csv", kRegistrationHeader);
  Table status(folder / "status.csv", StatusHeader());
  OutputTakers takers;
  takers.odometry = [&](const NavOutput& nav, Timestamp at) { odometry.Add(OdometryRow(nav, at)); };
  takers.odometry_imu = [&](const NavOutput& nav, Timestamp at) {
    odometry_imu.Add(OdometryRow(nav, at));
  };
  takers.state = [&](const FilterReport& report, Timestamp at) { state.Add(StateRow(report, at)); };
  takers.registration = [&](const ScanReport& report, Timestamp at) {
    registration.Add(RegistrationRow(report, at));
  };
  takers.status = [&](const StatusReport& report, Timestamp at) {
    status.Add(StatusRow(report, at));
  };
  const ExportCounts counts = ReadOutputs(log, options, takers);
  for (Table* table : {&odometry, &odometry_imu, &state, &registration, &status}) table->Close();
  return counts;
}

}  // namespace lio
