// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/gravity_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/mode_bench.hpp"
#include "support/motion.hpp"

namespace lio {
namespace {

using test::ExactSample;
using test::StampAt;

constexpr double kSpan_s = 1.0;
const Vector3 kGravity(0, 0, -test::kStandardGravity_mps2);

// Holds a body that turns about its z axis and accelerates along world's x.
struct Body {
  double accel_mps2 = 0.0;

  Pose operator()(double t_s) const {
    return {ExpSo3(Vector3(0, 0, 2.0 * t_s)), Vector3(0.5 * accel_mps2 * t_s * t_s, 0, 0)};
  }
  std::vector<ImuSample> Samples() const {
    std::vector<ImuSample> samples;
    for (double t_s = 0.0; t_s < kSpan_s + 0.005; t_s += 0.01) {
      samples.push_back(ExactSample(*this, t_s));
    }
    return samples;
  }
  Estimate At(double t_s, double tilt_rad, double velocity_std_mps) const {
    Estimate estimate;
    estimate.stamp = StampAt(t_s);
    estimate.state.T_world_imu.rotation = (*this)(t_s).rotation * ExpSo3(Vector3(0, tilt_rad, 0));
    estimate.state.v_world_imu = Vector3(accel_mps2 * t_s, 0, 0);
    estimate.cov.diagonal().segment<3>(kVel).setConstant(velocity_std_mps * velocity_std_mps);
    return estimate;
  }
  // Does gravity contradict the attitude that is off by this tilt?
  bool Contradicts(double tilt_rad, double velocity_std_mps = 0.0) const {
    return GravityContradicts(Samples(), At(0.0, tilt_rad, velocity_std_mps),
                              At(kSpan_s, tilt_rad, velocity_std_mps), kGravity, {});
  }
};

// A tilt turns gravity by this share of itself.
double TiltOf(double off_ratio) {
  return 2.0 * std::asin(0.5 * off_ratio);
}

TEST(GravityCheck, ATiltBeyondTheLimitIsContradicted) {
  const double limit_rad = TiltOf(kGravityCheck.max_off_ratio);
  EXPECT_FALSE(Body{}.Contradicts(0.98 * limit_rad));
  EXPECT_TRUE(Body{}.Contradicts(1.02 * limit_rad));
  EXPECT_TRUE(Body{}.Contradicts(3.0));
}

TEST(GravityCheck, ABodyThatAcceleratesHardIsBelieved) {
  EXPECT_FALSE(Body{15.0}.Contradicts(0.0));
  EXPECT_TRUE(Body{15.0}.Contradicts(1.0));
}

TEST(GravityCheck, AnUnsureVelocityContradictsLess) {
  const double tilt_rad = 1.1 * TiltOf(kGravityCheck.max_off_ratio);
  EXPECT_TRUE(Body{}.Contradicts(tilt_rad, 0.01));
  EXPECT_FALSE(Body{}.Contradicts(tilt_rad, 0.5));
}

TEST(GravityCheck, BiasesAreTakenOff) {
  const Body body;
  std::vector<ImuSample> samples = body.Samples();
  const Biases biases{Vector3(0.1, 0, 0), Vector3(5.0, 0, 0)};
  for (ImuSample& sample : samples) {
    sample.w_imu_radps += biases.gyro;
    sample.f_imu_mps2 += biases.accel;
  }
  const Estimate from = body.At(0.0, 0.0, 0.0);
  const Estimate to = body.At(kSpan_s, 0.0, 0.0);
  EXPECT_FALSE(GravityContradicts(samples, from, to, kGravity, biases));
  EXPECT_TRUE(GravityContradicts(samples, from, to, kGravity, {}));
}

TEST(GravityCheck, WithoutSamplesNothingIsContradicted) {
  const Body body;
  EXPECT_FALSE(
      GravityContradicts({}, body.At(0.0, 3.0, 0.0), body.At(kSpan_s, 3.0, 0.0), kGravity, {}));
}

}  // namespace
}  // namespace lio
