// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/rotor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/spread.hpp"

namespace lio::sim {
namespace {

using test::Spread;

constexpr double kDegree = std::numbers::pi / 180.0;

template <typename F>
Spread SpreadOf(int num, const F& value_of) {
  double sum = 0.0;
  double sum_sq = 0.0;
  for (int i = 0; i < num; ++i) {
    const double value = value_of(i);
    sum += value;
    sum_sq += value * value;
  }
  return {sum / num, std::sqrt(std::max(0.0, sum_sq / num - sum * sum / num / num))};
}

TEST(Rotor, WithoutErrorsEveryTurnTakesItsTime) {
  const LidarModel model;
  const Rotor rotor(model, {}, 1, 5.0);
  for (std::int64_t turn = 0; turn < 100; ++turn) {
    const TurnColumns columns = rotor.ColumnsOf(turn);
    EXPECT_NEAR(columns.begin_s, 5.0 + 0.1 * static_cast<double>(turn), model.column_period_s);
    const double heading = rotor.HeadingAt(columns.begin_s);
    EXPECT_EQ(heading, rotor.ReportedHeadingAt(columns.begin_s));
  }
}

TEST(Rotor, SweepsFollowEachOtherWhileItsSpeedWobbles) {
  const LidarModel model;
  const Rotor rotor(model, {0.01, 0.0}, 1, 0.0);
  for (std::int64_t turn = 0; turn < 300; ++turn) {
    const TurnColumns columns = rotor.ColumnsOf(turn);
    EXPECT_EQ(columns.first + columns.num, rotor.ColumnsOf(turn + 1).first);
    // The turn begins where the rotor has just passed the cut.
    const double passed = model.cut_azimuth_rad - rotor.HeadingAt(columns.begin_s);
    EXPECT_GE(passed, 0.0);
    EXPECT_LT(passed, 0.3 * kDegree);
  }
}

TEST(Rotor, TheLengthOfSweepsVariesAsKittisDo) {
  LidarModel model;
  model.column_period_s = 1e-6;  // fine enough to see a sweep's length
  double sum_var = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Rotor rotor(model, {1e-3, 0.0}, seed, 0.0);
    const Spread lengths = SpreadOf(100, [&](int turn) {
      const TurnColumns columns = rotor.ColumnsOf(turn);
      return columns.end_s - columns.begin_s;
    });
    EXPECT_NEAR(lengths.mean, 0.1, 5e-5);
    sum_var += lengths.std * lengths.std;
  }
  EXPECT_NEAR(std::sqrt(sum_var / 20), 1e-4, 2e-5);
}

TEST(Rotor, TheEncoderIsOffByAHundredthOfADegree) {
  const LidarModel model;
  const Rotor rotor(model, {0.0, 0.01 * kDegree}, 1, 0.0);
  const Spread off = SpreadOf(
      1000, [&](int i) { return rotor.ReportedHeadingAt(1e-4 * i) - rotor.HeadingAt(1e-4 * i); });
  EXPECT_NEAR(off.mean, 0.0, 1e-6);
  EXPECT_NEAR(off.std, 0.01 * kDegree, 1e-7);
}

}  // namespace
}  // namespace lio::sim
