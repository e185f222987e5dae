// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_classifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/motion.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::StampAt;
using Finding = ImuVerdict::Finding;

constexpr double kImuStep_s = 0.01;
constexpr double kSweep_s = 0.1;

// Returns a vehicle's drive with speed changes and bends: from rest, then up to 9 m/s.
test::Motion Drive() {
  return test::WindingDrive(1.0);
}

struct DriveCase {
  test::Motion motion = Drive();
  test::Motion matched;   // motion that scan matching sees, if it is another
  ImuConvention sent_as;  // how the messages are to be read
  Vector3 g_world = test::kGravity;
  double to_s = 9.0;
  Vector3 gyro_bias{0.01, -0.008, 0.012};  // a consumer's unit
  Vector3 accel_bias{0.15, -0.1, 0.2};
  double gyro_std_radps = 0.01;
  double pose_std_m = 0.01;
  double pose_std_rad = 0.002;
  double clock_offset_s = 0.0;
  Vector3 mount_error_rad = Vector3::Zero();  // error of the rig's extrinsic
  double max_rate_radps = 100.0;              // the gyro saturates
};

ImuClassifier After(const DriveCase& setup, const ImuConvention& expected = {},
                    const Rig& rig = {}) {
  std::mt19937_64 random(3);
  ImuClassifier classifier(expected, rig);
  classifier.BeginMap(StampAt(0.0));
  for (int k = 0; k * kSweep_s <= setup.to_s; ++k) {
    const double t_s = k * kSweep_s;
    Pose pose = setup.matched ? setup.matched(t_s) : setup.motion(t_s);
    pose.translation += setup.pose_std_m * test::RandomVector<3>(random);
    pose.rotation = pose.rotation * ExpSo3(setup.pose_std_rad * test::RandomVector<3>(random));
    std::vector<ImuSample> samples;
    for (int i = -10; i <= 0; ++i) {
      ImuSample sample = test::ExactSample(
          setup.motion, t_s + i * kImuStep_s + setup.clock_offset_s, setup.g_world);
      sample.stamp = StampAt(t_s + i * kImuStep_s);
      sample.w_imu_radps += setup.gyro_bias + setup.gyro_std_radps * test::RandomVector<3>(random);
      sample.w_imu_radps =
          sample.w_imu_radps.cwiseMax(-setup.max_rate_radps).cwiseMin(setup.max_rate_radps);
      sample.f_imu_mps2 += setup.accel_bias + 0.1 * test::RandomVector<3>(random);
      const Quaternion mount = ExpSo3(setup.mount_error_rad);
      sample.w_imu_radps = mount * sample.w_imu_radps;
      sample.f_imu_mps2 = mount * sample.f_imu_mps2;
      samples.push_back(FromSi(setup.sent_as, sample));
    }
    classifier.AddPose({StampAt(t_s), pose}, samples);
  }
  return classifier;
}

ImuVerdict Classify(const DriveCase& setup, const ImuConvention& expected = {},
                    const Rig& rig = {}) {
  return After(setup, expected, rig).Judge();
}

void ExpectFound(const ImuVerdict& verdict, const ImuConvention& convention) {
  EXPECT_EQ(verdict.finding, Finding::kOtherwise) << Describe(convention);
  EXPECT_EQ(verdict.convention, convention)
      << Describe(verdict.convention) << " for " << Describe(convention);
  EXPECT_NE(verdict.evidence, "");
}

TEST(ImuClassifier, PlainMessagesAreSettledByADrive) {
  const ImuVerdict verdict = Classify({});
  EXPECT_EQ(verdict.finding, Finding::kAsExpected);
  EXPECT_EQ(verdict.convention, ImuConvention{});
  EXPECT_EQ(verdict.has_gravity, true);
}

TEST(ImuClassifier, EveryQuarterTurnIsFound) {
  for (const Matrix3& R : QuarterTurns()) {
    if (R == Matrix3::Identity()) continue;
    DriveCase setup;
    setup.sent_as.R_imu_sent = R;
    ExpectFound(Classify(setup), setup.sent_as);
  }
}

TEST(ImuClassifier, EveryUnitIsFound) {
  for (const ImuUnits units : {ImuUnits::kG, ImuUnits::kDeg, ImuUnits::kGAndDeg}) {
    DriveCase setup;
    setup.sent_as = ConventionOf(units);
    ExpectFound(Classify(setup), setup.sent_as);
  }
}

