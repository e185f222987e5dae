// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/saturation_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

// A body swings about every axis; its samples saturate at the ends of the ranges.
ImuSample Swinging(int k, double max_rate = 1e9, double max_force = 1e9) {
  const double t_s = 0.01 * k;
  ImuSample sample;
  sample.w_imu_radps =
      Vector3(0.3 * std::sin(7.0 * t_s), 0.2 * std::cos(9.0 * t_s), 2.0 * std::sin(2.0 * t_s));
  sample.f_imu_mps2 =
      Vector3(std::sin(11.0 * t_s), std::cos(13.0 * t_s), 9.8 + 15.0 * std::sin(6.0 * t_s));
  sample.w_imu_radps = sample.w_imu_radps.cwiseMin(max_rate).cwiseMax(-max_rate);
  sample.f_imu_mps2 = sample.f_imu_mps2.cwiseMin(max_force).cwiseMax(-max_force);
  return sample;
}

struct Marks {
  int num_rate = 0;
  int num_force = 0;
};

template <class SampleAt>
Marks MarksOf(int num_samples, const SampleAt& sample_at) {
  SaturationDetector watch;
  Marks marks;
  for (int k = 0; k < num_samples; ++k) {
    ImuSample sample = sample_at(k);
    watch.Mark(sample);
    marks.num_rate += sample.is_rate_saturated ? 1 : 0;
    marks.num_force += sample.is_force_saturated ? 1 : 0;
  }
  return marks;
}

TEST(SaturationDetector, WhatGoesOnChangingIsNotClipped) {
  const Marks marks = MarksOf(1000, [](int k) { return Swinging(k); });
  EXPECT_EQ(marks.num_rate, 0);
  EXPECT_EQ(marks.num_force, 0);
}

// |2 sin| is above 1 two thirds of the time, 9.8 + 15 sin above 19.6 for 27 % of it.
TEST(SaturationDetector, AnAxisAtTheEndOfItsRangeIsMarked) {
  const Marks of_rate = MarksOf(1000, [](int k) { return Swinging(k, 1.0); });
  EXPECT_NEAR(of_rate.num_rate, 650, 50);
  EXPECT_EQ(of_rate.num_force, 0);
  const Marks of_force = MarksOf(1000, [](int k) { return Swinging(k, 1e9, 19.6); });
  EXPECT_EQ(of_force.num_rate, 0);
  EXPECT_NEAR(of_force.num_force, 230, 50);
}

TEST(SaturationDetector, ADriverThatRepeatsItselfIsNotClipped) {
  const Marks marks = MarksOf(1000, [](int k) { return Swinging(k / 10); });
  EXPECT_EQ(marks.num_rate, 0);
  EXPECT_EQ(marks.num_force, 0);
}

// A vehicle in the plane, simulated without noise, has axes that measure exactly zero, or gravity,
// for ever.
TEST(SaturationDetector, AnAxisWithNothingToReadIsNotClipped) {
  const Marks marks = MarksOf(1000, [](int k) {
    ImuSample sample = Swinging(k);
    sample.w_imu_radps.head<2>().setZero();
    sample.f_imu_mps2.z() = 9.81;
    return sample;
  });
  EXPECT_EQ(marks.num_rate, 0);
  EXPECT_EQ(marks.num_force, 0);
}

// The units are deg/s and g.
TEST(SaturationDetector, LimitsAreThoseOfTheUnits) {
  SaturationDetector watch;
  int num_rate = 0;
  int num_force = 0;
  for (int k = 0; k < 1000; ++k) {
    ImuSample sample = Swinging(k, 1e9, 19.6);
    sample.f_imu_mps2 /= 9.80665;
    sample.w_imu_radps *= 180.0 / M_PI;
    sample.w_imu_radps.x() = 0.5;  // a coarse gyro at rest
    watch.Mark(sample, M_PI / 180.0, 9.80665);
    num_rate += sample.is_rate_saturated ? 1 : 0;
    num_force += sample.is_force_saturated ? 1 : 0;
  }
  EXPECT_EQ(num_rate, 0);
  EXPECT_NEAR(num_force, 230, 50);
}

}  // namespace
}  // namespace lio
