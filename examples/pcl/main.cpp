// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator fed with clouds of PCL, of a point type of one's own: prints a pose a sweep and
// keeps the map as a cloud again.
#include <pcl/register_point_struct.h>

#include <cstdio>
#include <lio/pcl_conversions.hpp>
#include <lio/pipeline/synchronous_odometry.hpp>

#include "../room/room.hpp"

struct PointXYZIRT {
  PCL_ADD_POINT4D
  PCL_ADD_INTENSITY
  std::uint16_t ring;
  float time;  // seconds after the cloud's stamp
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(PointXYZIRT,
  (float, x, x)(float, y, y)(float, z, z)(float, intensity, intensity)
  (std::uint16_t, ring, ring)(float, time, time))
// clang-format on

// Makes the cloud that a driver would give.
pcl::PointCloud<PointXYZIRT> CloudAt(double begin_s) {
  const lio::LidarSweep sweep = room::SweepAt(begin_s);
  pcl::PointCloud<PointXYZIRT> cloud;
  cloud.header.stamp = static_cast<std::uint64_t>(sweep.stamp.Microseconds());
  for (const lio::LidarPoint& p : sweep.points) {
    PointXYZIRT point;
    point.getVector4fMap() = Eigen::Vector4f(p.x_m, p.y_m, p.z_m, 1.0f);
    point.intensity = 100.0f;
    point.ring = p.ring;
    point.time = static_cast<float>(p.t_offset_ns) * 1e-9f;
    cloud.push_back(point);
  }
  return cloud;
}

int main() {
  lio::Options options;
  options.rig.T_imu_lidar = lio::Pose{lio::Quaternion::Identity(), room::kLidarInImu};
  lio::SynchronousOdometry odometry(options);
  odometry.KeepMapClouds(true);
  pcl::PointCloud<pcl::PointXYZ> map;
  const int samples_per_sweep = 20;
  for (int i = 0; i * 0.005 < room::kDuration_s; ++i) {
    odometry.AddImu(room::ImuAt(i * 0.005));
    if ((i + 1) % samples_per_sweep != 0) continue;
    const auto cloud = CloudAt((i + 1 - samples_per_sweep) * 0.005);
    odometry.AddSweep(lio::SweepFromPcl(cloud, lio::StampFromPcl(cloud.header)));
    for (const lio::Output& output : odometry.TakeOutputs()) {
      const auto* scan = std::get_if<lio::ScanOutput>(&output);
      if (scan == nullptr || !scan->filter) continue;
      const double t_s = (scan->filter->nav.stamp - room::StampAt(0.0)).Seconds();
      const Eigen::Affine3d T_world_imu = lio::AffineFromPose(scan->filter->nav.T_world_imu);
      std::printf("%.3f s: x %.3f y %.3f z %.3f m (true x %.3f)\n", t_s,
                  T_world_imu.translation().x(), T_world_imu.translation().y(),
                  T_world_imu.translation().z(), room::TrueX(t_s));
    }
    for (const auto& points : odometry.TakeMapClouds()) map += lio::CloudToPcl(points);
  }
  std::printf("map of %zu points\n", map.size());
}
