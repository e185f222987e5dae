// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/rotation_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "calib/sensor_pair.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::kExtrinsic;
using test::kGyroBias;
using test::kOffset_s;
using test::Stand;
using test::TurnAboutZ;
using testing::HasSubstr;

constexpr double kRadPerDeg = M_PI / 180.0;

// The sensors are in the hands of a person who walks and looks around.
Pose WalkLookingAround(double t_s) {
  const Vector3 swing(0.05 * std::sin(11.3 * t_s), 0.04 * std::sin(12.1 * t_s + 1.0),
                      0.03 * std::sin(5.9 * t_s));
  const Vector3 look(0.1 * std::sin(0.9 * t_s), 0.15 * std::sin(1.3 * t_s + 0.4),
                     0.8 * std::sin(0.5 * t_s));
  return {ExpSo3(look) * ExpSo3(swing), Vector3::Zero()};
}

struct Recording {
  std::vector<ImuSample> samples;
  std::vector<SweepRotation> sweeps;
};

// Moves a sensor pair along `motion` for `span_s`, with sweeps at 10 Hz and samples at 200 Hz.
Recording Record(const test::Motion& motion, double span_s, double sweep_std_rad = 0.0,
                 double gyro_density = 0.0, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  Recording recording;
  recording.samples = test::ExactSamples(motion, 0.0, span_s, 0.005);
  for (ImuSample& sample : recording.samples) {
    sample.w_imu_radps +=
        kGyroBias + gyro_density / std::sqrt(0.005) * test::RandomVector<3>(random);
  }
  for (double t_s = 0.1; t_s < span_s - 0.1; t_s += 0.1) {
    const Quaternion R = motion(t_s + kOffset_s).rotation * kExtrinsic *
                         ExpSo3(sweep_std_rad * test::RandomVector<3>(random));
    recording.sweeps.push_back({test::StampAt(t_s), R});
  }
  return recording;
}

RotationCalibrationResult Calibrate(const Recording& recording) {
  return CalibrateRotation(recording.samples, recording.sweeps);
}

TEST(RotationCalibration, FindsOffsetRotationAndBiasOfExactTurns) {
  const RotationCalibrationResult result = Calibrate(Record(WalkLookingAround, 30.0));
  ASSERT_TRUE(result.found) << result.why_not;
  EXPECT_NEAR(result.found->offset_s, kOffset_s, 2e-5);
  EXPECT_LT(LogSo3(kExtrinsic.conjugate() * result.found->R_imu_lidar).norm(), 2e-4);
  EXPECT_LT((result.found->gyro_bias_radps - kGyroBias).norm(), 1e-5);
  EXPECT_GT(result.found->correlation, 0.99);
}

TEST(RotationCalibration, ErrorsAreWhatItsCovarianceSays) {
  constexpr int kRuns = 20;
  constexpr double kSweepStd_rad = 0.05 * kRadPerDeg;
  double offset_nees = 0.0;
  double rotation_nees = 0.0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const RotationCalibrationResult result =
        Calibrate(Record(WalkLookingAround, 30.0, kSweepStd_rad, 2e-4, seed));
    ASSERT_TRUE(result.found) << result.why_not;
    const RotationCalibration& found = *result.found;
    EXPECT_NEAR(found.sweep_std_rad, kSweepStd_rad, 0.2 * kSweepStd_rad);
    const double error_s = found.offset_s - kOffset_s;
    offset_nees += error_s * error_s / (found.offset_std_s * found.offset_std_s) / kRuns;
    const Vector3 error = LogSo3(found.R_imu_lidar.conjugate() * kExtrinsic);
    rotation_nees += error.dot(found.rotation_cov.ldlt().solve(error)) / 3 / kRuns;
  }
  // The interval holds 99.7 % of a mean of chi-square: 1 +- 3 sqrt(2 / degrees of freedom).
  EXPECT_NEAR(offset_nees, 1.0, 3 * std::sqrt(2.0 / kRuns));
  EXPECT_NEAR(rotation_nees, 1.0, 3 * std::sqrt(2.0 / (3 * kRuns)));
}

TEST(RotationCalibration, HolesInBothStreamsAreLeftOut) {
  Recording recording = Record(WalkLookingAround, 30.0);
  recording.sweeps.erase(recording.sweeps.begin() + 100, recording.sweeps.begin() + 107);
  recording.samples.erase(recording.samples.begin() + 4000, recording.samples.begin() + 4100);
  const RotationCalibrationResult result = Calibrate(recording);
  ASSERT_TRUE(result.found) << result.why_not;
  EXPECT_NEAR(result.found->offset_s, kOffset_s, 2e-5);
  EXPECT_LT(result.found->num_turns, static_cast<int>(recording.sweeps.size()) - 5);
}

TEST(RotationCalibration, RefusesToCalibrateWhatStandsStill) {
  const RotationCalibrationResult result = Calibrate(Record(Stand, 20.0, 1e-3, 2e-4));
  EXPECT_FALSE(result.found);
  EXPECT_THAT(result.why_not, HasSubstr("too little motion"));
}

TEST(RotationCalibration, RefusesTurnsAboutOneAxisAlone) {
  for (const double sweep_std_rad : {0.0, 1e-3}) {
    const RotationCalibrationResult result =
        Calibrate(Record(TurnAboutZ, 20.0, sweep_std_rad, 2e-4));
    EXPECT_FALSE(result.is_sure());
    EXPECT_THAT(result.why_not, HasSubstr("too little motion"));
  }
}

TEST(RotationCalibration, RefusesStreamsThatDoNotBelongTogether) {
  Recording recording = Record(WalkLookingAround, 20.0);
  recording.samples = test::ExactSamples(TurnAboutZ, 0.0, 20.0, 0.005);
  const RotationCalibrationResult result = Calibrate(recording);
  EXPECT_FALSE(result.found);
  EXPECT_THAT(result.why_not, HasSubstr("do not agree"));
}

TEST(RotationCalibration, RefusesAnOffsetBeyondTheSearch) {
  Recording recording = Record(WalkLookingAround, 20.0);
  for (SweepRotation& sweep : recording.sweeps) sweep.stamp = sweep.stamp + Duration{700'000'000};
  EXPECT_FALSE(Calibrate(recording).is_sure());
  RotationCalibrationOptions options;
  options.max_offset_s = 1.0;
  const RotationCalibrationResult result =
      CalibrateRotation(recording.samples, recording.sweeps, options);
  ASSERT_TRUE(result.found) << result.why_not;
  EXPECT_NEAR(result.found->offset_s, kOffset_s - 0.7, 2e-5);
}

TEST(RotationCalibration, SaysHowLittleThereIsOfAnEmptyRecording) {
  const RotationCalibrationResult result = CalibrateRotation({}, {});
  EXPECT_FALSE(result.found);
  EXPECT_THAT(result.why_not, HasSubstr("only 0 turns"));
}

}  // namespace
}  // namespace lio
