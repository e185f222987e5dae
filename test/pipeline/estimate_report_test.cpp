// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/estimate_report.hpp"

#include <gtest/gtest.h>

#include "lio/filter/published_estimate.hpp"
#include "support/motion.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::StampAt;

const Vector3 kNoGravity = Vector3::Zero();
constexpr double kExact = 1e-12;  // rounding

// An estimate at 1.005 s whose world and map are apart and whose errors are all correlated, and a
// gyro that reads 0.1 rad/s more about z with each sample of 10 ms, of which 0.5 is read at 1 s.
class EstimateReportTest : public testing::Test {
 protected:
  EstimateReportTest() {
    std::mt19937_64 random(7);
    estimate_.stamp = StampAt(1.005);
    estimate_.state = test::RandomState(random);
    estimate_.cov = test::RandomCovariance<kStateDim>(random, 0.1);
    std::vector<ImuReady> ready;
    for (int i = -5; i <= 5; ++i) {
      const ImuSample sample{StampAt(1.0 + 0.01 * i), Vector3(0, 0, 0.5 + 0.1 * i),
                             Vector3(0, 0, 9.8)};
      (void)imu_.Add(sample, ready);
    }
  }

  ReportContext Context(const Vector3& g_world = test::kGravity) {
    return {options_, g_world, 17,         TrackingStatus::kDegenerate,
            &imu_,    clocks_, extrinsic_, yaw_doubt_};
  }

  Options options_;
  Counters counters_;
  ImuBuffer imu_{ImuConvention{}, counters_};
  ClockOffsetFollower clocks_{options_};
  ExtrinsicFollower extrinsic_{options_};
  YawDoubt yaw_doubt_;
  Estimate estimate_;
};

TEST_F(EstimateReportTest, SaysOfWhenAndOfWhatScanItIs) {
  const NavOutput nav = MakeNav(estimate_, Context());
  EXPECT_EQ(nav.stamp, StampAt(1.005));
  EXPECT_EQ(nav.scan_seq, 17);
  EXPECT_EQ(nav.status, TrackingStatus::kDegenerate);
}

TEST_F(EstimateReportTest, WithGravityTheWorldIsTheFilters) {
  const NavOutput nav = MakeNav(estimate_, Context());
  EXPECT_EQ(nav.T_world_imu.translation, estimate_.state.T_world_imu.translation);
  EXPECT_EQ(nav.v_world_imu_mps, estimate_.state.v_world_imu);
  EXPECT_EQ(nav.pose_cov, (estimate_.cov.topLeftCorner<6, 6>()));
  EXPECT_EQ(nav.velocity_cov, (estimate_.cov.block<3, 3>(kVel, kVel)));
}

// The world is turned by an angle a about the pivot: the pose is then off by what a small a makes
// of it, to first order.
TEST_F(EstimateReportTest, AnUnknownYawOfTheWorldStandsInEveryCovariance) {
  const FilterReport sure = MakeFilterReport(estimate_, {}, Context());
  const Vector3 pivot(3, -2, 1);
  constexpr double kVar = 0.25;
  yaw_doubt_.Add(kVar, pivot);
  const FilterReport unsure = MakeFilterReport(estimate_, {}, Context());
  constexpr double kStep_rad = 1e-6;
  const Pose turn{ExpSo3(Vector3(0, 0, kStep_rad)),
                  pivot - ExpSo3(Vector3(0, 0, kStep_rad)) * pivot};
  const Pose& T = sure.nav.T_world_imu;
  const Pose turned = turn * T;
  Vector6 by_yaw;
  by_yaw << (turned.translation - T.translation) / kStep_rad,
      LogSo3(T.rotation.conjugate() * turned.rotation) / kStep_rad;
  const Matrix6 expected = kVar * by_yaw * by_yaw.transpose();
  EXPECT_LT((unsure.nav.pose_cov - sure.nav.pose_cov - expected).norm(), 1e-5);
  EXPECT_LT((unsure.cov.topLeftCorner<6, 6>() - sure.cov.topLeftCorner<6, 6>() - expected).norm(),
            1e-5);
  const Vector3 by_yaw_mps = Vector3::UnitZ().cross(sure.nav.v_world_imu_mps);
  EXPECT_LT(
      (unsure.nav.velocity_cov - sure.nav.velocity_cov - kVar * by_yaw_mps * by_yaw_mps.transpose())
          .norm(),
      1e-9);
  EXPECT_EQ(unsure.nav.map_pose_cov, sure.nav.map_pose_cov) << "nothing turned in the map";
}

