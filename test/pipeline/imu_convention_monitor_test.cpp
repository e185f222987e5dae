// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_convention_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/watched_imu.hpp"

namespace lio {
namespace {

using test::StampAt;
using FindingKind = ImuConventionMonitor::Finding::Kind;

// The imu's x axis points to the left.
const ImuConvention kTurned{false, false,
                            ExpSo3(Vector3(0, 0, M_PI / 2)).toRotationMatrix().array().round()};

// The body drives off from rest straight ahead with 2 m/s^2.
Pose DriveOff(double t_s) {
  return {Quaternion::Identity(), Vector3(t_s * t_s, 0, 0)};
}

// Samples of a gyro in deg/s, at rest: white noise of 0.3 in the unit in which they are sent.
std::vector<ImuSample> NoiseOfDegrees() {
  std::vector<ImuSample> samples(100);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].stamp = StampAt(0.01 * static_cast<double>(i));
    samples[i].w_imu_radps.z() = i % 2 == 0 ? 0.3 : -0.3;
  }
  return samples;
}

TEST(ImuConventionMonitor, APlainDriveSettlesIt) {
  Watched drive(kSi);
  drive.AddSteps(kManySteps);
  EXPECT_EQ(drive.Judge().kind, FindingKind::kNone);
  EXPECT_TRUE(drive.monitor.trusts_gyro());
  // Once settled nothing is doubted any more, whatever speaks against it.
  EXPECT_EQ(drive.monitor.JudgeInitializing({8, 0, {}}, true).kind, FindingKind::kNone);
  EXPECT_TRUE(drive.monitor.trusts_gyro());
}

TEST(ImuConventionMonitor, AStandstillSettlesNothing) {
  Watched rest(kSi, [](double) { return Pose{}; });
  rest.AddSteps(kManySteps);
  EXPECT_EQ(rest.Judge().kind, FindingKind::kNone);
  EXPECT_EQ(rest.monitor.JudgeInitializing({8, 0, {}}, false).kind, FindingKind::kMisleadingGyro);
}

TEST(ImuConventionMonitor, ForcesInGAreFoundAtOnce) {
  Watched drive(kG);
  drive.AddSteps(kManySteps);
  const ImuConventionMonitor::Finding finding = drive.Judge();
  EXPECT_EQ(finding.kind, FindingKind::kOtherwise);
  EXPECT_EQ(finding.convention, kG);
  EXPECT_NE(finding.evidence, "");
  EXPECT_TRUE(drive.monitor.trusts_gyro()) << "its rates are right";
}

// A track that was led by wrong rates is no evidence: what they are is judged by the next one.
TEST(ImuConventionMonitor, OtherRatesAreMisleadingFirstAndFoundByATrackWithoutThem) {
  for (const ImuConvention& sent_as : {kDeg, kTurned}) {
    Watched drive(sent_as);
    drive.AddSteps(kManySteps);
    EXPECT_EQ(drive.Judge().kind, FindingKind::kMisleadingGyro);
    EXPECT_FALSE(drive.monitor.trusts_gyro());
    EXPECT_EQ(drive.Judge().kind, FindingKind::kNone) << "no evidence is left";
    drive.AddSteps(kManySteps);
    const ImuConventionMonitor::Finding finding = drive.Judge();
    EXPECT_EQ(finding.kind, FindingKind::kOtherwise);
    EXPECT_EQ(finding.convention, sent_as) << Describe(finding.convention);
  }
}

TEST(ImuConventionMonitor, TheConventionThatWasFoundIsSettledByMoreOfTheDrive) {
  Watched drive(kDeg);
  drive.Believe(kDeg);
  drive.AddSteps(kManySteps);
  EXPECT_EQ(drive.Judge().kind, FindingKind::kNone);
  EXPECT_EQ(drive.monitor.JudgeInitializing({8, 0, {}}, true).kind, FindingKind::kNone)
      << "settled";
}

TEST(ImuConventionMonitor, AnotherMapIsNoMotion) {
  for (const bool is_told : {false, true}) {
    Watched drive(kSi);
    drive.AddSteps(kManySteps / 2);
    drive.T_map_world = {ExpSo3(Vector3(0, 0, 1.0)), Vector3(100, 50, 0)};
    if (is_told) drive.monitor.BeginMap(drive.now());
    drive.AddSteps(kManySteps / 2);
    (void)drive.Judge();
    const bool is_settled =
        drive.monitor.JudgeInitializing({8, 0, {}}, false).kind == FindingKind::kNone &&
        drive.monitor.trusts_gyro();
    EXPECT_EQ(is_settled, is_told);
  }
}

