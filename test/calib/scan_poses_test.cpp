// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/scan_poses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/motion.hpp"
#include "support/ray_scene.hpp"

namespace lio {
namespace {

constexpr int kNumSweeps = 12;

// The lidar rests for the first sweeps, then sways and turns while it is carried along.
Pose Carry(double t_s) {
  const double along_m = 0.6 * std::max(0.0, t_s - 0.4);
  return {ExpSo3(Vector3(0.03 * std::sin(9.0 * t_s), 0.02 * std::sin(11.0 * t_s), 0.3 * t_s)),
          Vector3(along_m, 0.0, 1.5 + 0.02 * std::sin(12.0 * t_s))};
}

test::RayScene Yard() {
  test::RayScene scene;
  scene.AddGround(0.0);
  scene.Add(test::RayBox{{14, 2, 3}, {1, 12, 3}, 0.2});
  scene.Add(test::RayBox{{-12, 0, 3}, {1, 14, 3}, -0.1});
  scene.Add(test::RayBox{{0, 13, 3}, {12, 1, 3}, 0.05});
  scene.Add(test::RayBox{{2, -11, 3}, {13, 1, 3}, -0.15});
  scene.Add(test::RayBox{{5, 5, 1}, {1, 2, 1}, 0.6});
  scene.Add(test::RayBox{{-6, -4, 1}, {2, 1, 1}, 0.3});
  return scene;
}

std::vector<ScanChunk> Sweeps() {
  test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
  lidar.num_columns = 240;
  const test::RayScene scene = Yard();
  std::vector<ScanChunk> chunks;
  for (int k = 0; k < kNumSweeps; ++k) {
    ScanChunk chunk;
    chunk.stamp = test::StampAt(0.1 * k);
    chunk.scan_seq = k;
    chunk.points = test::CastTurn(scene, lidar, [k](double share) {
                     return Carry(0.1 * (k + share));
                   }).sweep.points;
    chunks.push_back(std::move(chunk));
  }
  return chunks;
}

Options NoImu() {
  Options options;
  options.pipeline.use_imu = false;
  return options;
}

StampedPoses Find(const std::vector<ScanChunk>& chunks, const SweepPath* path) {
  ScanPoses poses(NoImu(), path);
  for (const ScanChunk& chunk : chunks) poses.Add(chunk);
  poses.Finish();
  return poses.found();
}

// Returns the largest error of the turns between sweeps.
double TurnError(const StampedPoses& found) {
  double largest = 0.0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Pose a = Carry(test::SecondsOf(found[i - 1].stamp));
    const Pose b = Carry(test::SecondsOf(found[i].stamp));
    const Quaternion turn = found[i - 1].pose.rotation.conjugate() * found[i].pose.rotation;
    const Quaternion truth = a.rotation.conjugate() * b.rotation;
    largest = std::max(largest, LogSo3(truth.conjugate() * turn).norm());
  }
  return largest;
}

TEST(ScanPoses, SweepsAreFoundAtTheirMiddlesAndBetterAlongAKnownPath) {
  const std::vector<ScanChunk> chunks = Sweeps();
  const StampedPoses first = Find(chunks, nullptr);
  ASSERT_EQ(first.size(), static_cast<std::size_t>(kNumSweeps));
  EXPECT_NEAR(test::SecondsOf(first[3].stamp), 0.35, 1e-3);
  EXPECT_LT(TurnError(first), 0.01);

  const SweepPath path(first, test::ExactSamples(Carry, -0.05, 1.3, 0.01));
  const StampedPoses second = Find(chunks, &path);
  ASSERT_EQ(second.size(), first.size());
  EXPECT_LT(TurnError(second), TurnError(first));
  EXPECT_LT(TurnError(second), 0.004);
}

TEST(ScanPoses, EmptyAndRepeatedSweepsAreLeftOut) {
  std::vector<ScanChunk> chunks = Sweeps();
  chunks.resize(4);
  chunks[2].points.clear();
  const StampedPoses found = Find(chunks, nullptr);
  EXPECT_EQ(found.size(), 3u);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GT(found[i].stamp, found[i - 1].stamp);
}

}  // namespace
}  // namespace lio
