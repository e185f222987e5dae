// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/initial_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using testing::HasSubstr;
using Points = std::vector<Eigen::Vector3f>;

TEST(InitialMap, OrdinaryCloudsAreUsable) {
  EXPECT_EQ(WhyUnusable(Points{{0.f, 0.f, 0.f}, {3000.f, -500.f, 20.f}}), "");
}

TEST(InitialMap, SaysWhyAnotherIsNot) {
  EXPECT_THAT(WhyUnusable(Points{}), HasSubstr("no points"));
  EXPECT_THAT(WhyUnusable(Points{{0.f, 0.f, 0.f}, {5000.f, 0.f, 0.f}}), HasSubstr("5.0 km wide"));
  EXPECT_THAT(WhyUnusable(Points{{500e3f, 4500e3f, 0.f}}), HasSubstr("4500 km from its origin"));
}

}  // namespace
}  // namespace lio
