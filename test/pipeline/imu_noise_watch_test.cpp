// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_noise_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::HasSubstr;

// Returns all that is said in the course of so many scans.
std::string Said(ImuNoiseWatch& watch, const ImuNoiseRatios& ratios, int num_scans) {
  std::string said;
  for (int i = 0; i < num_scans; ++i) said += watch.Add(ratios).value_or("");
  return said;
}

TEST(ImuNoiseWatch, RatiosAreThoseOfTheNoisiestAxis) {
  ImuRig rig;
  rig.gyro_noise_density = 1e-3;
  rig.accel_noise_density = 1e-2;
  ImuNoise noise;
  EXPECT_EQ(NoiseRatiosOf(noise, rig).gyro, 0.0);
  noise.gyro_psd = Vector3(1e-6, 4e-6, 1e-6);
  noise.accel_psd = Vector3(81e-4, 0.0, 1e-4);
  EXPECT_NEAR(NoiseRatiosOf(noise, rig).gyro, 2.0, 1e-9);
  EXPECT_NEAR(NoiseRatiosOf(noise, rig).accel, 9.0, 1e-9);
}

TEST(ImuNoiseWatch, DensitiesAreRaisedToTheNoisiestAxisAndNeverLowered) {
  ImuRig rig;
  rig.gyro_noise_density = 1e-3;
  rig.accel_noise_density = 1e-2;
  ImuNoise noise;
  noise.gyro_psd = Vector3(1e-6, 4e-6, 1e-6);
  noise.accel_psd = Vector3::Constant(1e-6);
  const ImuRig raised = RaisedTo(noise, rig);
  EXPECT_NEAR(raised.gyro_noise_density, 2e-3, 1e-12);
  EXPECT_EQ(raised.accel_noise_density, 1e-2);
}

TEST(ImuNoiseWatch, VibrationIsAnnouncedOnce) {
  ImuNoiseWatch watch;
  EXPECT_EQ(Said(watch, {1.0, 1.2}, 100), "");
  EXPECT_THAT(Said(watch, {1.0, 9.0}, 100),
              "the accelerometer is 9 times noisier than the rig "
              "says: vibration; the filter takes what it shows");
  EXPECT_EQ(Said(watch, {1.0, 20.0}, 100), "");
  EXPECT_THAT(Said(watch, {1.0, 28.0}, 100), HasSubstr("28 times"));
}

TEST(ImuNoiseWatch, AShortShockIsNone) {
  ImuNoiseWatch watch;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(Said(watch, {1.0, 50.0}, 15), "");
    EXPECT_EQ(Said(watch, {1.0, 1.0}, 1), "");
  }
}

TEST(ImuNoiseWatch, BothSensorsAreNamed) {
  ImuNoiseWatch watch;
  EXPECT_THAT(Said(watch, {5.0, 7.0}, 20),
              HasSubstr("accelerometer is 7 times noisier and the gyro is 5 times noisier"));
  ImuNoiseWatch other;
  EXPECT_THAT(Said(other, {4.0, 1.0}, 20), HasSubstr("the gyro is 4 times noisier than the rig"));
}

}  // namespace
}  // namespace lio
