// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/oxts.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(Oxts, RefusesShortAndNonFiniteRows) {
  EXPECT_FALSE(ParseOxts(""));
  EXPECT_FALSE(ParseOxts("1 2 3"));
  std::string row;
  for (int i = 0; i < 30; ++i) row += i == 12 ? "inf " : "1 ";
  EXPECT_FALSE(ParseOxts(row));
}

TEST(Oxts, ImuOfOneRowIsThatRow) {
  const std::vector<OxtsRow> rows(1);
  EXPECT_EQ(OxtsImu(rows, 100.0).size(), 1u);
  EXPECT_EQ(OxtsImu(rows, {}).size(), 1u);
}

}  // namespace
}  // namespace lio
