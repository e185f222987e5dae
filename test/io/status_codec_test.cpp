// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "lio/base/counters_fields.hpp"
#include "lio/io/status_report.hpp"
#include "lio/status_t.hpp"
#include "support/build_paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

status_t Decoded(const Bytes& bytes) {
  status_t message;
  EXPECT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  return message;
}

TEST(StatusCodec, EveryCountOfTheEstimatorArrives) {
  // Each gets a value of its own.
  constexpr std::size_t kNumCounters = kCounterFields.size();
  std::array<std::int64_t, kNumCounters> values{};
  StatusReport report;
  for (std::size_t i = 0; i < kNumCounters; ++i) {
    values[i] = 1000 + static_cast<int>(i);
    report.counters.*kCounterFields[i].count = values[i];
  }
  const status_t message = Decoded(EncodeStatus(report, "0.1.0"));
  const std::set<std::int64_t> arrived = {message.imu,
                                          message.imu_nonfinite,
                                          message.imu_duplicate,
                                          message.imu_late,
                                          message.imu_out_of_range,
                                          message.imu_clipped,
                                          message.imu_gaps,
                                          message.imu_stuck,
                                          message.imu_contradicted,
                                          message.chunks,
                                          message.chunks_duplicate,
                                          message.chunks_late,
                                          message.chunks_missing,
                                          message.chunks_bad,
                                          message.points_nonfinite,
                                          message.scans,
                                          message.scans_empty,
                                          message.scans_dropped,
                                          message.scans_late,
                                          message.scans_without_imu,
                                          message.scan_gaps,
                                          message.scans_repeated,
                                          message.matches_rejected,
                                          message.gated,
                                          message.standstills,
                                          message.clock_jumps,
                                          message.restarts,
                                          message.lost,
                                          message.imu_foreign,
                                          message.chunks_foreign};
  EXPECT_EQ(arrived, std::set<std::int64_t>(values.begin(), values.end()));
  EXPECT_EQ(message.gated, report.counters.num_gated);
  EXPECT_EQ(message.chunks_bad, report.counters.num_chunks_bad);
}

// Returns the names of the type's int64 fields, in their order.
std::vector<std::string> CountsOfTheType() {
  const std::filesystem::path source = test::SourceDir();
  const std::string type = test::ReadText(source / "lcmtypes" / "lio_status_t.lcm");
  const std::regex field("int64_t (\\w+);");
  std::vector<std::string> names;
  for (std::sregex_iterator at(type.begin(), type.end(), field), end; at != end; ++at) {
    names.push_back((*at)[1]);
  }
  return names;
}

TEST(StatusCodec, TheTypeHasTheFieldListsCountsInItsOrder) {
  std::vector<std::string> listed;
  for (const CounterField& field : kCounterFields) {
    listed.emplace_back(field.name.substr(std::string_view("num_").size()));
  }
  std::vector<std::string> names = CountsOfTheType();
  names.erase(names.begin(), std::find(names.begin(), names.end(), "imu"));
  names.erase(std::find(names.begin(), names.end(), "bad_truncated"), names.end());
  EXPECT_EQ(names, listed);
}

TEST(StatusCodec, TheTypeHasTheEntriesOfTheAccountInTheirOrder) {
  std::vector<std::string> listed;
  for (const AccountPage& page : AccountPages({}, {})) {
    for (const AccountEntry& entry : page.entries) {
      listed.push_back("account_" + std::string(page.name) + "_" + std::string(entry.name));
    }
  }
  std::vector<std::string> names = CountsOfTheType();
  std::erase_if(names, [](const std::string& name) { return !name.starts_with("account_"); });
  EXPECT_EQ(names, listed);
}

