// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scans from one place show the same rings; a map of them must not hold the vehicle back when it
// drives off (docs/filter.md).
#include <gtest/gtest.h>

#include "registration/ndt_matcher_in.hpp"

namespace lio {
namespace {

using test::NdtMatcherIn;
using test::OnRoad;

TEST(NdtRingLock, MapOfAParkedSensorDoesNotHoldTheVehicleBack) {
  NdtMatcherIn street(test::Street());
  for (int scan = 0; scan < 50; ++scan) street.InsertFrom(OnRoad(0.0));
  for (const double x_m : {0.1, 0.3, 0.8, 1.5}) {
    const Pose truth = OnRoad(x_m);
    const MatchResult result = street.MatchFrom(truth, Vector6::Zero(), 0.1);
    ASSERT_TRUE(result.IsUsable()) << x_m;
    EXPECT_LT(LogSe3(truth.Inverse() * result.T_map_imu).head<3>().norm(), 0.03)
        << "at " << x_m << " m";
  }
}

TEST(NdtRingLock, ParkedMapKeepsUpWithTheVehicleDrivingOff) {
  NdtMatcherIn street(test::Street());
  for (int scan = 0; scan < 50; ++scan) street.InsertFrom(OnRoad(0.0));
  Pose estimate = OnRoad(0.0);
  for (double x_m = 0.1; x_m < 4.0; x_m += 0.2) {
    const Pose truth = OnRoad(x_m);
    const Pose guess = estimate * ExpSe3(0.2 * Vector6::Unit(0));
    const MatchResult result = street.Match(street.See(truth), guess, 0.1);
    ASSERT_TRUE(result.IsUsable()) << x_m;
    estimate = result.T_map_imu;
    street.matcher().Insert({street.See(truth)}, estimate);
    ASSERT_LT((estimate.translation - truth.translation).norm(), 0.03) << "at " << x_m << " m";
  }
}

}  // namespace
}  // namespace lio
