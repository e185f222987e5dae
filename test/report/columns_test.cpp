// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "report/columns.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lio {
namespace {

TEST(RoundedForPlot, KeepsFiveDigitsWhateverTheSize) {
  EXPECT_EQ(RoundedForPlot(1.23456789).dump(), "1.2346");
  EXPECT_EQ(RoundedForPlot(-0.000123456789).dump(), "-0.00012346");
  EXPECT_EQ(RoundedForPlot(123456.789).dump(), "123460.0");
  EXPECT_EQ(RoundedForPlot(0.0).dump(), "0");
}

TEST(RoundedForPlot, WhatIsNotFiniteIsNull) {
  EXPECT_TRUE(RoundedForPlot(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(RoundedForPlot(-std::numeric_limits<double>::infinity()).is_null());
}

TEST(RowStride, ThinsLongTablesToTheMost) {
  EXPECT_EQ(RowStride(0), 1u);
  EXPECT_EQ(RowStride(kMaxRows), 1u);
  EXPECT_EQ(RowStride(kMaxRows + 1), 2u);
  EXPECT_EQ(RowStride(10 * kMaxRows), 10u);
}

TEST(PlotColumns, RowsBecomeColumnsWithTimesSinceTheBegin) {
  PlotColumns columns(Timestamp{1'000'000'000});
  columns.AddTime(Timestamp{1'500'400'000});
  columns.Add("x", 2.0);
  columns.AddTime(Timestamp{900'000'000});
  columns.Add("x", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(columns.json().dump(), R"({"t":[0.5,-0.1],"x":[2.0,null]})");
}

}  // namespace
}  // namespace lio
