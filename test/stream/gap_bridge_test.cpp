// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/gap_bridge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "lio/sensor/gap.hpp"
#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

// Feeds six seconds at 100 Hz, with this rate about z.
GapBridge After(const std::function<double(double)>& rate_radps) {
  std::deque<ImuSample> sent;
  for (int i = 0; i <= 600; ++i) {
    ImuSample sample;
    sample.stamp = StampAt(0.01 * i);
    sample.w_imu_radps.z() = rate_radps(0.01 * i);
    sample.f_imu_mps2 = Vector3(std::sin(20.0 * i), 0, 9.8);
    sent.push_back(sample);
  }
  return {sent, {}};
}

// A head that has just begun to turn turns on.
TEST(GapBridge, ASlowTurnGoesOn) {
  const GapBridge bridge = After([](double t_s) { return t_s < 3 ? -2.0 : t_s - 5.0 + 2.0; });
  EXPECT_NEAR(bridge.At(StampAt(6.001)).w_imu_radps.z(), 3.0, 0.01);
  EXPECT_GT(bridge.At(StampAt(6.2)).w_imu_radps.z(), 2.8);
}

// A walker sways twice a second: what the last sample read has passed after a sweep.
TEST(GapBridge, ASwayFadesToTheMean) {
  const GapBridge bridge =
      After([](double t_s) { return 0.1 + 0.5 * std::cos(4.0 * std::numbers::pi * t_s); });
  EXPECT_NEAR(bridge.At(StampAt(6.001)).w_imu_radps.z(), 0.6, 0.02);
  EXPECT_NEAR(bridge.At(StampAt(6.5)).w_imu_radps.z(), 0.1, 0.05);
}

TEST(GapBridge, WithoutCorrelationTheMeanHoldsAtOnce) {
  const GapBridge bridge =
      After([](double t_s) { return std::fmod(std::round(10.0 * t_s), 2.0) == 0.0 ? 1.0 : -1.0; });
  EXPECT_NEAR(bridge.At(StampAt(6.001)).w_imu_radps.z(), 0.0, 0.1);
}

TEST(GapBridge, TheForceIsTheMeanAndTheSampleSaysHowFarTheMotionMayBe) {
  const GapBridge bridge = After([](double t_s) { return std::cos(t_s); });
  const ImuSample sample = bridge.At(StampAt(6.1));
  EXPECT_EQ(sample.stamp, StampAt(6.1));
  EXPECT_TRUE(sample.is_made_up());
  EXPECT_NEAR(sample.f_imu_mps2.x(), 0.0, 0.05);
  EXPECT_NEAR(sample.made_up_f_std_mps2, std::sqrt(0.5 / 3.0), 0.02);
}

// Two samples with a line between them turn by as much as the fading rate, summed up in steps.
TEST(GapBridge, ALineTurnsByAsMuchAsTheFadingRate) {
  const GapBridge bridge = After([](double t_s) { return std::sin(2.0 * t_s); });
  const double begin_s = 6.001;
  const double end_s = 6.801;
  double turn_rad = 0.0;
  for (double t_s = begin_s + 5e-4; t_s < end_s; t_s += 1e-3) {
    turn_rad += 1e-3 * bridge.At(StampAt(t_s)).w_imu_radps.z();
  }
  const ImuSample begin = bridge.BeginLine(StampAt(begin_s), StampAt(end_s));
  const double mean_radps =
      0.5 * (begin.w_imu_radps.z() + bridge.At(StampAt(end_s)).w_imu_radps.z());
  EXPECT_EQ(begin.stamp, StampAt(begin_s));
  EXPECT_NEAR(mean_radps * (end_s - begin_s), turn_rad, 1e-4);
}

TEST(GapBridge, OneSampleIsEnough) {
  ImuSample sample;
  sample.stamp = StampAt(1.0);
  sample.w_imu_radps = Vector3(0, 0, 0.3);
  const GapBridge bridge({sample}, {});
  EXPECT_EQ(bridge.At(StampAt(1.2)).w_imu_radps, sample.w_imu_radps);
}

}  // namespace
}  // namespace lio
