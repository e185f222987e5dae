// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/progress_bar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(ProgressBar, FillsWithThePercentage) {
  EXPECT_EQ(ProgressBar::Draw("x", 0), "x [" + std::string(40, '-') + "]   0 %");
  EXPECT_EQ(ProgressBar::Draw("x", 50),
            "x [" + std::string(20, '#') + std::string(20, '-') + "]  50 %");
  EXPECT_EQ(ProgressBar::Draw("x", 100), "x [" + std::string(40, '#') + "] 100 %");
}

TEST(ProgressBar, DrawsNothingIntoAPipe) {
  ::testing::internal::CaptureStderr();
  {
    ProgressBar bar("x", 10);
    bar.Update(5);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace lio