TEST_F(EstimateReportTest, UnknownYawsAboutSeveralPivotsAddUp) {
  const Matrix6 sure = MakeFilterReport(estimate_, {}, Context()).nav.pose_cov;
  Matrix6 sum = Matrix6::Zero();
  YawDoubt both;
  for (const Vector3& pivot : {Vector3(3, -2, 1), Vector3(-40, 7, 2)}) {
    yaw_doubt_ = {};
    yaw_doubt_.Add(0.3, pivot);
    both.Add(0.3, pivot);
    sum += MakeFilterReport(estimate_, {}, Context()).nav.pose_cov - sure;
  }
  yaw_doubt_ = both;
  const Matrix6 together = MakeFilterReport(estimate_, {}, Context()).nav.pose_cov - sure;
  EXPECT_LT((together - sum).norm(), 1e-9 * sum.norm());
}

TEST_F(EstimateReportTest, WithoutGravityTheMapIsTheWorld) {
  const NavOutput nav = MakeNav(estimate_, Context(kNoGravity));
  const NavState& state = estimate_.state;
  EXPECT_EQ(nav.T_world_imu.translation, state.T_map_imu.translation);
  EXPECT_TRUE(nav.T_world_imu.rotation.isApprox(state.T_map_imu.rotation));
  // The velocity in imu is the same.
  const Vector3 v_imu = state.T_world_imu.rotation.conjugate() * state.v_world_imu;
  EXPECT_LT((nav.T_world_imu.rotation.conjugate() * nav.v_world_imu_mps - v_imu).norm(), kExact);
  const NavCov cov = WithMapAsWorld(estimate_).cov;
  EXPECT_EQ(nav.pose_cov, (cov.topLeftCorner<6, 6>()));
  EXPECT_EQ(nav.velocity_cov, (cov.block<3, 3>(kVel, kVel)));
}

TEST_F(EstimateReportTest, ThePoseInTheMapIsThereUnderBoth) {
  for (const Vector3& g_world : {test::kGravity, kNoGravity}) {
    const NavOutput nav = MakeNav(estimate_, Context(g_world));
    EXPECT_EQ(nav.T_map_imu.translation, estimate_.state.T_map_imu.translation);
    EXPECT_EQ(nav.map_pose_cov, (estimate_.cov.block<6, 6>(kMapPose, kMapPose)));
  }
}

TEST_F(EstimateReportTest, TheRateIsTheGyrosAtTheStampLessItsBias) {
  const NavOutput nav = MakeNav(estimate_, Context());
  const Vector3 expected = Vector3(0, 0, 0.55) - estimate_.state.gyro_bias;
  EXPECT_LT((nav.w_imu_radps - expected).norm(), 1e-9);
}

// The constant-velocity tracker has its turn rate as the negative bias of a gyro that reads zero.
TEST_F(EstimateReportTest, WithoutAnImuTheRateIsTheNegativeBias) {
  ReportContext context = Context();
  context.imu = nullptr;
  EXPECT_EQ(MakeNav(estimate_, context).w_imu_radps, Vector3(-estimate_.state.gyro_bias));
  const ImuBuffer empty{ImuConvention{}, counters_};
  context.imu = &empty;
  EXPECT_EQ(MakeNav(estimate_, context).w_imu_radps, Vector3(-estimate_.state.gyro_bias));
}