TEST(StatusCodec, TheAccountArrives) {
  StatusReport report;
  report.account.front().entries.front().count = 7;
  report.account[1].entries.front().count = 8;
  report.account.back().entries.back().count = -9;
  const status_t message = Decoded(EncodeStatus(report, "0.1.0"));
  EXPECT_EQ(message.handler_faults, 0);
  EXPECT_EQ(message.account_imu_received, 7);
  EXPECT_EQ(message.account_imu_truncated, 0);
  EXPECT_EQ(message.account_chunks_received, 8);
  EXPECT_EQ(message.account_scans_forgotten, 0);
  EXPECT_EQ(message.account_scans_waiting, -9);
  EXPECT_EQ(message.rcvbuf_bytes, 0);
}

TEST(StatusCodec, NoiseOfTheImuArrives) {
  StatusReport report;
  report.imu_noise = {.gyro = 2.5, .accel = 9.0};
  const status_t message = Decoded(EncodeStatus(report, "0.1.0"));
  EXPECT_EQ(message.gyro_noise_ratio, 2.5F);
  EXPECT_EQ(message.accel_noise_ratio, 9.0F);
}

TEST(StatusCodec, TheClockOffsetArrivesWithItsStandardDeviation) {
  StatusReport report;
  EXPECT_EQ(Decoded(EncodeStatus(report, "0.1.0")).clock_offset_std_s, 0.0) << "not estimated";
  report.clock_offset = {.offset_s = -0.025, .std_s = 0.0004};
  const status_t message = Decoded(EncodeStatus(report, "0.1.0"));
  EXPECT_EQ(message.clock_offset_s, -0.025);
  EXPECT_EQ(message.clock_offset_std_s, 0.0004);
}

TEST(StatusCodec, TrustArrives) {
  StatusReport report;
  EXPECT_EQ(Decoded(EncodeStatus(report, "0.1.0")).trust, 0);
  report.trust = Trust::kNo;
  EXPECT_EQ(Decoded(EncodeStatus(report, "0.1.0")).trust, 2);
}

TEST(StatusCodec, NegativeAndLargeCountsArriveUnchanged) {
  StatusReport report;
  report.counters.num_imu = -2;
  report.counters.num_restarts = 0x0123456789abcdef;
  const status_t message = Decoded(EncodeStatus(report, "0.1.0"));
  EXPECT_EQ(message.imu, -2);
  EXPECT_EQ(message.restarts, 0x0123456789abcdef);
  EXPECT_EQ(message.bad_truncated, 0);
}

TEST(StatusCodec, LossesLatenciesAndIdentityArrive) {
  StatusReport report;
  report.utime = 5;
  report.newest_stamp = Timestamp{7000};
  report.state = TrackingStatus::kLost;
  report.input.num_refused[static_cast<std::size_t>(DecodeStatus::kSizeMismatch)] = 3;
  report.num_kernel_dropped = 11;
  report.latency = {1.0F, 2.0F, 3.0F};
  report.config_hash = 0xfedcba9876543210;
  report.note = "waiting for rest";
  report.options = "pipeline: {}";
  const status_t message = Decoded(EncodeStatus(report, "1.22.3"));
  EXPECT_EQ(message.utime, 5);
  EXPECT_EQ(message.sensor_utime, 7);
  EXPECT_EQ(message.state, 4);
  EXPECT_EQ(message.bad_size_mismatch, 3);
  EXPECT_EQ(message.kernel_dropped, 11);
  EXPECT_EQ(message.latency_p99_ms, 2.0F);
  EXPECT_EQ(static_cast<std::uint64_t>(message.config_hash), report.config_hash);
  EXPECT_EQ(message.version[1], 22);
  EXPECT_EQ(message.version[2], 3);
  EXPECT_EQ(message.note, "waiting for rest");
  EXPECT_EQ(message.options, "pipeline: {}");
}

TEST(Fnv1a, AgreesWithPublishedValues) {
  EXPECT_EQ(Fnv1a(""), 0xcbf29ce484222325u);
  EXPECT_EQ(Fnv1a("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace lio
