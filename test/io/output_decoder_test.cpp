// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lio/base/counters_fields.hpp"

namespace lio {
namespace {

NavOutput SomeNav() {
  NavOutput nav;
  nav.stamp = Timestamp::FromMicroseconds(1'700'000'000'123'456);
  nav.scan_seq = 42;
  nav.status = TrackingStatus::kDegenerate;
  nav.source = OdometrySource::kImuPropagated;
  nav.T_world_imu = ExpSe3((Vector6() << 1, 2, 3, 0.1, 0.2, 0.3).finished());
  nav.v_world_imu_mps = {4, 5, 6};
  nav.w_imu_radps = {7, 8, 9};
  nav.pose_cov = Matrix6::Random();
  nav.velocity_cov = Matrix3::Random();
  nav.T_map_imu = ExpSe3((Vector6() << 3, 2, 1, 0.3, 0.2, 0.1).finished());
  nav.map_pose_cov = Matrix6::Random();
  return nav;
}

FilterReport SomeFilter() {
  FilterReport report;
  report.nav = SomeNav();
  report.gyro_bias_radps = {0.1, 0.2, 0.3};
  report.accel_bias_mps2 = {0.4, 0.5, 0.6};
  report.g_world_mps2 = {0, 0, -9.81};
  report.clock_offset_s = 0.01;
  report.clock_offset_std_s = 0.001;
  report.nis = 5.5;
  report.nis_dof = 6;
  report.cov = Eigen::MatrixXd::Random(21, 21);
  return report;
}

ScanReport SomeScan() {
  ScanReport report;
  report.stamp = Timestamp::FromMicroseconds(17);
  report.scan_seq = 3;
  report.num_raw = 100;
  report.num_used = 90;
  report.num_matched = 80;
  report.iterations = 4;
  report.status = MatchStatus::kDegenerate;
  report.fused = true;
  report.residual_rms_m = 0.05;
  report.information_eigenvalues << 1, 2, 3, 4, 5, 6;
  report.degenerate_mask = 5;
  report.nis = 6.5;
  report.stage_ns = {1000, 2000, 3000, 4000, 5000, 6000, 7000};
  return report;
}

StatusReport SomeStatus() {
  StatusReport report;
  report.utime = 1'700'000'000'000'001;
  report.start_utime = 1'700'000'000'000'000;
  report.newest_stamp = Timestamp::FromMicroseconds(5);
  report.seq = 7;
  report.state = TrackingStatus::kCoasting;
  std::int64_t value = 100;
  for (const CounterField& field : kCounterFields) report.counters.*field.count = ++value;
  report.input.num_refused = {0, 1, 2, 3, 4, 5};
  report.input.num_imu_missing = 6;
  report.num_kernel_dropped = -1;
  report.num_handler_faults = 9;
  report.receive_buffer_bytes = 8 << 20;
  report.latency = {1.5F, 2.5F, 3.5F};
  report.cpu_load_cores = 0.25F;
  report.map_mb = 12.0F;
  report.imu_noise.gyro = 2.0;
  report.clock_offset = {.offset_s = 0.025, .std_s = 0.0004};
  report.trust = Trust::kDoubtful;
  report.config_hash = 0x8000000000000001;
  report.note = "started at rest";
  report.options = "pipeline: {}";
  for (AccountPage& page : report.account) {
    for (AccountEntry& entry : page.entries) entry.count = ++value;
  }
  return report;
}

DecodeStatus Odometry(ByteView bytes) {
  NavOutput nav;
  return DecodeOdometry(bytes, nav);
}
DecodeStatus Filter(ByteView bytes) {
  FilterReport report;
  return DecodeFilterState(bytes, report);
}
DecodeStatus Registration(ByteView bytes) {
  ScanReport report;
  return DecodeRegistration(bytes, report);
}
DecodeStatus Status(ByteView bytes) {
  StatusReport report;
  return DecodeStatusReport(bytes, report);
}

struct Type {
  DecodeStatus (*decode)(ByteView);
  Bytes message;
};
std::vector<Type> AllTypes() {
  return {{Odometry, EncodeOdometry(SomeNav())},
          {Filter, EncodeFilterState(SomeFilter())},
          {Registration, EncodeRegistration(SomeScan())},
          {Status, EncodeStatus(SomeStatus(), "1.2.3")}};
}

TEST(OutputDecoder, OdometryComesBack) {
  const NavOutput sent = SomeNav();
  NavOutput got;
  ASSERT_EQ(DecodeOdometry(EncodeOdometry(sent), got), DecodeStatus::kOk);
  EXPECT_EQ(EncodeOdometry(got), EncodeOdometry(sent));
  EXPECT_EQ(got.stamp, sent.stamp);
  EXPECT_EQ(got.status, sent.status);
  EXPECT_EQ(got.map_pose_cov, sent.map_pose_cov);
}

TEST(OutputDecoder, FilterStateComesBack) {
  const FilterReport sent = SomeFilter();
  FilterReport got;
  ASSERT_EQ(DecodeFilterState(EncodeFilterState(sent), got), DecodeStatus::kOk);
  EXPECT_EQ(EncodeFilterState(got), EncodeFilterState(sent));
  EXPECT_EQ(got.cov, sent.cov);
  EXPECT_EQ(got.accel_bias_mps2, sent.accel_bias_mps2);
}

TEST(OutputDecoder, RegistrationComesBack) {
  const ScanReport sent = SomeScan();
  ScanReport got;
  ASSERT_EQ(DecodeRegistration(EncodeRegistration(sent), got), DecodeStatus::kOk);
  EXPECT_EQ(EncodeRegistration(got), EncodeRegistration(sent));
  EXPECT_EQ(got.stage_ns, sent.stage_ns);
}

TEST(OutputDecoder, StatusComesBack) {
  const StatusReport sent = SomeStatus();
  StatusReport got;
  ASSERT_EQ(DecodeStatusReport(EncodeStatus(sent, "1.2.3"), got), DecodeStatus::kOk);
  EXPECT_EQ(EncodeStatus(got, "1.2.3"), EncodeStatus(sent, "1.2.3"));
  EXPECT_EQ(got.note, sent.note);
  EXPECT_EQ(got.options, sent.options);
  EXPECT_EQ(got.latency.p99_ms, sent.latency.p99_ms);
  EXPECT_EQ(got.clock_offset.offset_s, sent.clock_offset.offset_s);
  EXPECT_EQ(got.clock_offset.std_s, sent.clock_offset.std_s);
}

// The lengths of the texts are a sender's claim.
TEST(OutputDecoder, HostileTextsOfAStatusAreRefused) {
  StatusReport status = SomeStatus();
  const Bytes sound = EncodeStatus(status, "1.2.3");
  const std::size_t options_at = sound.size() - status.options.size() - 5;  // length and NUL, too
  const std::size_t note_at = options_at - status.note.size() - 5;
  for (const std::size_t at : {note_at, options_at}) {
    for (const int byte : {0x00, 0x7f, 0xff}) {
      Bytes claims = sound;
      std::fill_n(claims.begin() + static_cast<std::ptrdiff_t>(at), 4,
                  static_cast<std::uint8_t>(byte));
      EXPECT_EQ(Status(claims), DecodeStatus::kSizeMismatch) << at << " " << byte;
    }
  }
  status.options.assign(kMaxStatusText, 'x');
  EXPECT_EQ(Status(EncodeStatus(status, "1.2.3")), DecodeStatus::kOk);
  status.options += 'x';
  EXPECT_EQ(Status(EncodeStatus(status, "1.2.3")), DecodeStatus::kBadFormat);
  status.options.clear();
  status.note.assign(kMaxStatusText + 1, 'x');
  EXPECT_EQ(Status(EncodeStatus(status, "1.2.3")), DecodeStatus::kBadFormat);
}

TEST(OutputDecoder, EveryTruncationAndEveryTrailingByteIsRefused) {
  for (const Type& type : AllTypes()) {
    ASSERT_EQ(type.decode(type.message), DecodeStatus::kOk);
    for (std::size_t size = 0; size < type.message.size(); ++size) {
      EXPECT_NE(type.decode(ByteView(type.message).first(size)), DecodeStatus::kOk) << size;
    }
    Bytes longer = type.message;
    longer.push_back(0);
    EXPECT_EQ(type.decode(longer), DecodeStatus::kSizeMismatch);
  }
}

TEST(OutputDecoder, AnotherTypeIsRefused) {
  const std::vector<Type> types = AllTypes();
  for (std::size_t i = 0; i < types.size(); ++i) {
    EXPECT_EQ(types[i].decode(types[(i + 1) % types.size()].message), DecodeStatus::kWrongType);
  }
}

TEST(OutputDecoder, NumbersThatAreNoneAreRefused) {
  NavOutput nav = SomeNav();
  nav.pose_cov(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Odometry(EncodeOdometry(nav)), DecodeStatus::kBadFormat);
  FilterReport filter = SomeFilter();
  filter.nis = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Filter(EncodeFilterState(filter)), DecodeStatus::kBadFormat);
  StatusReport status = SomeStatus();
  status.latency.max_ms = std::nanf("");
  EXPECT_EQ(Status(EncodeStatus(status, "1.2.3")), DecodeStatus::kBadFormat);
}

TEST(OutputDecoder, AQuaternionThatIsNoRotationIsRefused) {
  NavOutput nav = SomeNav();
  nav.T_map_imu.rotation.coeffs() *= 1.1;
  EXPECT_EQ(Odometry(EncodeOdometry(nav)), DecodeStatus::kBadFormat);
  nav.T_map_imu.rotation.coeffs().setZero();
  EXPECT_EQ(Odometry(EncodeOdometry(nav)), DecodeStatus::kBadFormat);
}

TEST(OutputDecoder, UnknownEnumeratorsAreRefused) {
  NavOutput nav = SomeNav();
  nav.status = static_cast<TrackingStatus>(5);
  EXPECT_EQ(Odometry(EncodeOdometry(nav)), DecodeStatus::kBadFormat);
  StatusReport status = SomeStatus();
  status.trust = static_cast<Trust>(-1);
  EXPECT_EQ(Status(EncodeStatus(status, "1.2.3")), DecodeStatus::kBadFormat);
}

}  // namespace
}  // namespace lio
