// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lcm_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lio/filter_state_t.hpp"
#include "lio/imu_t.hpp"
#include "lio/odometry_t.hpp"
#include "lio/registration_t.hpp"
#include "lio/scan_t.hpp"

namespace lio {
namespace {

constexpr Timestamp kMessageStamp{1'700'000'000'123'456'000};

ImuSample SampleImu() {
  return {kMessageStamp, Vector3(0.1, -0.2, 0.3), Vector3(1.0, 2.0, 9.8)};
}

ScanChunk SampleChunk(int num_points) {
  ScanChunk chunk{
      .stamp = kMessageStamp, .scan_seq = 7, .chunk_index = 2, .chunk_count = 9, .points = {}};
  for (int i = 0; i < num_points; ++i) {
    const auto x = static_cast<float>(i);
    chunk.points.push_back({x, -x, 0.5F * x, static_cast<std::uint32_t>(1000 * i), 600, 31});
  }
  return chunk;
}

template <typename Message>
Message Decoded(const Bytes& bytes) {
  Message message;
  EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  return message;
}

void Put32(std::int32_t value, std::size_t at, Bytes& bytes) {
  for (int i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

constexpr std::size_t kNumPointsAt = 36;  // the place of n_points in scan_t; n_bytes follows

TEST(LcmCodec, FingerprintsAreThoseOfTheGeneratedTypes) {
  EXPECT_EQ(kImuFingerprint, static_cast<std::uint64_t>(imu_t::getHash()));
  EXPECT_EQ(kScanFingerprint, static_cast<std::uint64_t>(scan_t::getHash()));
}

TEST(LcmCodec, ImuRoundTrips) {
  ImuSample sample;
  std::int32_t seq = 0;
  ASSERT_EQ(DecodeImu(EncodeImu(SampleImu(), 42), sample, seq), DecodeStatus::kOk);
  EXPECT_EQ(seq, 42);
  EXPECT_EQ(sample.stamp, kMessageStamp);
  EXPECT_EQ(sample.w_imu_radps, SampleImu().w_imu_radps);
  EXPECT_EQ(sample.f_imu_mps2, SampleImu().f_imu_mps2);
}

TEST(LcmCodec, OwnImuDecoderAgreesWithTheGeneratedOne) {
  const auto message = Decoded<imu_t>(EncodeImu(SampleImu(), -3));
  EXPECT_EQ(message.utime, kMessageStamp.Microseconds());
  EXPECT_EQ(message.seq, -3);
  EXPECT_EQ(message.gyro[1], -0.2);
  EXPECT_EQ(message.accel[2], 9.8);
  EXPECT_TRUE(std::isnan(message.temperature_c));
}

TEST(LcmCodec, ChunkRoundTrips) {
  ScanChunk chunk;
  ASSERT_EQ(DecodeChunk(EncodeChunk(SampleChunk(5)), chunk), DecodeStatus::kOk);
  EXPECT_EQ(chunk.stamp, kMessageStamp);
  EXPECT_EQ(chunk.scan_seq, 7);
  EXPECT_EQ(chunk.chunk_index, 2);
  EXPECT_EQ(chunk.chunk_count, 9);
  ASSERT_EQ(chunk.points.size(), 5u);
  EXPECT_EQ(chunk.points[3].x_m, 3.0F);
  EXPECT_EQ(chunk.points[3].y_m, -3.0F);
  EXPECT_EQ(chunk.points[3].z_m, 1.5F);
  EXPECT_EQ(chunk.points[3].t_offset_ns, 3000u);
  EXPECT_EQ(chunk.points[3].intensity, 600);
  EXPECT_EQ(chunk.points[3].ring, 31);
}

TEST(LcmCodec, OwnChunkDecoderAgreesWithTheGeneratedOne) {
  const auto message = Decoded<scan_t>(EncodeChunk(SampleChunk(kMaxChunkPoints)));
  EXPECT_EQ(message.utime, kMessageStamp.Microseconds());
  EXPECT_EQ(message.scan_seq, 7);
  EXPECT_EQ(message.n_points, kMaxChunkPoints);
  EXPECT_EQ(message.n_bytes, 20 * kMaxChunkPoints);
}

TEST(LcmCodec, AnEmptyChunkReplacesThePointsOfTheReusedOne) {
  ScanChunk chunk = SampleChunk(4);
  ASSERT_EQ(DecodeChunk(EncodeChunk(SampleChunk(0)), chunk), DecodeStatus::kOk);
  EXPECT_TRUE(chunk.points.empty());
}

TEST(LcmCodec, NanosecondsBelowTheStampsMicrosecondMoveIntoTheOffsets) {
  ScanChunk chunk = SampleChunk(2);
  chunk.stamp = kMessageStamp + Duration{789};
  chunk.points[1].t_offset_ns = std::numeric_limits<std::uint32_t>::max();
  ScanChunk decoded;
  ASSERT_EQ(DecodeChunk(EncodeChunk(chunk), decoded), DecodeStatus::kOk);
  EXPECT_EQ(decoded.stamp, kMessageStamp);
  EXPECT_EQ(decoded.points[0].t_offset_ns, 789u);
  EXPECT_EQ(decoded.points[1].t_offset_ns, std::numeric_limits<std::uint32_t>::max());
}

TEST(LcmCodec, EveryTruncationIsRefused) {
  const Bytes imu = EncodeImu(SampleImu(), 1);
  const Bytes scan = EncodeChunk(SampleChunk(3));
  ImuSample sample;
  std::int32_t seq = 0;
  ScanChunk chunk;
  for (std::size_t size = 0; size < imu.size(); ++size) {
    EXPECT_EQ(DecodeImu({imu.data(), size}, sample, seq), DecodeStatus::kTruncated) << size;
  }
  for (std::size_t size = 0; size < scan.size(); ++size) {
    const DecodeStatus status = DecodeChunk({scan.data(), size}, chunk);
    EXPECT_EQ(status, size < 44 ? DecodeStatus::kTruncated : DecodeStatus::kSizeMismatch) << size;
  }
}

TEST(LcmCodec, TrailingBytesAreRefused) {
  Bytes imu = EncodeImu(SampleImu(), 1);
  Bytes scan = EncodeChunk(SampleChunk(3));
  imu.push_back(0);
  scan.push_back(0);
  ImuSample sample;
  std::int32_t seq = 0;
  ScanChunk chunk;
  EXPECT_EQ(DecodeImu(imu, sample, seq), DecodeStatus::kSizeMismatch);
  EXPECT_EQ(DecodeChunk(scan, chunk), DecodeStatus::kSizeMismatch);
}

TEST(LcmCodec, OtherTypesAreRefused) {
  ImuSample sample;
  std::int32_t seq = 0;
  ScanChunk chunk;
  EXPECT_EQ(DecodeImu(EncodeChunk(SampleChunk(3)), sample, seq), DecodeStatus::kWrongType);
  EXPECT_EQ(DecodeChunk(EncodeImu(SampleImu(), 1), chunk), DecodeStatus::kWrongType);
}

TEST(LcmCodec, HugeAndNegativeCountsAreRefused) {
  const Bytes sound = EncodeChunk(SampleChunk(3));
  ScanChunk chunk;
  for (const std::int32_t count : {-1, 2, 4, 100'000'000, 0x7fffffff, 0x20000003, INT32_MIN}) {
    Bytes bytes = sound;
    Put32(count, kNumPointsAt, bytes);
    EXPECT_EQ(DecodeChunk(bytes, chunk), DecodeStatus::kSizeMismatch) << count;
    // Both counts are made to agree modulo 2^32.
    Put32(static_cast<std::int32_t>(20u * static_cast<std::uint32_t>(count)), kNumPointsAt + 4,
          bytes);
    EXPECT_EQ(DecodeChunk(bytes, chunk), DecodeStatus::kSizeMismatch) << count;
  }
}

TEST(LcmCodec, UnknownPointFormatsStepsAndStampsAreRefused) {
  const Bytes sound = EncodeChunk(SampleChunk(3));
  ScanChunk chunk;
  for (const std::size_t at : {33u, 35u, 8u, 9u}) {  // format, step, the stamp's top bytes
    Bytes bytes = sound;
    bytes[at] ^= 0x95;
    EXPECT_EQ(DecodeChunk(bytes, chunk), DecodeStatus::kBadFormat) << at;
  }
  Bytes imu = EncodeImu(SampleImu(), 1);
  imu[8] = 0x80;
  ImuSample sample;
  std::int32_t seq = 0;
  EXPECT_EQ(DecodeImu(imu, sample, seq), DecodeStatus::kBadFormat);
}

TEST(LcmCodec, MessagesAboveTheLimitAreRefusedUnread) {
  const Bytes bytes(kMaxMessageBytes + 1);
  ScanChunk chunk;
  EXPECT_EQ(DecodeChunk(bytes, chunk), DecodeStatus::kTooLarge);
  // liblcm reports this for a datagram without a terminated channel name.
  EXPECT_EQ(DecodeChunk({bytes.data(), 4294967286u}, chunk), DecodeStatus::kTooLarge);
}

TEST(LcmCodec, OdometryCarriesBothPosesAndTheirCovariancesRowByRow) {
  NavOutput nav;
  nav.stamp = kMessageStamp;
  nav.scan_seq = 12;
  nav.status = TrackingStatus::kCoasting;
  nav.source = OdometrySource::kImuPropagated;
  nav.T_world_imu = {Quaternion(0.5, 0.5, -0.5, 0.5), Vector3(1, 2, 3)};
  nav.T_map_imu = {Quaternion(0, 1, 0, 0), Vector3(4, 5, 6)};
  nav.pose_cov(1, 4) = 0.25;
  nav.map_pose_cov(5, 0) = 0.75;
  nav.velocity_cov(0, 2) = 0.5;
  const auto message = Decoded<odometry_t>(EncodeOdometry(nav));
  EXPECT_EQ(message.utime, kMessageStamp.Microseconds());
  EXPECT_EQ(message.scan_seq, 12);
  EXPECT_EQ(message.status, odometry_t::STATUS_COASTING);
  EXPECT_EQ(message.source, odometry_t::SOURCE_IMU_PROPAGATED);
  EXPECT_EQ(message.pos[2], 3.0);
  EXPECT_EQ(message.quat[2], -0.5);
  EXPECT_EQ(message.map_pos[0], 4.0);
  EXPECT_EQ(message.map_quat[1], 1.0);
  EXPECT_EQ(message.pose_cov[1][4], 0.25);
  EXPECT_EQ(message.map_pose_cov[5][0], 0.75);
  EXPECT_EQ(message.vel_cov[0][2], 0.5);
}

TEST(LcmCodec, LocalOdometryHasTheMapWhereElseIsTheWorld) {
  FilterReport report;
  NavOutput& nav = report.nav;
  nav.stamp = kMessageStamp;
  nav.T_world_imu.translation = Vector3(1, 2, 3);
  nav.T_map_imu = {Quaternion(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), Vector3(4, 5, 6)};
  nav.map_pose_cov.diagonal() << 0.25, 1.0, 2.0, 3.0, 4.0, 5.0;
  nav.v_world_imu_mps = Vector3(7, 8, 9);
  report.v_map_imu_mps = Vector3(10, 11, 12);
  report.map_velocity_cov(0, 2) = 0.5;
  const auto message = Decoded<odometry_t>(EncodeLocalOdometry(report));
  EXPECT_EQ(message.utime, kMessageStamp.Microseconds());
  EXPECT_EQ(message.pos[0], 4.0);
  EXPECT_EQ(message.map_pos[0], 4.0);
  EXPECT_EQ(message.quat[3], std::sqrt(0.5));
  EXPECT_EQ(message.vel[1], 11.0);
  EXPECT_EQ(message.vel_cov[0][2], 0.5);
  // After a quarter turn about z, forward in imu is left in map. The angular rate stays in imu.
  EXPECT_NEAR(message.pose_cov[0][0], 1.0, 1e-12);
  EXPECT_NEAR(message.pose_cov[1][1], 0.25, 1e-12);
  EXPECT_EQ(message.pose_cov[3][3], 3.0);
  EXPECT_EQ(message.map_pose_cov[0][0], 0.25);
}

TEST(LcmCodec, FilterStateCarriesTheFullCovariance) {
  FilterReport report;
  report.nav.stamp = kMessageStamp;
  report.gyro_bias_radps = Vector3(0.01, 0.02, 0.03);
  report.nis = 5.5;
  report.nis_dof = 6;
  report.cov = Eigen::MatrixXd::Zero(21, 21);
  report.cov(2, 20) = 7.0;
  const auto message = Decoded<filter_state_t>(EncodeFilterState(report));
  EXPECT_EQ(message.dim, 21);
  EXPECT_EQ(message.n_cov, 441);
  EXPECT_EQ(message.cov[2 * 21 + 20], 7.0);
  EXPECT_EQ(message.gyro_bias[2], 0.03);
  EXPECT_EQ(message.nis_dof, 6);
}

TEST(LcmCodec, RegistrationCarriesEigenvaluesAndStageTimes) {
  ScanReport report;
  report.stamp = kMessageStamp;
  report.scan_seq = 3;
  report.status = MatchStatus::kDegenerate;
  report.fused = true;
  report.degenerate_mask = 0b101;
  report.information_eigenvalues << 1, 2, 3, 4, 5, 6;
  report.stage_ns[static_cast<std::size_t>(Stage::kMatch)] = 1500;
  const auto message = Decoded<registration_t>(EncodeRegistration(report));
  EXPECT_EQ(message.status, registration_t::DEGENERATE);
  EXPECT_EQ(message.fused, 1);
  EXPECT_EQ(message.degenerate_mask, 5);
  EXPECT_EQ(message.eigenvalues[5], 6.0);
  EXPECT_EQ(message.match_us, 1.5F);
}

TEST(LcmCodec, CloudsAreScansOfTheRegisteredKind) {
  const RegisteredCloud cloud{
      kMessageStamp, 4, {Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)}};
  ScanChunk chunk;
  ASSERT_EQ(DecodeChunk(EncodeCloud(cloud), chunk), DecodeStatus::kOk);
  EXPECT_EQ(chunk.sensor_id, scan_t::SENSOR_REGISTERED);
  EXPECT_EQ(chunk.scan_seq, 4);
  ASSERT_EQ(chunk.points.size(), 2u);
  EXPECT_EQ(chunk.points[1].z_m, 6.0F);
}

TEST(LcmCodec, EveryStatusHasAName) {
  for (int i = 0; i < kNumDecodeStatuses; ++i) {
    EXPECT_NE(Name(static_cast<DecodeStatus>(i)), "unknown");
  }
}

}  // namespace
}  // namespace lio
