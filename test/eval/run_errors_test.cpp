// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/run_errors.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "eval/paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

RunFiles MakeRun(const Trajectory& truth, const Trajectory& estimate, const Matrix6& cov) {
  RunFiles run;
  run.name = "run";
  run.truth = truth.poses;
  run.estimate = estimate.poses;
  run.covariances.assign(run.estimate.size(), cov);
  return run;
}

TEST(LevelAlignment, TurnsAboutZOnlyAndMeetsThePosition) {
  const Pose truth{ExpSo3({0, 0, 1.0}) * ExpSo3({0.02, -0.01, 0}), {1, 2, 3}};
  const Pose estimate{ExpSo3({0, 0, -0.5}), {0, 0, 0}};
  const Pose T = LevelAlignment(truth, estimate);
  EXPECT_LT((T.rotation * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((T * truth.translation - estimate.translation).norm(), 1e-12);
  const Vector3 left = LogSo3((T * truth).rotation * estimate.rotation.conjugate());
  EXPECT_NEAR(left.z(), 0, 1e-12);
  EXPECT_NEAR(left.head<2>().norm(), std::hypot(0.02, 0.01), 1e-5);
}

// The truth has another origin and is turned about z; the estimate is tilted by a constant 0.01 rad
// about world x and lags by 0.1 m in world y from the second row on.
TEST(ComputeRunErrors, TiltStaysAnErrorAndYawAndOriginDoNot) {
  const Pose elsewhere{ExpSo3({0, 0, 2.0}), {100, 200, 300}};
  const Trajectory level = test::Helix(50);
  const Trajectory truth = test::Map(level, [&](const Pose& p) { return elsewhere * p; });
  Trajectory estimate = test::Map(level, [](const Pose& p) {
    return Pose{ExpSo3({0.01, 0, 0}) * p.rotation, p.translation};
  });
  for (std::size_t i = 1; i < 50; ++i) estimate.poses[i].pose.translation.y() -= 0.1;
  const RunErrors errors = ComputeRunErrors(MakeRun(truth, estimate, Matrix6::Identity()));
  ASSERT_EQ(errors.instants.size(), 49u);
  const RunInstant& instant = errors.instants[30];
  EXPECT_NEAR(instant.time_s, 3.1, 1e-9);
  EXPECT_LT((instant.error.head<3>() - Vector3(0, 0.1, 0)).norm(), 1e-6);
  // R_true = R_estimate Exp(d), so R_estimate d, in world, is minus the tilt.
  EXPECT_LT((instant.rotation_error_world - Vector3(-0.01, 0, 0)).norm(), 1e-6);
  const Quaternion rotation = estimate.poses[31].pose.rotation;
  EXPECT_LT((rotation * Vector3(instant.error.tail<3>()) - Vector3(-0.01, 0, 0)).norm(), 1e-6);
}

// Without gravity the estimate's axes are those of the body at the start.
TEST(ComputeRunErrors, WhereNothingIsLevelTheTiltOfTheStartIsNoError) {
  const Trajectory truth = test::Helix(50);
  const Pose tilted{ExpSo3({0.3, -0.2, 1.0}), {1, 2, 3}};
  const Trajectory estimate = test::Map(truth, [&](const Pose& p) { return tilted * p; });
  RunFiles run = MakeRun(truth, estimate, Matrix6::Identity());
  EXPECT_GT(ComputeRunErrors(run).instants[30].error.norm(), 0.1);
  run.is_level = false;
  EXPECT_LT(ComputeRunErrors(run).instants[30].error.norm(), 1e-6);
}

TEST(ComputeRunErrors, CovarianceIsTurnedIntoWorldToo) {
  const Trajectory truth = test::MakeTrajectory(10, [](int i) {
    return Pose{ExpSo3({M_PI / 2, 0, 0}), {1.0 * i, 0, 0}};  // body y is world z
  });
  Vector6 variances;
  variances << 1, 2, 3, 4, 5, 6;
  const RunErrors errors = ComputeRunErrors(MakeRun(truth, truth, Matrix6(variances.asDiagonal())));
  Vector6 expected;
  expected << 1, 2, 3, 4, 6, 5;
  EXPECT_LT((errors.instants[3].cov_world.diagonal() - expected).norm(), 1e-9);
}

// A tilt of (0.03, 0.04) rad with 0.01 rad, 1 sigma of each angle, is five sigmas, whatever the
// heading: that is known badly here, and is wrong by 0.2 rad from the second row on.
TEST(ComputeRunErrors, TiltIsJudgedFromTheFirstRowOnWhateverTheHeading) {
  const Trajectory truth = test::Helix(50);
  Trajectory estimate = test::Map(truth, [](const Pose& p) {
    return Pose{ExpSo3({0.03, 0.04, 0}) * p.rotation, p.translation};
  });
  for (std::size_t i = 1; i < 50; ++i) {
    Quaternion& rotation = estimate.poses[i].pose.rotation;
    rotation = ExpSo3({0, 0, 0.2}) * rotation;
  }
  RunFiles run = MakeRun(truth, estimate, Matrix6::Identity());
  for (std::size_t i = 0; i < 50; ++i) {
    const Matrix3 R = estimate.poses[i].pose.rotation.toRotationMatrix();
    const Matrix3 cov_world = Vector3(1e-4, 1e-4, 1.0).asDiagonal();
    run.covariances[i].bottomRightCorner<3, 3>() = R.transpose() * cov_world * R;
  }
  run.covariances[7].setZero();
  const RunErrors errors = ComputeRunErrors(run);
  ASSERT_EQ(errors.tilts.size(), 49u) << "the first row counts, the singular one does not";
  EXPECT_EQ(errors.tilts.front().time_s, 0.0);
  for (const TiltSample& tilt : errors.tilts) EXPECT_NEAR(tilt.sigmas, 5.0, 0.03);
}

TEST(ComputeRunErrors, RowsThatCannotBeJudgedAreCounted) {
  Trajectory truth = test::Helix(50);
  truth.poses.resize(40);
  RunFiles run = MakeRun(truth, test::Helix(50), Matrix6::Identity());
  run.covariances[5](0, 0) = 0;
  run.covariances[6](0, 1) = run.covariances[6](1, 0) = 1;
  const RunErrors errors = ComputeRunErrors(run);
  EXPECT_EQ(errors.num_without_truth, 10);
  EXPECT_EQ(errors.num_singular, 2);
  EXPECT_EQ(errors.instants.size(), 37u);
  run.covariances.assign(50, Matrix6::Zero());
  EXPECT_THAT([&] { (void)ComputeRunErrors(run); },
              ThrowsMessage<std::runtime_error>(HasSubstr("39 have a singular covariance")));
}

class LoadRunFiles : public ::testing::Test {
 protected:
  LoadRunFiles() {
    WriteTum(dir_.path() / "truth.tum", test::Helix(5).poses);
    std::filesystem::create_directories(dir_.path() / "a");
    WriteTum(dir_.path() / "a/trajectory.tum", test::Helix(4).poses);
    WriteCovariances(4, 0);
    dir_.Write("a/registration.csv",
               "t_s,status,fused,nis\n1000.1,converged,1,6.5\n1000.2,converged,0,9\n"
               "1000.3,empty_map,1,0\n1000.4,converged,1,5.5\n");
  }
  void WriteCovariances(int count, int late_ns, const std::string& name = "covariance.csv") {
    std::string text = "t_s";
    for (int i = 0; i < 36; ++i) text.append(fmt::format(",c{}", i));
    for (int row = 0; row < count; ++row) {
      text.append(fmt::format("\n1000.{}0000000{}", row, late_ns));
      for (int i = 0; i < 36; ++i) text.append(fmt::format(",{}", i % 7 == 0 ? i + 1 : 0));
    }
    dir_.Write("a/" + name, text + "\n");
  }
  RunFiles Load() { return LoadRun(dir_.path() / "a", dir_.path() / "truth.tum"); }

  test::TempDir dir_;
};

TEST_F(LoadRunFiles, ACompleteRunWithoutALevelPathFeltNoGravity) {
  EXPECT_TRUE(Load().is_level) << "it may have been stopped before its end";
  dir_.Write("a/stats.json", "{}");
  EXPECT_FALSE(Load().is_level);
  dir_.Write("a/trajectory_level.tum", "");
  EXPECT_TRUE(Load().is_level);
}

TEST_F(LoadRunFiles, RowsOfTheTablesBelongTogether) {
  const RunFiles run = Load();
  EXPECT_EQ(run.estimate.size(), 4u);
  EXPECT_EQ(run.covariances[2](1, 1), 8);
  EXPECT_EQ(run.covariances[2](5, 5), 36);
  EXPECT_THAT(run.nis, ::testing::ElementsAre(6.5, 5.5));
}

TEST_F(LoadRunFiles, TheWorldHasFilesOfItsOwn) {
  const auto load = [&] {
    return LoadRun(dir_.path() / "a", dir_.path() / "truth.tum", RunFrame::kWorld);
  };
  EXPECT_THAT(load, ThrowsMessage<std::runtime_error>(HasSubstr("trajectory_world.tum")));
  WriteTum(dir_.path() / "a/trajectory_world.tum", test::Helix(3).poses);
  EXPECT_THAT(load, ThrowsMessage<std::runtime_error>(HasSubstr("covariance_world.csv")));
  WriteCovariances(3, 0, "covariance_world.csv");
  EXPECT_EQ(load().estimate.size(), 3u);
  EXPECT_EQ(load().nis.size(), 2u);
}

TEST_F(LoadRunFiles, TheLevelPathHasFilesOfItsOwn) {
  WriteTum(dir_.path() / "a/trajectory_level.tum", test::Helix(2).poses);
  WriteCovariances(2, 0, "covariance_level.csv");
  const RunFiles run = LoadRun(dir_.path() / "a", dir_.path() / "truth.tum", RunFrame::kLevel);
  EXPECT_EQ(run.estimate.size(), 2u);
}

TEST_F(LoadRunFiles, ARunsOwnTruthGoesFirst) {
  WriteTum(dir_.path() / "a/own.tum", test::Helix(7).poses);
  EXPECT_EQ(LoadRun(dir_.path() / "a", "own.tum").truth.size(), 7u);
  EXPECT_EQ(Load().truth.size(), 5u);
  EXPECT_THROW((void)LoadRun(dir_.path() / "a", "nowhere.tum"), std::runtime_error);
}

TEST_F(LoadRunFiles, AKilledRunMayLackTheLastRowsOfOneTable) {
  for (const int num : {2, 3, 4, 5}) {
    WriteCovariances(num, 0);
    const RunFiles run = Load();
    EXPECT_EQ(run.estimate.size(), std::min(num, 4));
    EXPECT_EQ(run.covariances.size(), run.estimate.size());
  }
}

TEST_F(LoadRunFiles, TablesThatDoNotMatchAreRefused) {
  WriteCovariances(3, 0);
  dir_.Write("a/stats.json", "{}");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<std::runtime_error>(HasSubstr("has 3 rows")));
  WriteCovariances(4, 1);
  EXPECT_THAT([&] { Load(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("covariance.csv:2: its stamp")));
  dir_.Write("a/covariance.csv", "t_s,a,b\n");
  EXPECT_THAT([&] { Load(); }, ThrowsMessage<std::runtime_error>(HasSubstr("not the 36")));
}

TEST_F(LoadRunFiles, RegistrationIsOptional) {
  std::filesystem::remove(dir_.path() / "a/registration.csv");
  EXPECT_FALSE(Load().has_registration);
}

}  // namespace
}  // namespace lio
