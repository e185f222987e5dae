// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator in a program of one's own: feeds samples and sweeps, prints a pose a sweep.
#include <cstdio>
#include <lio/pipeline/synchronous_odometry.hpp>

#include "../room/room.hpp"

void PrintPoses(lio::SynchronousOdometry& odometry) {
  for (const lio::Output& output : odometry.TakeOutputs()) {
    const auto* scan = std::get_if<lio::ScanOutput>(&output);
    if (scan == nullptr || !scan->filter) continue;
    const lio::Vector3& p = scan->filter->nav.T_world_imu.translation;
    const double t_s = (scan->filter->nav.stamp - room::StampAt(0.0)).Seconds();
    std::printf("%.3f s: x %.3f y %.3f z %.3f m (true x %.3f)\n", t_s, p.x(), p.y(), p.z(),
                room::TrueX(t_s));
  }
}

int main() {
  lio::Options options;
  options.rig.T_imu_lidar = lio::Pose{lio::Quaternion::Identity(), room::kLidarInImu};
  lio::SynchronousOdometry odometry(options);
  const int samples_per_sweep = 20;
  for (int i = 0; i * 0.005 < room::kDuration_s; ++i) {
    odometry.AddImu(room::ImuAt(i * 0.005));
    if ((i + 1) % samples_per_sweep != 0) continue;
    odometry.AddSweep(room::SweepAt((i + 1 - samples_per_sweep) * 0.005));
    PrintPoses(odometry);
  }
  odometry.Flush();
  PrintPoses(odometry);
}
