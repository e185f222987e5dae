// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_account.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/io/status_report.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Bytes kAny{0};

StatusReport ReportOfARun() {
  StatusReport report;
  report.counters.num_imu = 4;
  report.counters.num_chunks = 2;
  report.counters.num_scans = 2;
  report.counters.num_scans_empty = 1;
  report.input.num_refused[static_cast<std::size_t>(DecodeStatus::kBadFormat)] = 1;
  report.num_imu_queue_dropped = 1;
  Account account;
  account.ledgers.scans.num_received = 2;
  account.ledgers.scans.Settle(ScanFate::kUsed);
  account.ledgers.scans.Settle(ScanFate::kEmpty);
  report.account = AccountPages(account, {});
  return report;
}

void AddTimes(OutputAccount& account, const char* channel, int times) {
  for (int i = 0; i < times; ++i) account.Add(channel, kAny);
}

TEST(StatusCounts, ComeBackFromTheWire) {
  StatusReport report = ReportOfARun();
  report.start_utime = 77;
  const auto counts = DecodeStatusCounts(EncodeStatus(report, "1.0.0"));
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->start_utime, 77);
  EXPECT_EQ(counts->counters.num_scans_empty, 1);
  EXPECT_EQ(counts->NumReceived(), 8);
  EXPECT_EQ(counts->account.back().num_received(), 2);
  EXPECT_EQ(counts->account.back().Unaccounted(), 0);
}

TEST(StatusCounts, AreAbsentFromForeignAndDamagedBytes) {
  EXPECT_FALSE(DecodeStatusCounts({}));
  EXPECT_FALSE(DecodeStatusCounts(kAny));
  const Bytes bytes = EncodeStatus(ReportOfARun(), "1.0.0");
  EXPECT_FALSE(DecodeStatusCounts(ByteView(bytes).first(200)));
  for (const std::size_t at : {std::size_t{0}, std::size_t{37}, std::size_t{37 + 8 * 26}}) {
    Bytes damaged = bytes;  // in the fingerprint, the first count or the first refusal
    damaged[at] ^= 0x7f;
    EXPECT_FALSE(DecodeStatusCounts(damaged)) << at;
  }
}

TEST(OutputAccount, IsEmptyWithoutAStatus) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_IMU", 3);
  EXPECT_EQ(account.Text(), "");
}

TEST(OutputAccount, ClosesWhereAllThatWasRecordedArrived) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_IMU", 5);
  AddTimes(account, "LIO_SCAN", 3);
  AddTimes(account, "LIO_REG", 1);
  account.Add("LIO_STATUS", EncodeStatus(ReportOfARun(), "1.0.0"));
  AddTimes(account, "LIO_IMU", 9);  // after the last status
  EXPECT_THAT(account.Text(), HasSubstr("messages: 8 recorded"));
  EXPECT_THAT(account.Text(), Not(HasSubstr("does not close")));
}

TEST(OutputAccount, SaysByHowMuchItDoesNotClose) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_IMU", 10);
  account.Add("LIO_STATUS", EncodeStatus(ReportOfARun(), "1.0.0"));
  EXPECT_THAT(account.Text(), HasSubstr("does not close by 2: messages were on the way"));
}

TEST(OutputAccount, NamesRowsThatWereNotRecorded) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_REG", 3);
  account.Add("LIO_STATUS", EncodeStatus(ReportOfARun(), "1.0.0"));
  EXPECT_THAT(account.Text(), HasSubstr("rows: 3 recorded of 1 scans that were matched: does not "
                                        "close by -2: scans have two rows"));
}

TEST(OutputAccount, SaysByHowMuchTheStatusItselfDoesNotClose) {
  OutputAccount account{Channels()};
  StatusReport report = ReportOfARun();
  report.account.back().entries.front().count += 3;
  account.Add("LIO_STATUS", EncodeStatus(report, "1.0.0"));
  EXPECT_THAT(account.Text(), HasSubstr("imu: 0 received = 0: closes"));
  EXPECT_THAT(account.Text(), HasSubstr("scans: 5 received = 1 used + 1 empty: does not close by "
                                        "3: they have no fate"));
}

TEST(OutputAccount, TheOutputsAloneAreHeldAgainstScansOnly) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_REG", 1);
  account.Add("LIO_STATUS", EncodeStatus(ReportOfARun(), "1.0.0"));
  EXPECT_THAT(account.Text(), Not(HasSubstr("messages")));
  EXPECT_THAT(account.Text(), HasSubstr("rows: 1 recorded of 1 scans that were matched: closes"));
  EXPECT_THAT(account.Text(), HasSubstr("scans: 2 received = 1 used + 1 empty: closes"));
}

TEST(OutputAccount, ASecondDaemonCountsFromItsStart) {
  OutputAccount account{Channels()};
  AddTimes(account, "LIO_IMU", 100);
  AddTimes(account, "LIO_REG", 20);
  account.Add("LIO_STATUS", EncodeStatus({}, "1.0.0"));
  AddTimes(account, "LIO_IMU", 8);
  AddTimes(account, "LIO_REG", 1);
  StatusReport second = ReportOfARun();
  second.start_utime = 5;
  account.Add("LIO_STATUS", EncodeStatus(second, "1.0.0"));
  EXPECT_THAT(account.Text(), Not(HasSubstr("does not close")));
}

}  // namespace
}  // namespace lio
