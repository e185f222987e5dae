// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests IMU messages in other units and axes through the whole estimator.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/imu/imu_convention.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::ErrorAgainst;
using test::Message;
using test::Messages;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;

const ImuConvention kInG{true, false, Matrix3::Identity()};
const ImuConvention kInDeg{false, true, Matrix3::Identity()};
const ImuConvention kInBoth{true, true, Matrix3::Identity()};
const ImuConvention kZDown{false, false, Vector3(1, -1, -1).asDiagonal()};
const ImuConvention kInTurnedAxes{
    false, false, ExpSo3(Vector3(0, 0, 0.5 * M_PI)).toRotationMatrix().array().round().matrix()};

// Returns the same drive with samples as another driver sends them.
Messages SentAs(Messages messages, const ImuConvention& reading) {
  for (Message& message : messages) {
    if (message.is_imu) message.sample = FromSi(reading, message.sample);
  }
  return messages;
}

Options DriveRigIn(ImuUnits units) {
  Options options = test::DriveRig();
  options.rig.imu.units = units;
  return options;
}

const Notice* Refusal(const RunResult& run) {
  const auto at = std::find_if(run.notices.begin(), run.notices.end(), [](const Notice& notice) {
    return notice.severity == Notice::Severity::kError;
  });
  return at == run.notices.end() ? nullptr : &*at;
}

bool IsAnyCalled(const RunResult& run) {
  return test::HasNotice(run, "inertial messages:") || test::HasNotice(run, "disagree");
}

// Returns the error of the rows' distances from the first one, whatever their axes.
double WorstDistance(const test::Motion& motion, const std::vector<ScanOutput>& scans) {
  const auto truth = [&](const NavOutput& nav) { return motion(SecondsOf(nav.stamp)).translation; };
  const NavOutput& first = scans.front().filter->nav;
  double worst_m = 0.0;
  for (const ScanOutput& scan : scans) {
    const NavOutput& nav = scan.filter->nav;
    const Vector3 moved = nav.T_world_imu.translation - first.T_world_imu.translation;
    worst_m = std::max(worst_m, std::abs(moved.norm() - (truth(nav) - truth(first)).norm()));
  }
  return worst_m;
}

void ExpectTracksFromTheFirstRow(const RunResult& run, const ImuConvention& reading) {
  SCOPED_TRACE(Describe(reading));
  EXPECT_TRUE(test::HasNotice(run, "inertial messages: " + Describe(reading)));
  ASSERT_FALSE(run.scans.empty());
  test::ExpectStampsIncrease(run);
  EXPECT_EQ(run.scans.front().scan.scan_seq, 0);
  EXPECT_LT(ErrorAgainst(test::Driving(), run.scans).max_m, 0.3);
  const test::TrackError settled = ErrorAgainst(test::Driving(), run.scans, 3.0);
  EXPECT_LT(settled.max_m, 0.1);
  EXPECT_LT(settled.max_tilt_rad, 0.0175);
  EXPECT_EQ(run.counters.num_imu_out_of_range, 0);
}

TEST(OdometryImuConvention, AStartInMotionIsRightFromItsFirstRow) {
  const Messages plain = test::MovingStartDrive(6.0);
  for (const ImuConvention& reading : {kInG, kInDeg, kInBoth, kZDown, kInTurnedAxes}) {
    ExpectTracksFromTheFirstRow(RunOdometry(SentAs(plain, reading), test::DriveRig()), reading);
  }
}

TEST(OdometryImuConvention, PlainMessagesCauseNoTalk) {
  EXPECT_FALSE(IsAnyCalled(RunOdometry(test::MovingStartDrive(6.0), test::DriveRig())));
  EXPECT_FALSE(IsAnyCalled(RunOdometry(test::StaticStartDrive(), test::DriveRig())));
  EXPECT_EQ(Refusal(RunOdometry(test::StaticStartDrive(), DriveRigIn(ImuUnits::kSi))), nullptr);
}

TEST(OdometryImuConvention, UnitsOfForceAreFoundAtRest) {
  const RunResult run = RunOdometry(SentAs(test::StaticStartDrive(), kInG), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "inertial messages: accelerometer in g, gyro in rad/s"));
  ASSERT_FALSE(run.scans.empty());
  EXPECT_LT(SecondsOf(run.scans.front().scan.stamp), 1.5);
  EXPECT_LT(ErrorAgainst(test::RestThenDrive(), run.scans).max_m, 0.06);
}

