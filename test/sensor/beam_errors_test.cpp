// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sensor/beam_errors.hpp"

#include <gtest/gtest.h>

#include "lio/base/rotation.hpp"

namespace lio {
namespace {

Vector3 PointAt(double range_m, double elevation_rad, double azimuth_rad) {
  return range_m * Vector3(std::cos(elevation_rad) * std::cos(azimuth_rad),
                           std::cos(elevation_rad) * std::sin(azimuth_rad),
                           std::sin(elevation_rad));
}

Eigen::Vector3f Slope(const Vector3& before, const Vector3& after, double step) {
  return Vector3((after - before) / (2.0 * step)).cast<float>();
}

TEST(BeamErrors, TheAxesAreTheNumericDerivativesOfAPoint) {
  constexpr double kStep = 1e-5;
  for (const double elevation_rad : {-0.5, 0.0, 0.3}) {
    for (const double azimuth_rad : {-3.0, -1.0, 0.0, 2.0}) {
      const auto at = [&](double range, double elevation, double azimuth) {
        return PointAt(17.0 + range, elevation_rad + elevation, azimuth_rad + azimuth);
      };
      const BeamAxes axes = AxesOf(at(0, 0, 0).cast<float>());
      EXPECT_TRUE(axes.range.isApprox(Slope(at(-kStep, 0, 0), at(kStep, 0, 0), kStep), 1e-5f));
      EXPECT_TRUE(axes.elevation.isApprox(Slope(at(0, -kStep, 0), at(0, kStep, 0), kStep), 1e-5f));
      EXPECT_TRUE(axes.azimuth.isApprox(Slope(at(0, 0, -kStep), at(0, 0, kStep), kStep), 1e-5f));
      EXPECT_NEAR(axes.cos_azimuth, std::cos(azimuth_rad), 1e-6);
      EXPECT_NEAR(axes.sin_azimuth, std::sin(azimuth_rad), 1e-6);
    }
  }
}

TEST(BeamErrors, APointOnTheAxisHasAxesWithoutNaN) {
  for (const float z_m : {-2.f, 0.f, 3.f}) {
    const BeamAxes axes = AxesOf({0.f, 0.f, z_m});
    EXPECT_TRUE(axes.range.allFinite() && axes.elevation.allFinite() && axes.azimuth.allFinite());
  }
}

TEST(BeamErrors, APointMovesByTheSumOfItsRingsAndTheEncodersErrors) {
  BeamErrors errors;
  errors.rings = {{}, {.range_m = 0.02f, .elevation_rad = 1e-3f, .azimuth_rad = -2e-3f}};
  errors.encoder_rad = {3e-3f, 4e-3f};
  const BeamAxes axes = AxesOf(PointAt(10.0, 0.1, 0.7).cast<float>());
  const auto encoder_rad = static_cast<float>(3e-3 * std::cos(0.7) + 4e-3 * std::sin(0.7));
  const Eigen::Vector3f expected =
      0.02f * axes.range + 1e-3f * axes.elevation + (encoder_rad - 2e-3f) * axes.azimuth;
  EXPECT_TRUE(Displacement(errors, 1, axes).isApprox(expected, 1e-5f));
}

TEST(BeamErrors, ARingThatNothingIsKnownOfHasTheEncodersErrorAlone) {
  BeamErrors errors;
  errors.rings = {{.range_m = 0.02f}};
  errors.encoder_rad = {3e-3f, 0.f};
  const BeamAxes axes = AxesOf({10.f, 0.f, 0.f});
  EXPECT_TRUE(Displacement(errors, 7, axes).isApprox(3e-3f * axes.azimuth, 1e-5f));
}

TEST(BeamErrors, TurnedAxesAreThoseOfATurnedSensor) {
  const Eigen::Matrix3f rotation = ExpSo3(Vector3(0.1, -0.2, 0.9)).toRotationMatrix().cast<float>();
  BeamErrors errors;
  errors.rings = {{.range_m = 0.02f, .elevation_rad = 1e-3f, .azimuth_rad = -2e-3f}};
  const BeamAxes axes = AxesOf({5.f, -3.f, 1.f});
  EXPECT_TRUE(Displacement(errors, 0, Turned(axes, rotation))
                  .isApprox(rotation * Displacement(errors, 0, axes), 1e-5f));
}

}  // namespace
}  // namespace lio
