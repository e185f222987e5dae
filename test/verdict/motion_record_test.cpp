// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/motion_record.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio::test {
namespace {

MotionRecord TwoPoses(double apart_s, std::vector<ImuSample> samples) {
  MotionRecord record;
  const Motion motion = Tumble();
  record.Add({StampAt(1.0), motion(1.0)}, Duration{}, samples);
  record.Add({StampAt(1.0 + apart_s), motion(1.0 + apart_s)}, Duration{}, samples);
  return record;
}

std::vector<ImuSample> Samples() {
  return ExactSamples(Tumble(), 0.9, 1.6, 0.005);
}

TEST(MotionRecord, StepHasTheTurnOfTheGyro) {
  const MotionRecord record = TwoPoses(0.1, Samples());
  ASSERT_EQ(record.steps().size(), 1U);
  const MotionStep& step = record.steps().front();
  const Vector3 turn = LogSo3(step.from.pose.rotation.conjugate() * step.to.pose.rotation);
  EXPECT_LT((step.turn_rad - turn).norm(), 1e-5);
  EXPECT_NEAR(step.span_s(), 0.1, 1e-9);
}

TEST(MotionRecord, StepHasWhatTheForcesAddToVelocity) {
  const MotionStep step = TwoPoses(0.1, Samples()).steps().front();
  const Motion motion = Tumble();
  const Vector3 gained = StateOf(motion, 1.1).v_world_imu - StateOf(motion, 1.0).v_world_imu;
  const Quaternion middle = motion(1.05).rotation;
  EXPECT_LT((middle * step.velocity_mps + 0.1 * kGravity - gained).norm(), 1e-3);
}

TEST(MotionRecord, PosesAreThoseOfTheOtherImuFromThereOn) {
  const Pose T_old_new{ExpSo3(Vector3(0.0, 0.0, 0.1)), Vector3(0.3, 0.0, 0.0)};
  MotionRecord record = TwoPoses(0.1, Samples());
  record.SetImu(T_old_new);
  const Motion motion = Tumble();
  record.Add({StampAt(1.2), motion(1.2) * T_old_new}, Duration{}, Samples());
  ASSERT_EQ(record.steps().size(), 2U);
  for (const MotionStep& step : record.steps()) {
    const Pose expected = motion(test::SecondsOf(step.from.stamp)) * T_old_new;
    EXPECT_LT(LogSe3(expected.Inverse() * step.from.pose).norm(), 1e-9);
  }
  EXPECT_EQ(record.steps()[1].from.pose.translation, record.steps()[0].to.pose.translation);
}

TEST(MotionRecord, SparseSamplesTellNothingOfTheClockOffset) {
  const MotionRecord record = TwoPoses(0.1, ExactSamples(Tumble(), 0.9, 1.6, 0.05));
  ASSERT_EQ(record.steps().size(), 1U);
  EXPECT_EQ(record.steps().front().rate_gain_radps, Vector3::Zero());
  EXPECT_EQ(record.steps().front().jerk_mps3, Vector3::Zero());
  EXPECT_GT(TwoPoses(0.1, Samples()).steps().front().rate_gain_radps.norm(), 0.0);
}

TEST(MotionRecord, LongGapIsNoStep) {
  EXPECT_TRUE(TwoPoses(0.5, Samples()).steps().empty());
}

TEST(MotionRecord, SaturatedSamplesAreNoStep) {
  std::vector<ImuSample> samples = Samples();
  samples[30].is_rate_saturated = true;
  EXPECT_TRUE(TwoPoses(0.1, samples).steps().empty());
}

TEST(MotionRecord, SamplesThatStandInAGapAreNoStep) {
  std::vector<ImuSample> samples = Samples();
  samples[30].made_up_w_std_radps = 0.1f;
  EXPECT_TRUE(TwoPoses(0.1, samples).steps().empty());
}

// Adds poses each 0.1 s of the lidar's clock, to whose stamps these corrections were added.
MotionRecord CorrectedBy(const std::vector<double>& corrections_s) {
  MotionRecord record;
  for (std::size_t i = 0; i < corrections_s.size(); ++i) {
    const double t_s = 1.0 + 0.1 * static_cast<double>(i) + corrections_s[i];
    record.Add({StampAt(t_s), Tumble()(t_s)}, Duration::FromSeconds(corrections_s[i]), Samples());
  }
  return record;
}

TEST(MotionRecord, ACorrectionThatCreepsLeavesStepsAsLongAsInTheLidarsClock) {
  const MotionRecord record = CorrectedBy({0.02, 0.0204, 0.0208});
  ASSERT_EQ(record.steps().size(), 2U);
  EXPECT_EQ(record.steps()[0].track, record.steps()[1].track);
  for (const MotionStep& step : record.steps()) EXPECT_NEAR(step.span_s(), 0.1, 1e-9);
  EXPECT_NEAR(record.steps()[1].clock_correction_s, 0.0208, 1e-12);
  EXPECT_NEAR(record.clock_correction().Seconds(), 0.0208, 1e-9);
}

TEST(MotionRecord, ACorrectionThatJumpsSeparatesTracks) {
  const MotionRecord record = CorrectedBy({0.0, 0.0, 0.025, 0.025});
  ASSERT_EQ(record.steps().size(), 3U);
  EXPECT_NE(record.steps()[0].track, record.steps()[1].track);
  EXPECT_EQ(record.steps()[1].track, record.steps()[2].track);
}

TEST(MotionRecord, InterruptionAndNewMapSeparateTracks) {
  MotionRecord record;
  const Motion motion = Tumble();
  const std::vector<ImuSample> samples = Samples();
  const auto add = [&](double t_s) {
    record.Add({StampAt(t_s), motion(t_s)}, Duration{}, samples);
  };
  add(1.0);
  add(1.1);
  record.Interrupt();
  add(1.2);
  add(1.3);
  record.BeginMap();
  add(1.4);
  add(1.5);
  ASSERT_EQ(record.steps().size(), 3U);
  EXPECT_NE(record.steps()[0].track, record.steps()[1].track);
  EXPECT_EQ(record.steps()[0].map, record.steps()[1].map);
  EXPECT_NE(record.steps()[1].map, record.steps()[2].map);
  record.Clear();
  EXPECT_TRUE(record.steps().empty());
  EXPECT_FALSE(record.last_stamp());
}

}  // namespace
}  // namespace lio::test