TEST(ImuClassifier, UnitsAndTurnedAxesAreFoundTogether) {
  DriveCase setup;
  setup.sent_as = {true, true, Vector3(1, -1, -1).asDiagonal()};
  ExpectFound(Classify(setup), setup.sent_as);
}

TEST(ImuClassifier, MessagesInSiAreFoundWhereOthersWereExpected) {
  for (const ImuUnits units : {ImuUnits::kG, ImuUnits::kDeg, ImuUnits::kGAndDeg}) {
    ExpectFound(Classify({}, ConventionOf(units)), ImuConvention{});
  }
}

TEST(ImuClassifier, RemovedGravityIsFoundAndAsExpected) {
  DriveCase setup;
  setup.g_world = Vector3::Zero();
  setup.accel_bias = Vector3(0.05, -0.05, 0.1);
  const ImuVerdict verdict = Classify(setup);
  EXPECT_NE(verdict.finding, Finding::kOtherwise);
  EXPECT_NE(verdict.finding, Finding::kNotExpected);
  EXPECT_EQ(verdict.has_gravity, false);
}

TEST(ImuClassifier, RestLeavesItOpen) {
  for (const ImuUnits units : {ImuUnits::kSi, ImuUnits::kDeg}) {
    DriveCase setup;
    setup.motion = [](double) { return Pose{}; };
    setup.sent_as = ConventionOf(units);
    const Finding finding = Classify(setup).finding;
    EXPECT_NE(finding, Finding::kOtherwise);
    EXPECT_NE(finding, Finding::kAsExpected);
  }
}

// Errors other than units and quarter turns must not look like them.
TEST(ImuClassifier, OrdinaryFaultsAreNotMistaken) {
  std::vector<DriveCase> setups(7);
  setups[0].gyro_bias = Vector3(0.1, -0.1, 0.1);   // 6 deg/s
  setups[0].accel_bias = Vector3(0.8, -0.6, 0.7);  // 0.08 g
  setups[1].clock_offset_s = 0.1;
  setups[2].clock_offset_s = -0.3;
  setups[3].mount_error_rad = Vector3(0.0, 0.0, 0.35);  // 20 deg
  setups[4].pose_std_m = 0.1;
  setups[4].pose_std_rad = 0.02;
  setups[5].max_rate_radps = 0.05;
  setups[6].gyro_std_radps = 0.3;  // a shaken unit
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const Finding finding = Classify(setups[i]).finding;
    EXPECT_NE(finding, Finding::kOtherwise) << i;
    EXPECT_NE(finding, Finding::kNotExpected) << i;
  }
}

TEST(ImuClassifier, TiltedAndHangingMountsAreNotMistaken) {
  for (const double roll_rad : {0.5, 1.57, 3.14159}) {
    Rig rig;  // the lidar's axis leans by so much against the vehicle's
    rig.T_imu_lidar = Pose{ExpSo3(Vector3(roll_rad, 0, 0)), Vector3(0, 0, 0.3)};
    EXPECT_EQ(Classify({}, {}, rig).finding, Finding::kAsExpected) << roll_rad;
  }
}

TEST(ImuClassifier, WorthlessPosesSayNothing) {
  DriveCase setup;
  setup.pose_std_m = 3.0;
  setup.pose_std_rad = 0.5;
  EXPECT_EQ(Classify(setup).finding, Finding::kOpen);
}

// The car goes straight ahead with 2 m/s^2 after a second of rest.
Pose DriveOff(double t_s) {
  const double since_s = std::max(0.0, t_s - 1.0);
  return {Quaternion::Identity(), Vector3(since_s * since_s, 0, 0)};
}

TEST(ImuClassifier, WrongAxesAreOutOfFavourOnceADriveHasBegun) {
  DriveCase setup;
  setup.motion = DriveOff;
  setup.to_s = 2.2;
  EXPECT_FALSE(After(setup).FavoursAnother());
  EXPECT_EQ(After(setup).Favoured(), std::nullopt);
  setup.sent_as.R_imu_sent = ExpSo3(Vector3(0, 0, M_PI / 2)).toRotationMatrix().array().round();
  EXPECT_TRUE(After(setup).FavoursAnother());
  EXPECT_EQ(After(setup).Favoured(), setup.sent_as) << "the force tells the way that it drives off";
  EXPECT_NE(Classify(setup).finding, Finding::kOtherwise) << "too little for a verdict";
}

