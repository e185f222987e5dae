// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/notice_log.hpp"

#include <gtest/gtest.h>

#include "app/captured_log.hpp"

namespace lio {
namespace {

Notice At(std::int64_t seconds, const std::string& text) {
  Notice notice;
  notice.stamp = Timestamp{seconds * 1'000'000'000};
  notice.severity = Notice::Severity::kWarning;
  notice.text = text;
  return notice;
}

TEST(NoticeLog, ANoticeIsALineWithItsTimeAndSeverity) {
  const test::CapturedLog captured;
  NoticeLog log;
  log.Write(At(100, "waiting for rest"));
  EXPECT_EQ(captured.text(), "warning 100.000: waiting for rest\n");
}

TEST(NoticeLog, TheSameWordsAreLeftOutForFiveSecondsOfSensorTime) {
  const test::CapturedLog captured;
  NoticeLog log;
  log.Write(At(100, "waiting for rest"));
  log.Write(At(104, "waiting for rest"));
  log.Write(At(105, "waiting for rest"));
  EXPECT_EQ(captured.text(),
            "warning 100.000: waiting for rest\nwarning 105.000: waiting for rest\n");
}

TEST(NoticeLog, OtherWordsAreWrittenAtOnce) {
  const test::CapturedLog captured;
  NoticeLog log;
  log.Write(At(100, "waiting for rest"));
  log.Write(At(100, "started"));
  log.Write(At(101, "waiting for rest"));
  EXPECT_EQ(captured.text(),
            "warning 100.000: waiting for rest\nwarning 100.000: started\n"
            "warning 101.000: waiting for rest\n");
}

}  // namespace
}  // namespace lio
