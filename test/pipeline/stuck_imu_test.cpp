// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/stuck_imu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lio {
namespace {

// Samples at 100 Hz with noise of one unit a value, rounded to `digit`.
class Unit {
 public:
  explicit Unit(double digit) : digit_(digit) {}

  ImuSample Next() {
    ImuSample sample;
    sample.stamp = Timestamp{} + Duration::FromSeconds(0.01 * num_++);
    for (Vector3* triad : {&sample.w_imu_radps, &sample.f_imu_mps2}) {
      for (double& value : *triad) value = digit_ * std::round(noise_(random_) / digit_);
    }
    return sample;
  }

 private:
  double digit_;
  int num_ = 0;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> noise_;
};

struct Bench {
  explicit Bench(double digit = 1e-6) : unit(digit) {}
  // `spoil` changes each of so many samples.
  template <class Spoil>
  void Add(int num, const Spoil& spoil) {
    for (int i = 0; i < num; ++i) {
      samples.push_back(unit.Next());
      spoil(samples.back());
    }
    detector.Add(samples, samples.back().stamp);
  }
  void Add(int num) {
    Add(num, [](ImuSample&) {});
  }

  Unit unit;
  std::deque<ImuSample> samples;
  StuckImuDetector detector;
};

constexpr int kLearned = kStuckImu.min_changes;

TEST(StuckImu, AnAxisThatStopsAfterTheClockWasSetBackHasStopped) {
  Bench b;
  b.Add(kLearned);
  b.samples.clear();
  const auto set_back = [](ImuSample& sample) {
    sample.stamp = sample.stamp - Duration::FromSeconds(3600.0);
    sample.w_imu_radps.x() = 0.25;
  };
  b.Add(kStuckImu.min_samples + 1, set_back);
  ASSERT_TRUE(b.detector.found());
  EXPECT_EQ(b.detector.found()->sensor, ImuSensor::kGyro);
}

TEST(StuckImu, AnAxisThatReadsTheSameFiveTimesHasStopped) {
  for (const int axis : {0, 1, 2}) {
    for (const auto sensor : {ImuSensor::kGyro, ImuSensor::kAccelerometer}) {
      Bench b;
      b.Add(kLearned);
      const ImuSample last = b.samples.back();
      const auto stop = [&](ImuSample& sample) {
        (sensor == ImuSensor::kGyro ? sample.w_imu_radps : sample.f_imu_mps2)[axis] = 0.5;
      };
      b.Add(kStuckImu.min_samples - 1, stop);
      EXPECT_FALSE(b.detector.found());
      b.Add(1, stop);
      const auto found = b.detector.found();
      ASSERT_TRUE(found);
      EXPECT_EQ(found->sensor, sensor);
      EXPECT_EQ(found->axis_imu, Vector3::Unit(axis));
      EXPECT_EQ(found->before.stamp, last.stamp);
      EXPECT_EQ(found->before.w_imu_radps, last.w_imu_radps);
    }
  }
}

TEST(StuckImu, AnAxisThatChangesAgainIsNotStuck) {
  Bench b;
  b.Add(kLearned);
  b.Add(100, [](ImuSample& sample) { sample.w_imu_radps.setZero(); });
  EXPECT_TRUE(b.detector.found());
  b.Add(1);
  EXPECT_FALSE(b.detector.found());
  // The long row has taught nothing of how the sensor is while it works.
  b.Add(kStuckImu.min_samples, [](ImuSample& sample) { sample.w_imu_radps.setZero(); });
  EXPECT_TRUE(b.detector.found());
}

// The noise is half of the last digit: two readings in three are zero.
TEST(StuckImu, ACoarseSensorIsNotStuck) {
  Bench b(2.0);
  for (int i = 0; i < 20'000; ++i) {
    b.Add(1);
    ASSERT_FALSE(b.detector.found()) << i;
  }
  b.Add(1000, [](ImuSample& sample) { sample.f_imu_mps2.setZero(); });
  EXPECT_TRUE(b.detector.found());
}

TEST(StuckImu, ADriverThatRepeatsItsSamplesIsNotStuck) {
  Bench b;
  ImuSample repeated;
  for (int i = 0; i < 1000; ++i) {
    b.Add(1, [&](ImuSample& sample) {
      const Timestamp stamp = sample.stamp;
      if (i % 4 == 0) repeated = sample;
      sample = repeated;
      sample.stamp = stamp;
    });
    ASSERT_FALSE(b.detector.found()) << i;
  }
}

TEST(StuckImu, AnAxisAtTheEndOfItsRangeIsNotStuck) {
  Bench b;
  b.Add(kLearned);
  b.Add(50, [](ImuSample& sample) {
    sample.w_imu_radps.x() = 5.0;
    sample.is_rate_saturated = true;
  });
  EXPECT_FALSE(b.detector.found());
}

TEST(StuckImu, SamplesThatWereMadeUpTellNothing) {
  Bench b;
  b.Add(kLearned);
  b.Add(50, [](ImuSample& sample) {
    sample.w_imu_radps.setZero();
    sample.made_up_w_std_radps = 0.1f;
  });
  EXPECT_FALSE(b.detector.found());
}

TEST(StuckImu, AnAxisThatHasHardlyChangedTellsNothing) {
  Bench b;
  b.Add(kLearned / 2);
  b.Add(1000, [](ImuSample& sample) { sample.w_imu_radps.setZero(); });
  EXPECT_FALSE(b.detector.found());
}

TEST(StuckImu, NothingLaterThanTheGivenTimeCounts) {
  Bench b;
  b.Add(kLearned);
  const Timestamp until = b.samples.back().stamp;
  for (int i = 0; i < 50; ++i) {
    b.samples.push_back(b.unit.Next());
    b.samples.back().w_imu_radps.setZero();
  }
  b.detector.Add(b.samples, until);
  EXPECT_FALSE(b.detector.found());
  b.detector.Add(b.samples, b.samples.back().stamp);
  EXPECT_TRUE(b.detector.found());
}

}  // namespace
}  // namespace lio
