// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/covariance_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lio {
namespace {

TEST(CovarianceRows, ARowHasTheStampAndAllElementsRowByRow) {
  Matrix6 cov = Matrix6::Zero();
  cov(0, 1) = 0.125;
  cov(5, 5) = 2.0;
  const std::string row = CovarianceRow({1'700'000'000'000'000'007}, cov);
  EXPECT_TRUE(row.starts_with("1700000000.000000007,0.000000000000e+00,1.250000000000e-01,"));
  EXPECT_TRUE(row.ends_with(",2.000000000000e+00\n"));
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), 36);
}

TEST(CovarianceRows, TheHeaderNamesTheElementsInTheSameOrder) {
  const std::string header = CovarianceHeader();
  EXPECT_TRUE(header.starts_with("t_s,cov_x_x,cov_x_y,"));
  EXPECT_TRUE(header.ends_with(",cov_rz_ry,cov_rz_rz\n"));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 36);
}

}  // namespace
}  // namespace lio
