// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_rate_watch.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace lio {
namespace {

// Returns the samples of a second, without every `lost`-th.
std::deque<ImuSample> SamplesAt(int rate_hz, int lost = 1'000'000) {
  std::deque<ImuSample> samples;
  for (int i = 0; i <= rate_hz; ++i) {
    if (i % lost == lost - 1) continue;
    ImuSample sample;
    sample.stamp = Timestamp{} + Duration::FromSeconds(i / static_cast<double>(rate_hz));
    samples.push_back(sample);
  }
  return samples;
}

std::optional<std::string> Add(ImuRateWatch& watch, const std::deque<ImuSample>& samples) {
  return watch.Add(samples, samples.empty() ? Timestamp{} : samples.back().stamp);
}

TEST(ImuRateWatch, ASlowUnitIsToldOnce) {
  for (const int rate_hz : {10, 20, 30}) {
    ImuRateWatch watch;
    const std::optional<std::string> said = Add(watch, SamplesAt(rate_hz));
    ASSERT_TRUE(said.has_value()) << rate_hz;
    EXPECT_TRUE(said->starts_with("the IMU gives " + std::to_string(rate_hz) + " samples a second"))
        << *said;
    EXPECT_FALSE(Add(watch, SamplesAt(rate_hz)).has_value());
  }
}

TEST(ImuRateWatch, AFastUnitIsNotTold) {
  for (const int rate_hz : {40, 100, 400}) {
    ImuRateWatch watch;
    EXPECT_FALSE(Add(watch, SamplesAt(rate_hz)).has_value()) << rate_hz;
  }
}

TEST(ImuRateWatch, LostSamplesMakeNoUnitSlow) {
  ImuRateWatch watch;
  EXPECT_FALSE(Add(watch, SamplesAt(100, 3)).has_value());
}

TEST(ImuRateWatch, AFewSamplesTellNothing) {
  ImuRateWatch watch;
  EXPECT_FALSE(Add(watch, {}).has_value());
  std::deque<ImuSample> samples = SamplesAt(10);
  const ImuSample last = samples.back();
  samples.resize(7);
  EXPECT_FALSE(Add(watch, samples).has_value());
  samples.push_back(last);
  EXPECT_TRUE(Add(watch, samples).has_value());
}

}  // namespace
}  // namespace lio
