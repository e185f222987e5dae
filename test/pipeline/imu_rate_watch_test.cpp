// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_rate_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lio {
namespace {

// Returns the samples of a second, without every `lost`-th.
std::vector<ImuSample> SamplesAt(int rate_hz, int lost = 1'000'000) {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= rate_hz; ++i) {
    if (i % lost == lost - 1) continue;
    ImuSample sample;
    sample.stamp = Timestamp{} + Duration::FromSeconds(i / static_cast<double>(rate_hz));
    samples.push_back(sample);
  }
  return samples;
}

TEST(ImuRateWatch, ASlowUnitIsToldOnce) {
  for (const int rate_hz : {10, 20, 30}) {
    ImuRateWatch watch;
    const std::optional<std::string> said = watch.Add(SamplesAt(rate_hz));
    ASSERT_TRUE(said.has_value()) << rate_hz;
    EXPECT_TRUE(said->starts_with("the IMU gives " + std::to_string(rate_hz) + " samples a second"))
        << *said;
    EXPECT_FALSE(watch.Add(SamplesAt(rate_hz)).has_value());
  }
}

TEST(ImuRateWatch, AFastUnitIsNotTold) {
  for (const int rate_hz : {40, 100, 400}) {
    ImuRateWatch watch;
    EXPECT_FALSE(watch.Add(SamplesAt(rate_hz)).has_value()) << rate_hz;
  }
}

TEST(ImuRateWatch, LostSamplesMakeNoUnitSlow) {
  ImuRateWatch watch;
  EXPECT_FALSE(watch.Add(SamplesAt(100, 3)).has_value());
}

TEST(ImuRateWatch, AFewSamplesTellNothing) {
  ImuRateWatch watch;
  EXPECT_FALSE(watch.Add({}).has_value());
  const std::vector<ImuSample> samples = SamplesAt(10);
  EXPECT_FALSE(watch.Add(std::span(samples).first(7)).has_value());
  EXPECT_TRUE(watch.Add(samples).has_value());
}

}  // namespace
}  // namespace lio
