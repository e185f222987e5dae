// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the first state from the coarse track and the inertial samples.
#include <gtest/gtest.h>

#include "pipeline/initializing.hpp"
#include "pipeline/initializing_bench.hpp"

namespace lio {
namespace {

using test::InitializingBench;
using test::kDriveFrom_s;
using test::kStandardGravity_mps2;
using test::kSweepSpan_s;
using test::Leaning;
using test::Motion;
using test::SecondsOf;
using test::StampAt;
using test::StateOf;
using test::Straight;

Vector3 UpOf(const Pose& T_world_imu) {
  return T_world_imu.rotation.conjugate() * Vector3::UnitZ();
}

// Drives straight ahead and moves up and down by some millimetres, as on a soft suspension: too
// much for the spread at rest, too little for scans to have moved.
Motion Shaking(double speed_mps) {
  return [speed_mps](double t_s) {
    return Pose{Quaternion::Identity(), Vector3(speed_mps * t_s, 0, 0.002 * std::sin(30.0 * t_s))};
  };
}

// Turns at the origin about the vertical without shaking, as a drone does that hovers.
Motion Turning(double rate_radps) {
  return [rate_radps](double t_s) {
    return Pose{ExpSo3(Vector3(0, 0, rate_radps * t_s)), Vector3::Zero()};
  };
}

TEST(InitializingStart, SecondOfRestGivesALevelState) {
  InitializingBench b;
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  ASSERT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_TRUE(transition->is_at_rest);
  const NavState& state = transition->start->estimate.state;
  EXPECT_NEAR((UpOf(state.T_world_imu) - UpOf(Leaning()(0.0))).norm(), 0.0, 1e-3);
  EXPECT_NEAR(state.v_world_imu.norm(), 0.0, 1e-3);
  EXPECT_NEAR(transition->start->g_world.z(), -kStandardGravity_mps2, 1e-9);
}

TEST(InitializingStart, RestTakesASecondAndEndsWithTheLastSweepOnly) {
  InitializingBench b;
  EXPECT_FALSE(b.Drive(Leaning(), 0.0, 0.9));
  const auto transition = b.Drive(Leaning(), 0.9, 1.1);
  ASSERT_TRUE(transition);
  ASSERT_EQ(b.bench.sweeps.size(), 1U);
  EXPECT_EQ(transition->start->estimate.stamp, b.bench.sweeps.front()->start);
  EXPECT_EQ(transition->handover.origin, Handover::Origin::kInertial);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kInfo));
}

