// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/stream_stats.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lio {
namespace {

Timestamp At(double seconds) {
  return Timestamp{1'000'000'000'000} + Duration::FromSeconds(seconds);
}

TEST(StreamStats, MeasuresRateSpanAndDelay) {
  StreamStats stats;
  for (int i = 0; i <= 1000; ++i) stats.Add(At(0.01 * i), At(0.01 * i + 0.004));
  EXPECT_EQ(stats.num(), 1001);
  EXPECT_NEAR(stats.rate_hz(), 100.0, 1e-6);
  EXPECT_NEAR(stats.span_s(), 10.0, 1e-9);
  EXPECT_NEAR(stats.mean_delay_s(), 0.004, 1e-9);
  EXPECT_EQ(stats.num_gaps(), 0);
  EXPECT_EQ(stats.num_backwards(), 0);
}

TEST(StreamStats, CountsGapsEarlyAndLateAndStepsBack) {
  StreamStats stats;
  double t = 0.0;
  for (int i = 0; i < 1000; ++i) {
    t += i == 10 || i == 700 ? 0.6 : i == 800 ? -0.05 : 0.01;
    stats.Add(At(t), At(t));
  }
  EXPECT_EQ(stats.num_gaps(), 2);
  EXPECT_EQ(stats.num_backwards(), 1);
  EXPECT_NEAR(stats.longest_gap_s(), 0.6, 1e-9);
  EXPECT_NEAR(stats.rate_hz(), 100.0, 1.0);
}

TEST(StreamStats, OfFewSamplesSayLittle) {
  StreamStats stats;
  EXPECT_EQ(stats.rate_hz(), 0.0);
  EXPECT_EQ(stats.span_s(), 0.0);
  stats.Add(At(1.0), At(1.0));
  EXPECT_EQ(stats.rate_hz(), 0.0);
  EXPECT_EQ(stats.num_gaps(), 0);
}

// The data are ten seconds of noise, with more of it outside the fourth second.
std::string Suggest(double quiet_length) {
  AccelerometerStats stats;
  for (int i = 0; i < 1000; ++i) {
    const bool is_quiet = i >= 300 && i < 400;
    const double shake = is_quiet ? 0.0 : 3.0 * std::sin(1.7 * i);
    stats.Add({At(0.01 * i), Vector3::Zero(), {0.0, shake, quiet_length}});
  }
  EXPECT_NEAR(stats.quiet_mean_mps2(), quiet_length, 0.05);
  return stats.Suggestion();
}

TEST(AccelerometerStats, TellUnitsFromTheQuietestSecond) {
  EXPECT_NE(Suggest(9.8).find("gravity present"), std::string::npos);
  EXPECT_NE(Suggest(1.0).find("units of g"), std::string::npos);
  EXPECT_NE(Suggest(0.05).find("removed"), std::string::npos);
  EXPECT_NE(Suggest(5.0).find("check the driver"), std::string::npos);
}

TEST(AccelerometerStats, CountWhatIsNotFinite) {
  AccelerometerStats stats;
  EXPECT_EQ(stats.Suggestion(), "no finite sample");
  stats.Add({At(0), {0, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 0, 9.8}});
  EXPECT_EQ(stats.num_nonfinite(), 1);
  stats.Add({At(0.01), {0, 3, 4}, {0, 0, 9.8}});
  EXPECT_EQ(stats.largest_rate_radps(), 5.0);
  EXPECT_NEAR(stats.mean_mps2(), 9.8, 1e-12);
}

TEST(StreamStats, ReceiveTimesBeyondAnyClockDoNotOverflow) {
  constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(ReceiveStamp(1'700'000'000'000'000).ns, 1'700'000'000'000'000'000);
  const Duration apart = ReceiveStamp(kHighest) - ReceiveStamp(kLowest);
  EXPECT_GT(apart.ns, 0);
}

}  // namespace
}  // namespace lio
