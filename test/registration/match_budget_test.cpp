// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/match_budget.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(MatchBudget, GivesSoManyMatchesAndNoMore) {
  MatchBudget budget(2);
  EXPECT_TRUE(budget.Take());
  EXPECT_EQ(budget.num_left(), 1);
  EXPECT_TRUE(budget.Take());
  EXPECT_FALSE(budget.Take());
  EXPECT_EQ(budget.num_taken(), 2);
  EXPECT_EQ(budget.num_left(), 0);
}

}  // namespace
}  // namespace lio