TEST(ImuClassifier, ScansThatClingToTheRingsOfARestSpeakForNoOtherReading) {
  DriveCase setup;
  setup.motion = DriveOff;
  setup.to_s = 3.0;
  for (const double share : {0.0, 0.3}) {
    setup.matched = [share](double t_s) {
      Pose pose = DriveOff(t_s);
      pose.translation *= share;
      return pose;
    };
    EXPECT_FALSE(After(setup).FavoursAnother()) << share;
  }
}

TEST(ImuClassifier, UnitOfForcesThatIsKeptIsNotGivenUpForWhatScansDoNotSee) {
  DriveCase setup;
  setup.motion = DriveOff;
  setup.matched = [](double) { return Pose{}; };
  setup.to_s = 4.0;
  setup.sent_as.is_in_g = true;
  ImuClassifier classifier = After(setup, setup.sent_as);
  EXPECT_TRUE(classifier.FavoursAnother()) << "weaker forces would be seen less";
  classifier.KeepForceUnit();
  EXPECT_FALSE(classifier.FavoursAnother());
}

TEST(ImuClassifier, DegreesAreAbsurdInMotionOnly) {
  for (const bool moves : {false, true}) {
    ImuClassifier classifier({}, {});
    classifier.BeginMap(StampAt(0.0));
    for (int k = 0; k <= 12; ++k) {
      const double t_s = k * kSweep_s;
      ImuSample sample{StampAt(t_s), Vector3(0, 0, 1.5), Vector3(0, 0, 9.8)};  // 1.5 deg/s
      const Pose pose{Quaternion::Identity(), Vector3(moves ? 5.0 * t_s : 0.0, 0, 0)};
      classifier.AddPose({StampAt(t_s), pose}, std::vector{sample, sample});
    }
    EXPECT_EQ(classifier.IsGyroAbsurd(), moves);
  }
}

// Returns a lively turn with white noise of a standard deviation.
std::vector<ImuSample> NoisyTurn(double noise) {
  std::mt19937_64 random(5);
  std::vector<ImuSample> samples(200);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t_s = kImuStep_s * static_cast<double>(i);
    samples[i].stamp = StampAt(t_s);
    samples[i].w_imu_radps =
        Vector3(0, std::sin(12.0 * t_s), 1.0) + noise * test::RandomVector<3>(random);
  }
  return samples;
}

TEST(RateNoise, IsToldWhateverTheMotion) {
  EXPECT_LT(RateNoise(NoisyTurn(0.0)), 0.006);
  EXPECT_NEAR(RateNoise(NoisyTurn(0.3)), 0.3, 0.05);
  EXPECT_EQ(RateNoise({}), 0.0);
}

TEST(RateNoise, IsThatOfDegreesWhereTheRigSaysSo) {
  ImuRig imu;
  imu.gyro_noise_density = 5.2e-4;  // 0.0052 rad/s at 100 Hz, 0.3 deg/s
  EXPECT_TRUE(IsNoiseOfDegrees(NoisyTurn(0.3), imu));
  EXPECT_FALSE(IsNoiseOfDegrees(NoisyTurn(0.08), imu));  // shaken
  EXPECT_FALSE(IsNoiseOfDegrees(NoisyTurn(0.0052), imu));
  imu.gyro_noise_density = 2e-2;  // a poor gyro's 0.2 rad/s
  EXPECT_FALSE(IsNoiseOfDegrees(NoisyTurn(0.3), imu));
}

TEST(ForceAtRest, TellsUnitsAndGravityByItsLength) {
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, 1.0, 9.7), 9.8), ForceAtRest::kMetric);
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, -0.7, -0.72), 9.8), ForceAtRest::kInG);
  EXPECT_EQ(JudgeForceAtRest(Vector3(0.1, 0.2, 0), 9.8), ForceAtRest::kWithoutGravity);
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, 5.0, 0), 9.8), ForceAtRest::kUnclear);
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, 0, 1000.0), 9.8), ForceAtRest::kUnclear);
}

TEST(ForceAtRest, AWeakGravityIsToldToo) {
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, 0, 3.7), 3.72), ForceAtRest::kMetric);
  EXPECT_EQ(JudgeForceAtRest(Vector3(0, 0, 0.38), 3.72), ForceAtRest::kInG);
}

}  // namespace
}  // namespace lio
