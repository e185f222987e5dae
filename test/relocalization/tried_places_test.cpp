// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/tried_places.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Pose At(double x_m, double yaw_rad) {
  return {ExpSo3(Vector3(0, 0, yaw_rad)), Vector3(x_m, 0, 0)};
}

TEST(TriedPlaces, MoveAsThePriorDoes) {
  TriedPlaces tried;
  tried.Add(At(10, 0), At(4, 0));
  EXPECT_TRUE(tried.Contains(At(10, 0), At(4.5, 0.05)));
  EXPECT_TRUE(tried.Contains(At(12, 0), At(6, 0)));
  EXPECT_FALSE(tried.Contains(At(12, 0), At(4, 0)));
  EXPECT_FALSE(tried.Contains(At(10, 0), At(4, 0.2)));
}

TEST(TriedPlaces, AreForgottenOnDemand) {
  TriedPlaces tried;
  tried.Add(Pose{}, Pose{});
  EXPECT_TRUE(tried.Contains(Pose{}, Pose{}));
  tried.Clear();
  EXPECT_FALSE(tried.Contains(Pose{}, Pose{}));
}

}  // namespace
}  // namespace lio
