// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/view_state.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

namespace lio {
namespace {

constexpr double kMaxPosition_m = 1e7;         // beyond are no places, and floats lose metres
constexpr Duration kBackwards{1'000'000'000};  // stamps that go back further belong to another run
constexpr float kMinStep_m = 0.02F;  // step of the path: standing still makes it no longer
constexpr std::int64_t kFullCloudHolds_us = 2'000'000;

bool IsPlace(const Vector3& position) {
  return position.cwiseAbs().maxCoeff() < kMaxPosition_m;
}

float AsFloat(double value) {
  return static_cast<float>(value);
}

}  // namespace

PositionEllipsoid EllipsoidOf(const NavOutput& nav) {
  const Quaternion q_map_world = nav.T_map_imu.rotation * nav.T_world_imu.rotation.conjugate();
  const Matrix3 R_map_world = q_map_world.normalized().toRotationMatrix();
  const Matrix3 cov_map =
      R_map_world * nav.pose_cov.topLeftCorner<3, 3>() * R_map_world.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(0.5 * (cov_map + cov_map.transpose()));
  if (solver.info() != Eigen::Success) return {};
  Matrix3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  return {Quaternion(axes).normalized(), solver.eigenvalues().cwiseMax(0.0).cwiseSqrt()};
}

ViewState::ViewState(const Limits& limits)
    : limits_(limits),
      map_(limits.max_map_points),
      path_(limits.max_path_rows),
      states_(limits.max_state_rows) {}

void ViewState::OnOdometry(const NavOutput& nav, std::int64_t recv_utime) {
  if (!IsPlace(nav.T_map_imu.translation)) {
    CountRefused();
    return;
  }
  if (GoesBack(nav)) Clear();
  newest_stamps_[nav.source] = nav.stamp;
  const bool is_scan_rate = nav.source == OdometrySource::kScanUpdate;
  Count(is_scan_rate ? ViewChannel::kOdometry : ViewChannel::kOdometryImuRate, recv_utime);
  if (is_scan_rate) {
    const Vector3& p = nav.T_map_imu.translation;
    const PathRow row{AsFloat(p.x()), AsFloat(p.y()), AsFloat(p.z()),
                      static_cast<float>(nav.status)};
    const auto& rows = path_.rows();
    const bool has_moved = rows.empty() || rows.back().status != row.status ||
                           std::hypot(row.x_m - rows.back().x_m, row.y_m - rows.back().y_m,
                                      row.z_m - rows.back().z_m) >= kMinStep_m;
    if (has_moved) path_.Add(row);
  }
  // A scan's pose is older than that of the newest sample, which came first.
  if (pose_.number > 0 && nav.stamp < pose_.value.nav.stamp) return;
  pose_.Set({nav, recv_utime});
}

void ViewState::OnFilterState(const FilterReport& report) {
  StateRow row;
  row.t_s = 1e-9 * static_cast<double>(report.nav.stamp.ns);
  if (!states_.rows().empty() && row.t_s <= states_.rows().back().t_s) return;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    row.values[at] = AsFloat(report.nav.v_world_imu_mps[i]);
    row.values[3 + at] = AsFloat(report.gyro_bias_radps[i]);
    row.values[6 + at] = AsFloat(report.accel_bias_mps2[i]);
  }
  row.values[9] = report.nis_dof > 0 ? AsFloat(report.nis) : 0.0F;
  states_.Add(row);
}

// Each source by itself: where matching lags, a scan's pose may be old beside the newest sample's.
bool ViewState::GoesBack(const NavOutput& nav) const {
  const auto newest = newest_stamps_.find(nav.source);
  return newest != newest_stamps_.end() && newest->second - nav.stamp > kBackwards;
}

bool ViewState::IsAnotherRun(const StatusReport& report) const {
  if (status_.number == 0) return false;
  const StatusReport& before = status_.value;
  return report.start_utime != before.start_utime ||
         report.counters.num_restarts > before.counters.num_restarts;
}

void ViewState::OnStatus(const StatusReport& report, std::int64_t recv_utime) {
  if (IsAnotherRun(report)) Clear();
  Count(ViewChannel::kStatus, recv_utime);
  status_.Set(report);
}

void ViewState::FinishScan() {
  if (!arriving_scan_.empty()) scan_.Set(std::exchange(arriving_scan_, {}));
}

void ViewState::OnCloud(const ScanChunk& chunk, std::int64_t recv_utime, bool is_full) {
  Count(is_full ? ViewChannel::kCloudFull : ViewChannel::kCloud, recv_utime);
  std::vector<Eigen::Vector3f> points;
  points.reserve(chunk.points.size());
  for (const LidarPoint& p : chunk.points) {
    const Eigen::Vector3f point(p.x_m, p.y_m, p.z_m);
    if (point.allFinite() && IsPlace(point.cast<double>())) points.push_back(point);
  }
  const double voxel_m = map_.voxel_m();
  map_.Add(points, Pose::Identity());
  if (map_.voxel_m() != voxel_m) ++map_generation_;
  // The thinned cloud is no scan of its own while all points come, too.
  if (is_full) last_full_utime_ = recv_utime;
  if (!is_full && std::abs(recv_utime - last_full_utime_) < kFullCloudHolds_us) return;
  if (chunk.scan_seq != arriving_seq_) FinishScan();
  arriving_seq_ = chunk.scan_seq;
  if (arriving_scan_.size() + points.size() <= limits_.max_scan_points) {
    arriving_scan_.insert(arriving_scan_.end(), points.begin(), points.end());
  }
  if (chunk.chunk_index + 1 >= chunk.chunk_count) FinishScan();
}

void ViewState::Clear() {
  map_.Clear();
  ++map_generation_;
  path_.Clear();
  states_.Clear();
  arriving_scan_.clear();
  scan_.Set({});
  pose_ = {.value = {}, .number = 0};
  newest_stamps_.clear();
  status_.value = {};
  status_.number = 0;
  for (RateMeter& rate : rates_) rate.Clear();
  last_full_utime_ = 0;
  ++num_runs_;
}

}  // namespace lio