TEST(InitializingStart, ShakenRestIsAwaitedForFourTenthsMore) {
  InitializingBench b;
  const auto transition = b.Drive(Shaking(0.0), 0.0, 3.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_TRUE(transition->is_at_rest);
  EXPECT_NEAR(SecondsOf(b.bench.sweeps.back()->end), 1.4, 0.1 + 1e-6);
}

// Sways in a hand by some degrees, in place.
Motion Swaying() {
  return [](double t_s) {
    return Pose{ExpSo3(Vector3(0.06 * std::sin(2.0 * t_s), 0, 0)), Vector3::Zero()};
  };
}

TEST(InitializingStart, SteadyTurnIsNoBias) {
  InitializingBench b;
  const auto transition = b.Drive(Turning(0.1), 0.0, 3.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_TRUE(transition->is_at_rest) << "it turns in place";
  EXPECT_NEAR(transition->start->estimate.state.gyro_bias.norm(), 0.0, 1e-3);
}

TEST(InitializingStart, SteadyTurnAboutAPointBesideItIsNoRest) {
  const Motion circling = [](double t_s) {
    const Quaternion R = ExpSo3(Vector3(0, 0, 0.3 * t_s));
    return Pose{R, R * Vector3(0.5, 0, 0)};
  };
  InitializingBench b;
  const auto transition = b.Drive(circling, 0.0, 3.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_FALSE(transition->is_at_rest);
  EXPECT_NEAR(transition->start->estimate.state.gyro_bias.norm(), 0.0, 1e-3);
}

// Scans between hedges say nothing of the way along, so that only the IMU tells that it stands.
TEST(InitializingStart, ABodyThatSwaysInPlaceStandsAndHasTheTiltOfTheEnd) {
  InitializingBench b;
  b.unseen_cov(0, 0) = 1e4;
  b.unseen_cov(3, 3) = 1.0;  // a scan that leaves a shift open may leave a turn, too
  const auto transition = b.Drive(Swaying(), 0.0, 3.0);
  ASSERT_TRUE(transition);
  ASSERT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_TRUE(transition->is_at_rest);
  const Estimate& start = transition->start->estimate;
  const double begin_s = SecondsOf(start.stamp);
  EXPECT_LT(begin_s, 1.5);
  EXPECT_NEAR((UpOf(start.state.T_world_imu) - UpOf(Swaying()(begin_s))).norm(), 0.0, 5e-3);
  EXPECT_NEAR(start.state.v_world_imu.norm(), 0.0, 1e-3);
}

// So does one who walks between hedges.
TEST(InitializingStart, AShakenBodyDoesNotStandBecauseScansDoNotSeeItMove) {
  const Motion walking = [](double t_s) {
    return Pose{Quaternion::Identity(), Vector3(0, 0, 0.02 * std::sin(12.0 * t_s))};
  };
  InitializingBench b;
  b.unseen_cov(0, 0) =
      DegeneracyParameters::kDegenerateStd_m * DegeneracyParameters::kDegenerateStd_m;
  EXPECT_FALSE(b.Drive(walking, 0.0, 3.0));
}

// On bare ground matches say little of a level direction, and wander along it.
TEST(InitializingStart, RestIsFeltWhereScansWanderAlongAnOpenDirection) {
  constexpr double kStd_m = DegeneracyParameters::kDegenerateStd_m;
  const Motion wandering = Straight(2.0);
  InitializingBench b;
  b.unseen_cov(0, 0) = kStd_m * kStd_m;
  b.bench.FeedImu(Straight(0.0), 0.0, 2.0);
  std::optional<Transition> transition;
  for (int i = 0; i < 18 && !transition; ++i) {
    b.bench.AddSweep(kSweepSpan_s * i);
    transition = b.MatchWaiting(wandering);
  }
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_TRUE(transition->is_at_rest);
  EXPECT_NEAR(transition->start->estimate.state.v_world_imu.norm(), 0.0, 1e-3);
}

// A robot that creeps over a smooth floor is as calm as one that stands.
TEST(InitializingStart, RestIsUnsureByTheMotionThatScansShow) {
  InitializingBench standing, creeping;
  const auto rest = standing.Drive(Straight(0.0), 0.0, 2.0);
  const auto creep = creeping.Drive(Straight(0.3), 0.0, 2.0);
  ASSERT_TRUE(rest && creep);
  EXPECT_TRUE(rest->is_at_rest);
  EXPECT_FALSE(creep->is_at_rest);
  const auto velocity_std_mps = [](const Transition& start) {
    return std::sqrt(start.start->estimate.cov(kVel, kVel));
  };
  EXPECT_NEAR(velocity_std_mps(*rest), 0.01, 1e-3);
  EXPECT_NEAR(velocity_std_mps(*creep), 0.3, 0.05);
}

TEST(InitializingStart, DriveGivesAStateInMotion) {
  const Motion drive = test::WindingDrive(0.0);
  InitializingBench b;
  const auto transition = b.Drive(drive, kDriveFrom_s, kDriveFrom_s + 3.5);
  ASSERT_TRUE(transition);
  ASSERT_EQ(transition->trigger, Trigger::kStarted);
  EXPECT_FALSE(transition->is_at_rest);
  const Estimate& estimate = transition->start->estimate;
  const auto truth = StateOf(drive, SecondsOf(estimate.stamp));
  EXPECT_NEAR(estimate.state.v_world_imu.norm(), truth.v_world_imu.norm(), 0.1);
  EXPECT_NEAR((UpOf(estimate.state.T_world_imu) - UpOf(truth.T_world_imu)).norm(), 0.0, 0.02);
}

// As in a tunnel: matches say where the body is across a direction, and nothing along it.
TEST(InitializingStart, NoStateIsMadeInMotionWhereTheWayIsUnseen) {
  constexpr double kVar_m2 =
      DegeneracyParameters::kDegenerateStd_m * DegeneracyParameters::kDegenerateStd_m;
  InitializingBench level;
  level.unseen_cov(0, 0) = kVar_m2;
  EXPECT_FALSE(level.Drive(Shaking(8.0), kDriveFrom_s, kDriveFrom_s + 8.0));
  EXPECT_TRUE(level.bench.HasNotified(Notice::Severity::kInfo));
  level.unseen_cov.setZero();  // the tunnel ends
  const auto transition = level.Drive(Shaking(8.0), kDriveFrom_s + 8.0, kDriveFrom_s + 12.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
  InitializingBench upward;
  upward.unseen_cov(2, 2) = kVar_m2;
  const auto started = upward.Drive(Shaking(8.0), kDriveFrom_s, kDriveFrom_s + 4.0);
  ASSERT_TRUE(started);
  EXPECT_EQ(started->trigger, Trigger::kStarted);
}

// The scans match traffic that goes along, and buildings say that the body moves.
TEST(InitializingStart, NoStateIsMadeThatBuildingsContradict) {
  InitializingBench moving;
  moving.speed_by_buildings = {15.0, 20.0};
  const auto in_motion = moving.Drive(test::WindingDrive(0.0), kDriveFrom_s, kDriveFrom_s + 3.0);
  ASSERT_TRUE(in_motion);
  EXPECT_EQ(in_motion->trigger, Trigger::kRetry);
  EXPECT_TRUE(moving.bench.sweeps.empty());
  EXPECT_TRUE(moving.bench.HasNotified(Notice::Severity::kInfo));

  InitializingBench standing;
  standing.speed_by_buildings = {3.0, 12.0};
  const auto at_rest = standing.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(at_rest);
  EXPECT_EQ(at_rest->trigger, Trigger::kRetry);
}

// Drives at 8 m/s where buildings show these speeds.
std::optional<Transition> DriveBesideBuildings(const std::optional<SpeedRange>& speeds,
                                               const Handover& handover = {}) {
  InitializingBench b({}, handover);
  b.speed_by_buildings = speeds;
  return b.Drive(test::WindingDrive(0.0), kDriveFrom_s, kDriveFrom_s + 3.0);
}

// Buildings that have contradicted a track have to confirm the next, or the body must be calm.
TEST(InitializingStart, AmidTrafficAStateIsMadeThatBuildingsConfirmOrACalmBody) {
  Handover amid_traffic;
  amid_traffic.in_traffic = StampAt(kDriveFrom_s - 1.0);
  const auto drive = [&](const std::optional<SpeedRange>& speeds) {
    return DriveBesideBuildings(speeds, amid_traffic);
  };
  EXPECT_EQ(drive({})->trigger, Trigger::kRetry);
  EXPECT_EQ(drive(SpeedRange{0.0, 20.0})->trigger, Trigger::kRetry);
  EXPECT_EQ(drive(SpeedRange{5.0, 12.0})->trigger, Trigger::kStarted);
  InitializingBench calm({}, amid_traffic);
  EXPECT_EQ(calm.Drive(Leaning(), kDriveFrom_s, kDriveFrom_s + 2.0)->trigger, Trigger::kStarted);
  amid_traffic.in_traffic = StampAt(kDriveFrom_s - kInitializing.in_traffic_s);
  EXPECT_EQ(drive({})->trigger, Trigger::kStarted) << "long ago";
}

TEST(InitializingStart, AStateIsMadeThatBuildingsConfirm) {
  const auto transition = DriveBesideBuildings(SpeedRange{5.0, 9.0});
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
}

TEST(InitializingStart, StateInMotionIsForTheFirstSweepOfTwoSeconds) {
  InitializingBench b;
  const auto transition = b.Drive(test::WindingDrive(0.0), kDriveFrom_s, kDriveFrom_s + 3.5);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->start->estimate.stamp, StampAt(kDriveFrom_s));
  EXPECT_EQ(b.bench.sweeps.front()->start, StampAt(kDriveFrom_s));
  EXPECT_NEAR(SecondsOf(b.bench.sweeps.back()->end), kDriveFrom_s + 2.0, 0.1 + 1e-6);
}

TEST(InitializingStart, InMotionARestIsAwaitedWhereThatIsAskedFor) {
  Options options;
  options.start.wait_for_rest_s = 60.0;
  InitializingBench b(options);
  EXPECT_FALSE(b.Drive(test::WindingDrive(0.0), kDriveFrom_s, kDriveFrom_s + 4.0));
  EXPECT_LE(b.bench.sweeps.size(), 20U);  // the window of a start in motion
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kInfo));
}

TEST(InitializingStart, RestartGoesOnWhereTheLastFixWas) {
  Handover handover;
  handover.origin = Handover::Origin::kInertial;
  handover.last_fix.stamp = StampAt(-1.0);
  handover.last_fix.T_world_imu = {ExpSo3(Vector3(0, 0, 1.0)), Vector3(10, 5, 2)};
  handover.last_fix.T_map_imu = {ExpSo3(Vector3(0, 0, 0.4)), Vector3(7, 8, 9)};
  InitializingBench b({}, handover);
  const auto transition = b.Drive(Straight(0.0), 0.0, 2.0);
  ASSERT_TRUE(transition);
  ASSERT_EQ(transition->trigger, Trigger::kStarted);
  const NavState& state = transition->start->estimate.state;
  EXPECT_NEAR((state.T_world_imu.translation - Vector3(10, 5, 2)).norm(), 0.0, 1e-3);
  EXPECT_NEAR(LogSo3(state.T_world_imu.rotation).z(), 1.0, 1e-3);
  EXPECT_NEAR((state.T_map_imu.translation - Vector3(7, 8, 9)).norm(), 0.0, 1e-3);
  EXPECT_GE(transition->start->estimate.cov(kPos, kPos), kPlacedStd_m * kPlacedStd_m);
}

TEST(InitializingStart, RestartAfterLidarOnlyLevelsTheWorldAndKeepsTheMap) {
  Handover handover;
  handover.origin = Handover::Origin::kLidar;
  handover.last_fix.stamp = StampAt(-1.0);
  handover.last_fix.T_world_imu = {ExpSo3(Vector3(0.5, 0.3, 0)), Vector3(10, 5, 2)};
  handover.last_fix.T_map_imu = {ExpSo3(Vector3(0.2, 0, 0.4)), Vector3(7, 8, 9)};
  InitializingBench b({}, handover);
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  const NavState& state = transition->start->estimate.state;
  EXPECT_NEAR((UpOf(state.T_world_imu) - UpOf(Leaning()(0.0))).norm(), 0.0, 1e-3);
  EXPECT_NEAR((state.T_world_imu.translation - Vector3(10, 5, 2)).norm(), 0.0, 1e-3);
  const Pose error = handover.last_fix.T_map_imu.Inverse() * state.T_map_imu;
  EXPECT_NEAR(LogSe3(error).norm(), 0.0, 1e-3);
}

TEST(InitializingStart, RestartInAWorldThatWasLevelLevelsTheMapAlong) {
  Handover handover;
  handover.origin = Handover::Origin::kLidar;
  handover.was_level = true;
  handover.last_fix.stamp = StampAt(-1.0);
  handover.last_fix.T_world_imu = {ExpSo3(Vector3(0.5, 0.3, 0)), Vector3(10, 5, 2)};
  const Pose T_map_world{ExpSo3(Vector3(0, 0, 0.2)), Vector3(-3, 3, 7)};
  handover.last_fix.T_map_imu = T_map_world * handover.last_fix.T_world_imu;
  InitializingBench b({}, handover);
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  const NavState& state = transition->start->estimate.state;
  const Pose error = (T_map_world * state.T_world_imu).Inverse() * state.T_map_imu;
  EXPECT_NEAR(LogSe3(error).norm(), 0.0, 1e-3);
}

TEST(InitializingStart, AnUnsureYawOfTheLastFixStandsBesideTheFilter) {
  for (const double yaw_std_rad : {0.05, 1.0}) {
    Handover handover;
    handover.origin = Handover::Origin::kLidar;
    handover.last_fix.stamp = StampAt(-0.1);
    handover.last_fix.pose_cov(5, 5) = yaw_std_rad * yaw_std_rad;
    InitializingBench b({}, handover);
    const auto transition = b.Drive(Straight(0.0), 0.0, 2.0);
    ASSERT_TRUE(transition);
    WorldEstimate published;
    transition->handover.yaw_doubt.AddTo(published);
    const double in_filter = transition->start->estimate.cov(kRot + 2, kRot + 2);
    EXPECT_EQ(in_filter < 0.01, true) << yaw_std_rad;
    EXPECT_EQ(published.cov(kRot + 2, kRot + 2) > 0.9, yaw_std_rad > 0.5);
  }
}

// The last pose is 8 s old, since when the body has turned. Live, samples come on while scans wait.
TEST(InitializingStart, TurnSinceAnOldFixDoesNotDependOnHowManySamplesHaveComeSince) {
  const Motion turn_then_stand = [](double t_s) {
    return Pose{ExpSo3(Vector3(0, 0, 0.1 * std::min(t_s, 0.0))), Vector3::Zero()};
  };
  const auto start_with_samples_to = [&](double to_s) {
    Handover handover;
    handover.origin = Handover::Origin::kInertial;
    handover.last_fix.stamp = StampAt(-8.0);
    InitializingBench b({}, handover);
    b.bench.FeedImu(turn_then_stand, -9.0, to_s);
    for (int i = 0; i < 20; ++i) {
      b.bench.AddSweep(test::kSweepSpan_s * i);
      if (auto transition = b.MatchWaiting(turn_then_stand)) return transition;
    }
    return std::optional<Transition>();
  };
  const auto prompt = start_with_samples_to(2.0);
  const auto late = start_with_samples_to(4.5);
  ASSERT_TRUE(prompt && late && prompt->start && late->start);
  const auto yaw_of = [](const Transition& transition) {
    return LogSo3(transition.start->estimate.state.T_world_imu.rotation).z();
  };
  EXPECT_EQ(yaw_of(*prompt), yaw_of(*late));
  // The first second or so of the turn is not known any more.
  EXPECT_NEAR(yaw_of(*prompt), 0.1 * (kInitializing.max_turn_back_s - 0.9), 0.02);
  const auto doubt_of = [](const Transition& transition) {
    WorldEstimate published;
    transition.handover.yaw_doubt.AddTo(published);
    return published.cov(kRot + 2, kRot + 2);
  };
  EXPECT_EQ(doubt_of(*prompt), doubt_of(*late));
  EXPECT_GT(doubt_of(*prompt), 1.0);
}

// Each second a tenth of a second of samples is missing, which no alignment in motion accepts.
TEST(InitializingStart, DriveThatCannotBeAlignedIsTriedAgainWithoutTheGyro) {
  const Motion drive = test::WindingDrive(0.0);
  InitializingBench b;
  std::optional<Transition> transition;
  int num_sweeps = 0;
  while (!transition && num_sweeps < 50) {
    const double start_s = kDriveFrom_s + 0.1 * num_sweeps;
    if (num_sweeps % 10 != 5) b.bench.FeedImu(drive, start_s, start_s + 0.1);
    b.bench.AddSweep(start_s);
    ++num_sweeps;
    transition = b.MatchWaiting(drive);
  }
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kRetry);
  EXPECT_EQ(num_sweeps, 35);  // the window of 3.5 s
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_EQ(transition->initializing_since, StampAt(kDriveFrom_s));
  EXPECT_FALSE(b.bench.context().convention.trusts_gyro());
}

}  // namespace
}  // namespace lio