TEST_F(EstimateReportTest, TheBaseFrameIsThereWhereTheRigHasOne) {
  EXPECT_FALSE(MakeNav(estimate_, Context()).base);
  const Pose T_base_imu{ExpSo3(Vector3(0.1, 0.2, 0.3)), Vector3(1.2, 0.1, 1.6)};
  options_.rig.T_base_imu = T_base_imu;
  for (const Vector3& g_world : {test::kGravity, kNoGravity}) {
    const NavOutput nav = MakeNav(estimate_, Context(g_world));
    ASSERT_TRUE(nav.base);
    const Pose T_world_base = nav.T_world_imu * T_base_imu.Inverse();
    EXPECT_LT((nav.base->T_world_base.translation - T_world_base.translation).norm(), kExact);
    const Vector3 r = T_base_imu.Inverse().translation;
    const Vector3 v = nav.v_world_imu_mps + nav.T_world_imu.rotation * nav.w_imu_radps.cross(r);
    EXPECT_LT((nav.base->v_world_base_mps - v).norm(), kExact);
  }
}

// The variance is the noise of one reading, over a lever of 2 m: (2 m)^2 density^2 / 10 ms across
// it.
TEST_F(EstimateReportTest, TheGyrosNoiseIsInTheVelocityOfTheBase) {
  options_.rig.T_base_imu = Pose{Quaternion::Identity(), Vector3(-2.0, 0, 0)};
  estimate_.state.T_world_imu.rotation.setIdentity();
  options_.rig.imu.gyro_noise_density = 0.0;
  const Matrix3 without = MakeNav(estimate_, Context()).base->velocity_cov;
  options_.rig.imu.gyro_noise_density = 0.01;
  const Matrix3 added = MakeNav(estimate_, Context()).base->velocity_cov - without;
  const double expected = 4.0 * 0.01 * 0.01 / 0.01;
  EXPECT_NEAR(added(0, 0), 0.0, kExact);
  EXPECT_NEAR(added(1, 1), expected, 1e-6 * expected);
  EXPECT_NEAR(added(2, 2), expected, 1e-6 * expected);
}

TEST_F(EstimateReportTest, OutsideTheSamplesNoNoiseIsAdded) {
  options_.rig.T_base_imu = Pose{Quaternion::Identity(), Vector3(-2.0, 0, 0)};
  for (const double stamp_s : {0.5, 1.5}) {
    estimate_.stamp = StampAt(stamp_s);
    options_.rig.imu.gyro_noise_density = 0.0;
    const Matrix3 without = MakeNav(estimate_, Context()).base->velocity_cov;
    options_.rig.imu.gyro_noise_density = 0.01;
    EXPECT_EQ(MakeNav(estimate_, Context()).base->velocity_cov, without);
  }
}

TEST_F(EstimateReportTest, TheFilterReportHasTheBiasesAndTheVelocityInTheMap) {
  const FilterReport report = MakeFilterReport(estimate_, {}, Context());
  EXPECT_EQ(report.gyro_bias_radps, estimate_.state.gyro_bias);
  EXPECT_EQ(report.accel_bias_mps2, estimate_.state.accel_bias);
  EXPECT_EQ(report.g_world_mps2, test::kGravity);
  EXPECT_EQ(report.v_map_imu_mps, VelocityInMap(estimate_).v_map_imu);
  EXPECT_EQ(report.map_velocity_cov, VelocityInMap(estimate_).cov);
  EXPECT_EQ(report.nav.stamp, estimate_.stamp);
}

TEST_F(EstimateReportTest, TheErrorOfTheMapAsWorldIsThereUnderBoth) {
  const Matrix6 expected = WithMapAsWorld(estimate_).cov.topLeftCorner<6, 6>();
  ASSERT_GT((expected - estimate_.cov.topLeftCorner<6, 6>()).norm(), 0.1);
  for (const Vector3& g_world : {test::kGravity, kNoGravity}) {
    EXPECT_EQ(MakeFilterReport(estimate_, {}, Context(g_world)).map_as_world_cov, expected);
  }
}

TEST_F(EstimateReportTest, TheFullCovarianceIsThatOfThePublishedPose) {
  const FilterReport level = MakeFilterReport(estimate_, {}, Context());
  const Eigen::MatrixXd published = estimate_.cov.topLeftCorner<kMapStart, kMapStart>();
  EXPECT_EQ(level.cov, published);
  const FilterReport report = MakeFilterReport(estimate_, {}, Context(kNoGravity));
  EXPECT_EQ((report.cov.topLeftCorner<6, 6>()), report.nav.pose_cov);
  EXPECT_EQ((report.cov.bottomRightCorner<9, 9>()), (published.bottomRightCorner<9, 9>()));
}