TEST(ImuConventionMonitor, AGyroByWhichFewScansAreMatchedMisleads) {
  const auto kind_of = [](const ImuConventionMonitor::TrackFacts& facts) {
    return Watched(kSi).monitor.JudgeInitializing(facts, false).kind;
  };
  EXPECT_EQ(kind_of({8, 3, {}}), FindingKind::kMisleadingGyro);
  EXPECT_EQ(kind_of({8, 4, {}}), FindingKind::kNone);
  EXPECT_EQ(kind_of({7, 0, {}}), FindingKind::kNone) << "too few to tell";
}

TEST(ImuConventionMonitor, AGyroMisleadsOnce) {
  Watched drive(kSi);
  EXPECT_EQ(drive.monitor.JudgeInitializing({8, 0, {}}, false).kind, FindingKind::kMisleadingGyro);
  EXPECT_EQ(drive.monitor.JudgeInitializing({8, 0, {}}, false).kind, FindingKind::kNone);
  drive.monitor.TrustGyro(true);
  EXPECT_EQ(drive.monitor.JudgeInitializing({8, 0, {}}, false).kind, FindingKind::kMisleadingGyro);
}

TEST(ImuConventionMonitor, NoiseThatOnlyFitsDegreesMisleads) {
  const std::vector<ImuSample> noise = NoiseOfDegrees();
  Watched drive(kSi);
  drive.rig.imu.gyro_noise_density = 5.2e-4;
  EXPECT_TRUE(drive.monitor.MayBeDegrees(noise));
  EXPECT_EQ(drive.monitor.JudgeInitializing({1, 1, noise}, false).kind,
            FindingKind::kMisleadingGyro);
}

TEST(ImuConventionMonitor, NoiseSaysNothingWhereUnitsAreKnownOrDegreesAreBelieved) {
  const std::vector<ImuSample> noise = NoiseOfDegrees();
  Watched drive(kSi);
  drive.rig.imu.gyro_noise_density = 5.2e-4;
  drive.rig.imu.units = ImuUnits::kSi;
  EXPECT_FALSE(drive.monitor.MayBeDegrees(noise));
  drive.rig.imu.units = ImuUnits::kAutomatic;
  drive.imu.SetConvention(kDeg);
  EXPECT_FALSE(drive.monitor.MayBeDegrees(noise));
}

TEST(ImuConventionMonitor, TrackingIsContradictedByRatesInDegreesEveryFivePosesAtMost) {
  Watched drive(kDeg);
  int num_steps = 0;
  bool is_contradicted = false;
  while (!is_contradicted && num_steps < kManySteps) {
    drive.AddStep();
    ++num_steps;
    is_contradicted = drive.monitor.IsContradicted(drive.Facts());
  }
  EXPECT_TRUE(is_contradicted);
  EXPECT_EQ(num_steps % 5, 0);
  EXPECT_FALSE(drive.monitor.trusts_gyro());
}

TEST(ImuConventionMonitor, TrackingIsContradictedByOtherUnitsOfForce) {
  Watched drive(kG);
  drive.AddSteps(kManySteps);
  EXPECT_TRUE(drive.monitor.IsContradicted(drive.Facts()));
}

TEST(ImuConventionMonitor, TrackingAPlainDriveIsNotContradicted) {
  Watched drive(kSi);
  for (int i = 0; i < 30; ++i) {
    drive.AddStep();
    EXPECT_FALSE(drive.monitor.IsContradicted(drive.Facts(5))) << i;
  }
  EXPECT_TRUE(drive.monitor.trusts_gyro());
}