// After a start at rest, axes show with the first turns: rows end before they are wrong.
TEST(OdometryImuConvention, RatesAndAxesAreFoundAfterAStartAtRest) {
  for (const ImuConvention& reading : {kInDeg, kZDown, kInTurnedAxes}) {
    SCOPED_TRACE(Describe(reading));
    const RunResult run = RunOdometry(SentAs(test::StaticStartDrive(), reading), test::DriveRig());
    EXPECT_TRUE(test::HasNotice(run, "inertial messages: " + Describe(reading)));
    test::ExpectStampsIncrease(run);
    EXPECT_LT(ErrorAgainst(test::RestThenDrive(), run.scans, 5.0).max_m, 0.15);
    EXPECT_LT(WorstDistance(test::RestThenDrive(), run.scans), 0.2);
    EXPECT_EQ(run.status, TrackingStatus::kOk);
  }
}

TEST(OdometryImuConvention, AnotherPassReadsTheMessagesRightFromItsFirstRow) {
  const Messages messages = SentAs(test::StaticStartDrive(), kInTurnedAxes);
  const RunResult first = RunOdometry(messages, test::DriveRig());
  ASSERT_TRUE(IsAnyCalled(first));
  ASSERT_EQ(first.found.convention, kInTurnedAxes);
  const RunResult second = RunOdometry(messages, test::DriveRig(), 0, first.found);
  EXPECT_FALSE(IsAnyCalled(second));
  EXPECT_LT(ErrorAgainst(test::RestThenDrive(), second.scans).max_m, 0.06);
}

// On a straight road the force alone shows that axes are turned, which is too little to be sure.
TEST(OdometryImuConvention, ADoubtThatNoTurnSettlesIsNamedByTheVerdict) {
  test::DriveOptions drive;
  drive.motion = [start = test::Driving()(0.0)](double t_s) {
    const double since_s = std::max(0.0, t_s - 1.5);
    return start * Pose{Quaternion::Identity(), Vector3(since_s * since_s, 0.0, 0.0)};
  };
  const Messages plain = SimulateDrive(test::Street(), drive);
  EXPECT_TRUE(RunOdometry(plain, test::DriveRig()).verdict.causes.empty());
  const RunResult run = RunOdometry(SentAs(plain, kInTurnedAxes), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "waits for turns"));
  ASSERT_EQ(run.verdict.causes.size(), 2U);
  EXPECT_EQ(run.verdict.causes[0].kind, CauseKind::kExtrinsicRotation);
  EXPECT_NE(run.verdict.causes[0].fix.find("rotation_wxyz"), std::string::npos);
  EXPECT_EQ(run.verdict.causes[1].kind, CauseKind::kImuAxes);
  EXPECT_NE(run.verdict.trust, Trust::kYes);
}

TEST(OdometryImuConvention, TheSameComesOutHoweverSlowMatchingIs) {
  const Messages messages = SentAs(test::MovingStartDrive(4.0), kInDeg);
  EXPECT_TRUE(test::Bytes(RunOdometry(messages, test::DriveRig()).scans) ==
              test::Bytes(RunOdometry(messages, test::DriveRig(), 11).scans));
}

TEST(OdometryImuConvention, StatedUnitsAreTaken) {
  const struct {
    ImuUnits units;
    ImuConvention reading;
  } cases[] = {{ImuUnits::kG, kInG}, {ImuUnits::kDeg, kInDeg}, {ImuUnits::kGAndDeg, kInBoth}};
  for (const auto& [units, reading] : cases) {
    const RunResult run = RunOdometry(SentAs(test::StaticStartDrive(), reading), DriveRigIn(units));
    EXPECT_FALSE(IsAnyCalled(run)) << Describe(reading);
    EXPECT_LT(ErrorAgainst(test::RestThenDrive(), run.scans).max_m, 0.06) << Describe(reading);
  }
}

TEST(OdometryImuConvention, UnitsOtherThanStatedAreRefusedWithTheFix) {
  const struct {
    ImuConvention reading;
    std::string fix;
  } cases[] = {{kInG, "set rig.imu.units: auto or g"},
               {kInDeg, "set rig.imu.units: auto or deg"},
               {kInBoth, "set rig.imu.units: auto or g_deg"},
               {kZDown, "or turn rig.T_imu_lidar: translation_m: ["},
               {kInTurnedAxes, "or turn rig.T_imu_lidar: translation_m: ["}};
  const Messages plain = test::MovingStartDrive(5.0);
  for (const auto& [reading, fix] : cases) {
    SCOPED_TRACE(Describe(reading));
    const RunResult run = RunOdometry(SentAs(plain, reading), DriveRigIn(ImuUnits::kSi));
    const Notice* refusal = Refusal(run);
    ASSERT_NE(refusal, nullptr);
    EXPECT_NE(refusal->text.find(Describe(reading)), std::string::npos) << refusal->text;
    EXPECT_NE(refusal->text.find(fix), std::string::npos) << refusal->text;
    EXPECT_TRUE(run.scans.empty());
    EXPECT_EQ(run.status, TrackingStatus::kInit);
  }
}

