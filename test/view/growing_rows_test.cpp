// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/growing_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::ElementsAre;

TEST(GrowingRows, KeepsRowsInTheirOrder) {
  GrowingRows<int> rows(10);
  for (int i = 0; i < 4; ++i) rows.Add(i);
  EXPECT_THAT(rows.rows(), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(rows.generation(), 1U);
}

TEST(GrowingRows, WhenTheyAreTooManyEverySecondOneIsKeptNowAndLater) {
  GrowingRows<int> rows(4);
  for (int i = 0; i < 5; ++i) rows.Add(i);
  EXPECT_THAT(rows.rows(), ElementsAre(0, 2, 4));
  EXPECT_EQ(rows.generation(), 2U);
  for (int i = 5; i < 9; ++i) rows.Add(i);
  EXPECT_THAT(rows.rows(), ElementsAre(0, 4, 8));
  EXPECT_EQ(rows.generation(), 3U);
  for (int i = 9; i < 17; ++i) rows.Add(i);
  EXPECT_THAT(rows.rows(), ElementsAre(0, 8, 16));
}

TEST(GrowingRows, StayBoundedAndEven) {
  GrowingRows<int> rows(100);
  for (int i = 0; i < 100'000; ++i) rows.Add(i);
  ASSERT_LE(rows.rows().size(), 100U);
  const int stride = rows.rows()[1];
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    EXPECT_EQ(rows.rows()[i], static_cast<int>(i) * stride);
  }
}

TEST(GrowingRows, ClearingBeginsAGenerationAndTakesEveryRowAgain) {
  GrowingRows<int> rows(4);
  for (int i = 0; i < 9; ++i) rows.Add(i);
  const auto generation = rows.generation();
  rows.Clear();
  EXPECT_EQ(rows.generation(), generation + 1);
  EXPECT_TRUE(rows.rows().empty());
  rows.Add(7);
  rows.Add(8);
  EXPECT_THAT(rows.rows(), ElementsAre(7, 8));
}

}  // namespace
}  // namespace lio