TEST_F(EstimateReportTest, OnlyAFusedScanHasDegreesOfFreedom) {
  ScanReport scan;
  scan.nis = 5.5;
  EXPECT_EQ(MakeFilterReport(estimate_, scan, Context()).nis_dof, 0);
  scan.fused = true;
  EXPECT_EQ(MakeFilterReport(estimate_, scan, Context()).nis_dof, 6);
  EXPECT_EQ(MakeFilterReport(estimate_, scan, Context()).nis, 5.5);
}

TEST_F(EstimateReportTest, TheConfiguredClockOffsetIsReported) {
  options_.rig.lidar.clock_offset_s = 0.04;
  options_.filter.estimate_clock_offset = false;
  clocks_ = ClockOffsetFollower(options_);
  const FilterReport report = MakeFilterReport(estimate_, {}, Context());
  EXPECT_EQ(report.clock_offset_s, 0.04);
  EXPECT_EQ(report.clock_offset_std_s, 0.0);
}

TEST_F(EstimateReportTest, AnEstimatedClockOffsetHasItsStandardDeviation) {
  options_.filter.estimate_clock_offset = true;
  clocks_.Restart();
  ASSERT_GT(clocks_.std_s(), 0.0);
  EXPECT_EQ(MakeFilterReport(estimate_, {}, Context()).clock_offset_std_s, clocks_.std_s());
}

TEST_F(EstimateReportTest, AFixIsThePoseAsItIsPublished) {
  for (const Vector3& g_world : {test::kGravity, kNoGravity}) {
    const NavOutput nav = MakeNav(estimate_, Context(g_world));
    const LastFix fix = MakeFix(StampAt(3.0), estimate_, g_world);
    EXPECT_EQ(fix.stamp, StampAt(3.0));
    EXPECT_EQ(fix.T_world_imu.translation, nav.T_world_imu.translation);
    EXPECT_EQ(fix.v_world_imu, nav.v_world_imu_mps);
    EXPECT_EQ(fix.T_map_imu.translation, nav.T_map_imu.translation);
    EXPECT_EQ(fix.pose_cov, nav.pose_cov);
  }
}

TEST_F(EstimateReportTest, TheVerdictKeepsThePoseWithItsDriftAndTilt) {
  const FilterReport report = MakeFilterReport(estimate_, {}, Context(kNoGravity));
  const PoseRow row = MakePoseRow(report);
  EXPECT_EQ(row.stamp, estimate_.stamp);
  EXPECT_EQ(row.T_map_imu.translation, report.nav.T_map_imu.translation);
  EXPECT_EQ(row.position_cov, (report.map_as_world_cov.topLeftCorner<3, 3>()));
  EXPECT_EQ(row.rotation_cov, (report.nav.pose_cov.bottomRightCorner<3, 3>()));
  EXPECT_EQ(row.R_world_imu.coeffs(), report.nav.T_world_imu.rotation.coeffs());
}

TEST_F(EstimateReportTest, OnlyAMatchedScanIsLocatedForTheVerdict) {
  FilterReport report = MakeFilterReport(estimate_, {}, Context());
  for (const auto status : {TrackingStatus::kOk, TrackingStatus::kDegenerate}) {
    report.nav.status = status;
    EXPECT_TRUE(MakePoseRow(report).is_located);
  }
  for (const auto status :
       {TrackingStatus::kInit, TrackingStatus::kCoasting, TrackingStatus::kLost}) {
    report.nav.status = status;
    EXPECT_FALSE(MakePoseRow(report).is_located);
  }
}

TEST_F(EstimateReportTest, OnlyWithoutAnImuIsTheMotionAlongABlindDirectionAGuess) {
  FilterReport report = MakeFilterReport(estimate_, {}, Context());
  for (const bool is_inertial : {false, true}) {
    for (const auto status : {TrackingStatus::kOk, TrackingStatus::kDegenerate}) {
      report.is_inertial = is_inertial;
      report.nav.status = status;
      EXPECT_EQ(MakePoseRow(report).is_guessed,
                !is_inertial && status == TrackingStatus::kDegenerate);
    }
  }
}

}  // namespace
}  // namespace lio
