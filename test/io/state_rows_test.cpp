// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/state_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lio {
namespace {

FilterReport CoastingReport() {
  FilterReport filter;
  filter.nav.stamp = {1'700'000'000'000'000'007};
  filter.nav.status = TrackingStatus::kCoasting;
  filter.nav.v_world_imu_mps = Vector3(1.5, 0, 0);
  filter.accel_bias_mps2 = Vector3(0, 0, -0.25);
  filter.cov = Eigen::MatrixXd::Zero(21, 21);
  filter.cov(6, 6) = 0.04;
  filter.cov(14, 14) = 0.01;
  filter.nis_dof = 6;
  return filter;
}

TEST(StateRows, EachRowHasAsManyColumnsAsTheHeader) {
  const std::string header = StateHeader();
  const std::string row = StateRow(2, CoastingReport(), Trust::kDoubtful);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
  EXPECT_TRUE(header.starts_with("t_s,segment,status,trust,velocity_x_mps,velocity_y_mps,"));
  EXPECT_TRUE(header.ends_with(",nis,nis_dof\n"));
}

TEST(StateRows, ValuesComeBeforeTheirStandardDeviations) {
  const std::string row = StateRow(2, CoastingReport(), Trust::kDoubtful);
  EXPECT_TRUE(row.starts_with(
      "1700000000.000000007,2,3,1,1.500000e+00,0.000000e+00,0.000000e+00,2.000000e-01,"));
  EXPECT_NE(row.find(",-2.500000e-01,0.000000e+00,0.000000e+00,1.000000e-01,"), std::string::npos);
}

TEST(StateRows, ASmallCovarianceIsARowToo) {
  FilterReport filter = CoastingReport();
  filter.cov = {};
  EXPECT_TRUE(StateRow(1, filter, Trust::kYes).starts_with("1700000000.000000007,1,3,0,"));
}

}  // namespace
}  // namespace lio
