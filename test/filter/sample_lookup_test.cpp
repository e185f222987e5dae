// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/sample_lookup.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

namespace lio {
namespace {

ImuSample Sample(std::int64_t stamp_ns, double rate_radps) {
  ImuSample sample;
  sample.stamp = Timestamp{stamp_ns};
  sample.w_imu_radps = Vector3(rate_radps, 0, 0);
  return sample;
}

const std::vector<ImuSample> kSamples = {Sample(100, 1.0), Sample(200, 3.0), Sample(300, 2.0)};

TEST(SampleLookup, TheFirstNotBeforeIsAtTheStampOrAfterIt) {
  EXPECT_EQ(FirstNotBefore(kSamples, Timestamp{50}), kSamples.begin());
  EXPECT_EQ(FirstNotBefore(kSamples, Timestamp{200}), kSamples.begin() + 1);
  EXPECT_EQ(FirstNotBefore(kSamples, Timestamp{201}), kSamples.begin() + 2);
  EXPECT_EQ(FirstNotBefore(kSamples, Timestamp{301}), kSamples.end());
}

TEST(SampleLookup, BetweenSamplesItIsLinear) {
  const ImuSample sample = SampleAt(kSamples, Timestamp{150});
  EXPECT_EQ(sample.stamp, Timestamp{150});
  EXPECT_DOUBLE_EQ(sample.w_imu_radps.x(), 2.0);
  EXPECT_DOUBLE_EQ(SampleAt(kSamples, Timestamp{275}).w_imu_radps.x(), 2.25);
}

TEST(SampleLookup, OutsideTheNearestHolds) {
  const std::deque<ImuSample> samples(kSamples.begin(), kSamples.end());
  EXPECT_DOUBLE_EQ(SampleAt(samples, Timestamp{1}).w_imu_radps.x(), 1.0);
  EXPECT_EQ(SampleAt(samples, Timestamp{1}).stamp, Timestamp{1});
  EXPECT_DOUBLE_EQ(SampleAt(samples, Timestamp{999}).w_imu_radps.x(), 2.0);
  EXPECT_EQ(SampleAt(samples, Timestamp{999}).stamp, Timestamp{999});
}

TEST(SampleLookup, LateSamplesAreInsertedAndRepeatsAreNot) {
  std::deque<ImuSample> samples(kSamples.begin(), kSamples.end());
  EXPECT_TRUE(InsertByStamp(samples, Sample(250, 5.0)));
  EXPECT_TRUE(InsertByStamp(samples, Sample(50, 4.0)));
  EXPECT_FALSE(InsertByStamp(samples, Sample(200, 6.0)));
  std::vector<std::int64_t> stamps_ns;
  for (const ImuSample& sample : samples) stamps_ns.push_back(sample.stamp.ns);
  EXPECT_EQ(stamps_ns, (std::vector<std::int64_t>{50, 100, 200, 250, 300}));
}

}  // namespace
}  // namespace lio