TEST(OdometryImuConvention, TheExtrinsicThatARefusalNamesIsRight) {
  Options options = DriveRigIn(ImuUnits::kSi);
  const Pose T_sent_imu{Quaternion(Matrix3(kInTurnedAxes.R_imu_sent.transpose())), Vector3::Zero()};
  options.rig.T_imu_lidar = T_sent_imu * *options.rig.T_imu_lidar;
  const RunResult run = RunOdometry(SentAs(test::MovingStartDrive(5.0), kInTurnedAxes), options);
  EXPECT_EQ(Refusal(run), nullptr);
  EXPECT_FALSE(run.scans.empty());
}

TEST(OdometryImuConvention, GravityOtherThanStatedIsRefusedWithTheFix) {
  test::DriveOptions drive;
  drive.to_s = 5.0;
  for (const bool starts_at_rest : {true, false}) {
    drive.motion = starts_at_rest ? test::RestThenDrive() : test::Driving();
    for (const bool is_removed : {true, false}) {
      drive.g_world = is_removed ? Vector3::Zero() : test::kGravity;
      Options options = test::DriveRig();
      options.rig.imu.gravity = is_removed ? GravityInput::kPresent : GravityInput::kRemoved;
      const RunResult run = RunOdometry(SimulateDrive(test::Street(), drive), options);
      const Notice* refusal = Refusal(run);
      ASSERT_NE(refusal, nullptr) << starts_at_rest << is_removed;
      const std::string fix = is_removed ? "auto or removed" : "auto or present";
      EXPECT_NE(refusal->text.find("set rig.imu.gravity: " + fix), std::string::npos)
          << refusal->text;
    }
  }
}

TEST(OdometryImuConvention, ForcesOfNoKnownUnitDoNotStart) {
  Messages messages = test::StaticStartDrive();
  for (Message& message : messages) message.sample.f_imu_mps2 *= 0.5;
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                                [](const Message& m) { return SecondsOf(m.arrival) > 1.5; }),
                 messages.end());
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "neither m/s^2 nor g nor without gravity"));
  EXPECT_TRUE(run.scans.empty());
}

// A turn that would be beyond any gyro in rad/s: nothing depends on whether it came before it was
// known to be in deg/s.
TEST(OdometryImuConvention, FastTurnsInDegreesAreKeptHoweverSlowMatchingIs) {
  test::DriveOptions drive;
  drive.motion = [](double t_s) {
    const Pose spin{ExpSo3(Vector3(0, 0, 1.1 * (1.0 - std::cos(2.2 * t_s)))), Vector3::Zero()};
    return test::Driving()(t_s) * spin;  // up to 140 deg/s
  };
  drive.to_s = 3.0;
  const Messages messages = SentAs(SimulateDrive(test::Street(), drive), kInDeg);
  const RunResult at_once = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(test::HasNotice(at_once, "inertial messages: " + Describe(kInDeg)));
  EXPECT_EQ(at_once.scans.front().scan.scan_seq, 0);
  EXPECT_LT(ErrorAgainst(drive.motion, at_once.scans).max_m, 0.1);
  EXPECT_EQ(at_once.counters.num_imu_out_of_range, 0);
  for (const int lag : {1, 5, 20}) {
    const RunResult slow = RunOdometry(messages, test::DriveRig(), lag);
    EXPECT_EQ(slow.counters.num_imu_out_of_range, 0) << lag;
    EXPECT_TRUE(test::Bytes(slow.scans) == test::Bytes(at_once.scans)) << lag;
  }
}

// Rates beyond any gyro's are dropped in whatever unit they turn out to be.
TEST(OdometryImuConvention, ImpossibleRatesInDegreesAreDropped) {
  Messages messages = SentAs(test::StaticStartDrive(), kInDeg);
  for (Message& message : messages) {
    const double t_s = SecondsOf(message.arrival);
    if (message.is_imu && t_s > 3.005 && t_s < 3.015) message.sample.w_imu_radps.z() = 5800.0;
    if (message.is_imu && t_s > 3.025 && t_s < 3.035) message.sample.w_imu_radps.z() = 1e6;
  }
  const RunResult run = RunOdometry(messages, DriveRigIn(ImuUnits::kDeg));
  EXPECT_EQ(run.counters.num_imu_out_of_range, 2);
  EXPECT_LT(ErrorAgainst(test::RestThenDrive(), run.scans).max_m, 0.06);
}

}  // namespace
}  // namespace lio