// Rates of 1.2 rad/s for as long as nothing is matched are another unit's.
TEST(ImuConventionMonitor, AWildGyroContradictsWhereNothingIsMatched) {
  const auto is_contradicted = [](double rate_radps, int num_unmatched, double bias_radps) {
    Watched drive(kSi);
    std::vector<ImuReady> ready;
    for (int i = 0; i < 100; ++i) {
      const ImuSample sample{StampAt(0.01 * i), Vector3(0, 0, rate_radps), Vector3(0, 0, 9.8)};
      (void)drive.imu.Add(sample, ready);
    }
    return drive.monitor.IsContradicted(
        {StampAt(0.99), num_unmatched, 0, Vector3(0, 0, bias_radps)});
  };
  EXPECT_TRUE(is_contradicted(1.2, 5, 0.0));
  EXPECT_FALSE(is_contradicted(1.2, 4, 0.0));
  EXPECT_FALSE(is_contradicted(0.9, 5, 0.0));
  EXPECT_FALSE(is_contradicted(1.2, 5, 0.3)) << "less the bias";
}

// A gyro at the end of its range reads much, rightly, and the scans are lost because it misses
// more.
TEST(ImuConventionMonitor, ASaturatedGyroIsNotWild) {
  Watched drive(kSi);
  std::vector<ImuReady> ready;
  for (int i = 0; i < 100; ++i) {
    ImuSample sample{StampAt(0.01 * i), Vector3(0, 0, 3.0), Vector3(0, 0, 9.8)};
    sample.is_rate_saturated = i > 90;
    (void)drive.imu.Add(sample, ready);
  }
  EXPECT_FALSE(drive.monitor.IsContradicted({StampAt(0.99), 5, 0, Vector3::Zero()}));
}

// Turned axes, too little of a drive for a verdict, but two of five scans were gated.
TEST(ImuConventionMonitor, GatedScansRaiseADoubtWhereAnotherConventionFitsBetter) {
  for (const bool is_right : {false, true}) {
    Watched drive(is_right ? kSi : kTurned, DriveOff);
    drive.AddSteps(14);
    EXPECT_FALSE(drive.monitor.IsContradicted(drive.Facts(1))) << "one gated scan is none";
    EXPECT_EQ(drive.monitor.IsContradicted(drive.Facts(2)), !is_right);
  }
}

TEST(ImuConventionMonitor, ADoubtCountsOnce) {
  Watched drive(kTurned, DriveOff);
  drive.AddSteps(14);
  EXPECT_EQ(drive.monitor.Suspected(), std::nullopt);
  ASSERT_TRUE(drive.monitor.IsContradicted(drive.Facts(2)));
  EXPECT_EQ(drive.monitor.Suspected(), kTurned);
  EXPECT_FALSE(drive.monitor.IsContradicted(drive.Facts(2)));
  drive.monitor.ForgetDoubt();
  EXPECT_EQ(drive.monitor.Suspected(), std::nullopt);
  EXPECT_TRUE(drive.monitor.IsContradicted(drive.Facts(2)));
}

TEST(ImuConventionMonitor, ADoubtHoldsTheStartUpForTenSecondsAtMost) {
  Watched drive(kTurned, DriveOff);
  drive.AddSteps(14);
  EXPECT_FALSE(drive.monitor.IsInDoubt(StampAt(1.0), StampAt(2.0)));
  ASSERT_TRUE(drive.monitor.IsContradicted(drive.Facts(2)));
  EXPECT_TRUE(drive.monitor.IsInDoubt(StampAt(1.0), StampAt(10.9)));
  EXPECT_FALSE(drive.monitor.IsInDoubt(StampAt(1.0), StampAt(11.0)));
  drive.monitor.ForgetDoubt();
  EXPECT_FALSE(drive.monitor.IsInDoubt(StampAt(1.0), StampAt(2.0)));
}

// Scans that cling to the rings of a rest see no forces: smaller ones would fit them better.
TEST(ImuConventionMonitor, AUnitOfForceToldAtRestIsKeptAgainstMotion) {
  for (const bool is_kept : {false, true}) {
    Watched drive(kG, [](double t_s) { return DriveOff(std::max(0.0, t_s - 1.0)); });
    drive.matched = [](double) { return Pose{}; };
    drive.imu.SetConvention(kG);
    drive.monitor.Restart();
    if (is_kept) {
      drive.monitor.KeepForceUnit();
      drive.monitor.Restart();  // it is known beyond that
    }
    drive.AddSteps(40);
    EXPECT_EQ(drive.monitor.IsContradicted(drive.Facts(2)), !is_kept);
  }
}

}  // namespace
}  // namespace lio
