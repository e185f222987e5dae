// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/median.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(UpperMedian, IsTheMiddleValueOrTheUpperOfTwo) {
  EXPECT_EQ(UpperMedian({}), 0.0);
  EXPECT_EQ(UpperMedian({7.0}), 7.0);
  EXPECT_EQ(UpperMedian({3.0, 1.0}), 3.0);
  EXPECT_EQ(UpperMedian({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(UpperMedian({4.0, 1.0, 3.0, 2.0}), 3.0);
}

}  // namespace
}  // namespace lio
