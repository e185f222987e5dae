// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/stderr_capture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "support/descriptor_limit.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

TEST(StderrCapture, TakesWhatIsWrittenMeanwhileAndRestoresStderr) {
  testing::internal::CaptureStderr();
  std::fputs("before ", stderr);
  StderrCapture capture;
  std::fputs("two\nlines\n", stderr);
  EXPECT_EQ(capture.fault(), "");
  EXPECT_EQ(capture.Finish(), "two\nlines\n");
  EXPECT_EQ(capture.Finish(), "");
  std::fputs("after", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "before after");
}

TEST(StderrCapture, IsUndoneWithoutFinish) {
  testing::internal::CaptureStderr();
  {
    const StderrCapture capture;
    std::fputs("lost", stderr);
  }
  std::fputs("seen", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "seen");
}

TEST(StderrCapture, WithoutAFreeDescriptorStderrStaysAsItIsAndTheReasonIsTold) {
  testing::internal::CaptureStderr();
  {
    const test::NoFreeDescriptors none;
    StderrCapture capture;
    EXPECT_THAT(capture.fault(), HasSubstr("dup: Too many open files"));
    std::fputs("not captured", stderr);
    EXPECT_EQ(capture.Finish(), "");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "not captured");
}

}  // namespace
}  // namespace lio
