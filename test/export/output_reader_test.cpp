// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/output_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/recorded_log.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

TEST(OutputReader, HandsEachKindToItsTaker) {
  const test::TempDir folder;
  int num_odometry = 0;
  int num_status = 0;
  OutputTakers takers;
  takers.odometry = [&](const NavOutput& nav, Timestamp received) {
    EXPECT_EQ(nav.scan_seq, num_odometry++);
    EXPECT_EQ((received - nav.stamp).ns, 5'000'000);
  };
  takers.status = [&](const StatusReport&, Timestamp) { ++num_status; };
  const ExportCounts counts = ReadOutputs(test::RecordedLog(folder), {}, takers);
  EXPECT_EQ(num_odometry, test::kNumScans);
  EXPECT_EQ(num_status, 6);
  EXPECT_EQ(counts.num_messages, test::kNumScans + 6);
  EXPECT_EQ(counts.num_refused, 0);
}

TEST(OutputReader, MalformedMessagesAreCounted) {
  const test::TempDir folder;
  const auto log = folder.path() / "log.lcm";
  EventLogWriter writer(log);
  writer.Write(-1, "LIO_ODOM", EncodeOdometry(test::NavOf(0)));
  writer.Write(1, "LIO_ODOM", Bytes(834, 0xff));
  writer.Write(1, "LIO_ODOM", Bytes());
  writer.Close();
  OutputTakers takers;
  takers.odometry = [](const NavOutput&, Timestamp received) { EXPECT_EQ(received.ns, 0); };
  const ExportCounts counts = ReadOutputs(log, {}, takers);
  EXPECT_EQ(counts.num_messages, 1);
  EXPECT_EQ(counts.num_refused, 2);
}

TEST(OutputReader, ALogWithoutThemIsRefusedWithWhatIsNeeded) {
  const test::TempDir folder;
  OutputTakers takers;
  takers.odometry = [](const NavOutput&, Timestamp) {};
  ExportOptions options;
  options.channel_prefix = "CAR_";
  try {
    (void)ReadOutputs(test::RecordedLog(folder), options, takers);
    FAIL() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("CAR_ODOM"));
  }
}

}  // namespace
}  // namespace lio
