// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/deskew.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scan/scan_parameters.hpp"

namespace lio {
namespace {

constexpr double kGridStep_s = kScanParameters.deskew.grid_step_s;

using Transform = Eigen::Matrix<float, 3, 4>;

// Returns the pose at `stamp`, constant beyond both ends. The search starts at `from`, which
// becomes the segment found, so that ascending calls are linear in total.
Pose PoseAt(const StampedPoses& poses, Timestamp stamp, std::size_t& from) {
  while (from + 1 < poses.size() && poses[from + 1].stamp < stamp) ++from;
  if (from + 1 == poses.size() || stamp <= poses[from].stamp) return poses[from].pose;
  const StampedPose& a = poses[from];
  const StampedPose& b = poses[from + 1];
  return Interpolate(a.pose, b.pose,
                     SecondsBetween(a.stamp, stamp) / SecondsBetween(a.stamp, b.stamp));
}

Transform ToTransform(const Pose& pose) {
  Transform transform;
  transform << pose.rotation.toRotationMatrix().cast<float>(), pose.translation.cast<float>();
  return transform;
}

}  // namespace

std::vector<Eigen::Vector3f> Deskew(const std::vector<ScanPoint>& points_lidar,
                                    const SweepTimes& times, const StampedPoses& T_any_imu,
                                    const Pose& T_imu_lidar) {
  if (T_any_imu.empty()) throw std::invalid_argument("Deskew: no poses to deskew with");
  const double span_s = std::max(SecondsBetween(times.start, times.end), kGridStep_s);
  const auto num_steps = static_cast<std::size_t>(std::ceil(span_s / kGridStep_s));
  const double step_s = span_s / static_cast<double>(num_steps);

  std::size_t from = T_any_imu.size() - 1;
  while (from > 0 && T_any_imu[from].stamp > times.reference) --from;
  const Pose T_reference_any = PoseAt(T_any_imu, times.reference, from).Inverse();
  std::vector<Transform> grid(num_steps + 1);  // T_reference_lidar at each instant
  from = 0;
  for (std::size_t i = 0; i <= num_steps; ++i) {
    const Timestamp stamp = times.start + Duration::FromSeconds(step_s * static_cast<double>(i));
    grid[i] = ToTransform(T_reference_any * PoseAt(T_any_imu, stamp, from) * T_imu_lidar);
  }

  std::vector<Eigen::Vector3f> points_imu(points_lidar.size());
  const auto steps_per_ns = static_cast<float>(1e-9 / step_s);
  for (std::size_t i = 0; i < points_lidar.size(); ++i) {
    const ScanPoint& point = points_lidar[i];
    const float at = static_cast<float>(point.t_offset_ns) * steps_per_ns;
    const std::size_t cell = std::min(static_cast<std::size_t>(at), num_steps - 1);
    const float fraction = std::min(at - static_cast<float>(cell), 1.0f);
    const Transform blend = (1.0f - fraction) * grid[cell] + fraction * grid[cell + 1];
    points_imu[i] = blend.leftCols<3>() * point.position + blend.col(3);
  }
  return points_imu;
}

}  // namespace lio
