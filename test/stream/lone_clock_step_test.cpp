// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "stream/lone_clock_step.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(LoneClockStep, MedianIsTheUpperOneOfAnEvenNumber) {
  EXPECT_EQ(MedianOf({Duration{7}}), Duration{7});
  EXPECT_EQ(MedianOf({Duration{9}, Duration{-4}, Duration{2}}), Duration{2});
  EXPECT_EQ(MedianOf({Duration{1}, Duration{4}, Duration{3}, Duration{2}}), Duration{3});
}

TEST(LoneClockStep, TextNamesBothSensorsTheStepAndTheShift) {
  EXPECT_EQ(
      TextOfLoneStep("lidar", "IMU", 1.5, Duration{-1'480'000'000}),
      "the lidar's clock stepped by 1.500 s and the IMU's did not: the lidar's stamps are now "
      "shifted by -1.480 s; nothing need be done");
}

}  // namespace
}  // namespace lio
