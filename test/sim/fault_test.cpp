// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lio::sim {
namespace {

constexpr Timestamp kBegin{1'000'000'000'000};
constexpr int kNumImu = 2000;   // 20 s at 100 Hz
constexpr int kNumScans = 200;  // each has 4 chunks of 100 points
constexpr int kNumChunks = 4;
constexpr int kNumPoints = 100;

Message ImuAt(int k) {
  ImuMessage imu;
  imu.sample.stamp = kBegin + Duration{10'000'000ll * k};
  imu.sample.w_imu_radps = {0.5, -0.5, 0.1};
  imu.sample.f_imu_mps2 = {0.0, 0.0, 9.8};
  imu.seq = k;
  return {imu.sample.stamp + Duration{300'000}, imu};
}

Message ChunkAt(int scan, int index) {
  ScanChunk chunk;
  chunk.stamp = kBegin + Duration{100'000'000ll * scan + 25'000'000ll * index};
  chunk.scan_seq = scan;
  chunk.chunk_index = static_cast<std::int16_t>(index);
  chunk.chunk_count = kNumChunks;
  chunk.points.resize(kNumPoints, LidarPoint{1.0f, 2.0f, 3.0f, 0, 0, 0});
  return {chunk.stamp + Duration{25'000'000}, chunk};
}

// Holds a log of 20 s after a fault, in the order of arrival.
struct Outcome {
  std::vector<ImuMessage> imu;
  std::vector<ScanChunk> chunks;

  explicit Outcome(const std::string& fault) {
    const FaultInjector injector({ParseFault(fault)}, 9, kBegin);
    ArrivalQueue queue;
    const auto push = [&](Message message) {
      for (Message& m : injector.Apply(std::move(message))) queue.Push(std::move(m));
    };
    for (int k = 0; k < kNumImu; ++k) push(ImuAt(k));
    for (int s = 0; s < kNumScans; ++s) {
      for (int i = 0; i < kNumChunks; ++i) push(ChunkAt(s, i));
    }
    while (auto message = queue.PopBefore({INT64_MAX})) {
      if (auto* sample = std::get_if<ImuMessage>(&message->body)) {
        imu.push_back(*sample);
      } else {
        chunks.push_back(std::get<ScanChunk>(message->body));
      }
    }
  }
  bool ImuIsWhole() const {
    bool whole = imu.size() == kNumImu;
    for (int k = 0; whole && k < kNumImu; ++k) {
      const auto& at = imu[static_cast<std::size_t>(k)];
      whole = at.seq == k && at.sample.stamp == kBegin + Duration{10'000'000ll * k} &&
              at.sample.w_imu_radps == Vector3(0.5, -0.5, 0.1);
    }
    return whole;
  }
  bool LidarIsWhole() const {
    bool whole = chunks.size() == kNumScans * kNumChunks;
    for (std::size_t i = 0; whole && i < chunks.size(); ++i) {
      whole = chunks[i].scan_seq == static_cast<int>(i) / kNumChunks &&
              chunks[i].chunk_index == static_cast<int>(i) % kNumChunks &&
              chunks[i].points.size() == kNumPoints &&
              chunks[i].stamp == kBegin + Duration{25'000'000ll * static_cast<std::int64_t>(i)};
    }
    return whole;
  }
};

double Seconds(Timestamp stamp) {
  return SecondsBetween(kBegin, stamp);
}

TEST(Fault, ImuGapLeavesAHoleOfItsLengthAndNothingElse) {
  const Outcome out("imu_gap:start=5,duration=0.6");
  EXPECT_EQ(out.imu.size(), kNumImu - 60u);
  for (const auto& imu : out.imu) {
    const double t = Seconds(imu.sample.stamp) + 3e-4;
    EXPECT_FALSE(t >= 5.0 && t < 5.6);
  }
  EXPECT_TRUE(out.LidarIsWhole());
}

TEST(Fault, LidarGapLeavesAHoleOfItsLengthAndNothingElse) {
  const Outcome out("lidar_gap:start=5,duration=1");
  EXPECT_EQ(out.chunks.size(), kNumScans * kNumChunks - 40u);
  EXPECT_TRUE(out.ImuIsWhole());
}

TEST(Fault, DropLosesItsShareAndWholeScans) {
  const Outcome out("drop:ratio=0.1");
  EXPECT_NEAR(static_cast<double>(out.imu.size()), 0.9 * kNumImu, 40.0);
  EXPECT_EQ(out.chunks.size() % kNumChunks, 0u);
  EXPECT_NEAR(static_cast<double>(out.chunks.size()) / kNumChunks, 0.9 * kNumScans, 13.0);
  EXPECT_TRUE(Outcome("drop:ratio=0.1,channel=lidar").ImuIsWhole());
  EXPECT_TRUE(Outcome("drop:ratio=0.1,channel=imu").LidarIsWhole());
}

TEST(Fault, DuplicateSendsSomeTwiceUnchanged) {
  const Outcome out("duplicate:ratio=0.1,channel=imu");
  EXPECT_NEAR(static_cast<double>(out.imu.size()), 1.1 * kNumImu, 40.0);
  std::vector<int> times(kNumImu, 0);
  for (const auto& imu : out.imu) ++times[static_cast<std::size_t>(imu.seq)];
  EXPECT_EQ(*std::min_element(times.begin(), times.end()), 1);
  EXPECT_EQ(*std::max_element(times.begin(), times.end()), 2);
  EXPECT_TRUE(out.LidarIsWhole());
}

TEST(Fault, ReorderDelaysSomePastNewerOnes) {
  const Outcome out("reorder:ratio=0.1,delay=0.035,channel=imu");
  ASSERT_EQ(out.imu.size(), kNumImu);
  int num_back = 0;
  for (std::size_t i = 1; i < out.imu.size(); ++i) num_back += out.imu[i].seq < out.imu[i - 1].seq;
  EXPECT_GT(num_back, 100);
  EXPECT_LT(num_back, 250);
}

TEST(Fault, ChunkLossLosesSingleChunks) {
  const Outcome out("chunk_loss:ratio=0.1");
  EXPECT_NEAR(static_cast<double>(out.chunks.size()), 0.9 * kNumScans * kNumChunks, 26.0);
  std::vector<int> parts(kNumScans, 0);
  for (const auto& chunk : out.chunks) ++parts[static_cast<std::size_t>(chunk.scan_seq)];
  EXPECT_GT(std::count(parts.begin(), parts.end(), 3),
            20);  // scans that lost a part of their chunks
  EXPECT_TRUE(out.ImuIsWhole());
}

TEST(Fault, StampJumpMovesStampsForwardOrBackInItsWindowOnly) {
  for (const double offset : {1.5, -1.5}) {
    const Outcome out("stamp_jump:start=8,duration=0.5,channel=imu,offset=" +
                      std::to_string(offset));
    ASSERT_EQ(out.imu.size(), kNumImu);
    int num_moved = 0;
    for (int k = 0; k < kNumImu; ++k) {
      const auto& at = out.imu[static_cast<std::size_t>(k)];
      EXPECT_EQ(at.seq, k);
      const double moved = Seconds(at.sample.stamp) - 0.01 * k;
      if (std::abs(moved) > 1e-6) {
        EXPECT_NEAR(moved, offset, 1e-6);
        ++num_moved;
      }
    }
    EXPECT_EQ(num_moved, 50);
    EXPECT_TRUE(out.LidarIsWhole());
  }
}

TEST(Fault, ClockOffsetIsConstantThroughout) {
  const Outcome out("clock_offset:offset=-0.03");
  EXPECT_TRUE(out.ImuIsWhole());
  for (std::size_t i = 0; i < out.chunks.size(); ++i) {
    EXPECT_NEAR(Seconds(out.chunks[i].stamp), 0.025 * static_cast<double>(i) - 0.03, 1e-9);
  }
}

TEST(Fault, ShakingAddsNoiseOfItsSizeFromItsStart) {
  const Outcome out("shaking:start=5,accel=0.5,gyro=0.01");
  const Outcome still("shaking:accel=0,gyro=0");
  double accel_sq = 0.0;
  double gyro_sq = 0.0;
  int num = 0;
  for (std::size_t k = 0; k < out.imu.size(); ++k) {
    const ImuSample& shaken = out.imu[k].sample;
    const Vector3 accel = shaken.f_imu_mps2 - still.imu[k].sample.f_imu_mps2;
    const Vector3 gyro = shaken.w_imu_radps - still.imu[k].sample.w_imu_radps;
    if (k < 500) {
      EXPECT_EQ(accel.norm() + gyro.norm(), 0.0);
      continue;
    }
    accel_sq += accel.squaredNorm();
    gyro_sq += gyro.squaredNorm();
    num += 3;
  }
  EXPECT_NEAR(std::sqrt(accel_sq / num), 0.5, 0.02);
  EXPECT_NEAR(std::sqrt(gyro_sq / num), 0.01, 4e-4);
  EXPECT_TRUE(out.LidarIsWhole());
}

TEST(Fault, DeadSensorsReadZero) {
  const Outcome gyro("imu_dead:start=5,duration=2");
  const Outcome accelerometer("imu_dead:start=5,duration=2,gyro=0,accel=1");
  const Outcome still("shaking:accel=0,gyro=0");
  for (std::size_t k = 0; k < still.imu.size(); ++k) {
    const bool is_dead = k >= 500 && k < 700;
    const ImuSample& sound = still.imu[k].sample;
    const Vector3 zero = Vector3::Zero();
    EXPECT_EQ(gyro.imu[k].sample.w_imu_radps, is_dead ? zero : sound.w_imu_radps);
    EXPECT_EQ(gyro.imu[k].sample.f_imu_mps2, sound.f_imu_mps2);
    EXPECT_EQ(accelerometer.imu[k].sample.w_imu_radps, sound.w_imu_radps);
    EXPECT_EQ(accelerometer.imu[k].sample.f_imu_mps2, is_dead ? zero : sound.f_imu_mps2);
  }
}

TEST(Fault, OffsetsAreAddedFromTheirStart) {
  const Outcome out("imu_offset:start=5,gyro=0.1,accel=-2");
  const Outcome still("shaking:accel=0,gyro=0");
  for (std::size_t k = 0; k < out.imu.size(); ++k) {
    const double share = k < 500 ? 0.0 : 1.0;
    const ImuSample& sound = still.imu[k].sample;
    const ImuSample& off = out.imu[k].sample;
    EXPECT_NEAR((off.w_imu_radps - sound.w_imu_radps - share * Vector3(0, 0, 0.1)).norm(), 0,
                1e-12);
    EXPECT_NEAR((off.f_imu_mps2 - sound.f_imu_mps2 - share * Vector3(-2, 0, 0)).norm(), 0, 1e-12);
  }
}

TEST(Fault, NanHitsSamplesAndPoints) {
  const Outcome out("nan:ratio=0.05");
  const auto num_imu = std::count_if(out.imu.begin(), out.imu.end(), [](const auto& imu) {
    return !imu.sample.w_imu_radps.allFinite() && !imu.sample.f_imu_mps2.allFinite();
  });
  EXPECT_NEAR(static_cast<double>(num_imu), 0.05 * kNumImu, 30.0);
  std::int64_t num_points = 0;
  for (const auto& chunk : out.chunks) {
    for (const LidarPoint& p : chunk.points) num_points += std::isnan(p.x_m) ? 1 : 0;
  }
  const double all = kNumScans * kNumChunks * kNumPoints;
  EXPECT_NEAR(static_cast<double>(num_points) / all, 0.05, 0.004);
}

TEST(Fault, GyroSaturationClipsRates) {
  const Outcome out("gyro_saturation:limit=0.2,start=4,duration=2");
  int num_clipped = 0;
  for (const auto& imu : out.imu) {
    num_clipped += imu.sample.w_imu_radps == Vector3(0.2, -0.2, 0.1) ? 1 : 0;
  }
  EXPECT_EQ(num_clipped, 200);
}

TEST(Fault, EmptyAndSparseScansAreOneChunkOfFewPoints) {
  for (const auto& [fault, num] : {std::pair{"empty_scan:start=5,duration=1", 0u},
                                   std::pair{"sparse_scan:start=5,duration=1,points=20", 20u}}) {
    const Outcome out(fault);
    int num_thin = 0;
    for (const auto& chunk : out.chunks) {
      if (chunk.points.size() == num) {
        EXPECT_EQ(chunk.chunk_count, 1) << fault;
        ++num_thin;
      }
    }
    EXPECT_EQ(num_thin, 10) << fault;
    EXPECT_EQ(out.chunks.size(), kNumScans * kNumChunks - 30u) << fault;
    EXPECT_TRUE(out.ImuIsWhole());
  }
}

TEST(Fault, DustAndExtrinsicAreForOthersToApply) {
  const std::vector<Fault> faults = {ParseFault("dust:start=3,duration=2,density=0.4"),
                                     ParseFault("wrong_extrinsic:yaw_deg=90,x=0.5")};
  const auto dust = DustOf(faults, 100.0);
  ASSERT_EQ(dust.size(), 1u);
  EXPECT_EQ(dust[0].begin_s, 103.0);
  EXPECT_EQ(dust[0].end_s, 105.0);
  EXPECT_EQ(dust[0].echoes_per_m, 0.4);
  const Pose claimed = ClaimedExtrinsic(faults, {Quaternion::Identity(), {1.0, 2.0, 3.0}});
  EXPECT_LT((claimed.translation - Vector3(1.5, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((claimed.rotation * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-12);
}

TEST(Fault, ThoseDrawnByRatioKeepToTheirWindowToo) {
  for (const char* kind : {"drop", "duplicate", "reorder", "chunk_loss", "nan"}) {
    const Outcome whole(std::string(kind) + ":ratio=0.5,start=0,duration=1e-6");
    EXPECT_TRUE(whole.ImuIsWhole() && whole.LidarIsWhole()) << kind;
    const Outcome out(std::string(kind) + ":ratio=0.5,start=5,duration=1");
    std::vector<std::int64_t> outside_ns;
    for (const auto& chunk : out.chunks) {
      const double t = Seconds(chunk.stamp);
      if (t < 4.8 || t > 6.2) outside_ns.push_back(chunk.stamp.ns);
      const bool is_sound = !std::isnan(chunk.points[0].x_m);
      EXPECT_TRUE(is_sound || (t > 4.8 && t < 6.2)) << kind << " at " << t;
    }
    EXPECT_EQ(outside_ns.size(), 800u - 57u) << kind;
  }
}

TEST(Fault, SeveralFaultsAddUp) {
  const FaultInjector injector(
      {ParseFault("imu_gap:start=1,duration=1"), ParseFault("clock_offset:channel=imu,offset=0.5")},
      1, kBegin);
  EXPECT_TRUE(injector.Apply(ImuAt(150)).empty());
  const auto after = injector.Apply(ImuAt(300));
  ASSERT_EQ(after.size(), 1u);
  EXPECT_NEAR(Seconds(std::get<ImuMessage>(after[0].body).sample.stamp), 3.5, 1e-9);
}

}  // namespace
}  // namespace lio::sim
