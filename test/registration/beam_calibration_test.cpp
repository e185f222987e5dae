// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/beam_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "lio/registration/ndt_matcher.hpp"
#include "support/beams.hpp"
#include "support/scene.hpp"

namespace lio {
namespace {

using test::Lidar;
using test::Scene;

struct BeamScan {
  std::vector<ScanPoint> beams;
  std::vector<Eigen::Vector3f> points_imu;
};

// Drives along a street with a lidar whose beams err, matches and inserts.
class CalibrationDrive {
 public:
  explicit CalibrationDrive(const BeamKnowledge& known = {})
      : scene_(test::Street()), lidar_(test::TestLidar()), calibration_(known) {
    lidar_.num_azimuths = 200;
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < lidar_.elevations_rad.size(); ++i) {
      truth_.rings.push_back(
          {0.012f * normal(random_), 6e-4f * normal(random_), 6e-4f * normal(random_)});
    }
    truth_.encoder_rad = {3e-4f, -2e-4f};
  }

  void Go(double from_m, double to_m, double step_m, double new_content_share = 0.05) {
    for (double x = from_m; x <= to_m; x += step_m) Step(PoseAt(x), new_content_share);
  }
  void Stand(int num_scans, double new_content_share) {
    for (int i = 0; i < num_scans; ++i) Step(PoseAt(0.0), new_content_share);
  }

  const BeamErrors& truth() const { return truth_; }
  const BeamErrors& found() const { return calibration_.errors(); }
  BeamKnowledge Found() const { return calibration_.Found(); }
  void Freeze() { calibration_.Freeze(); }
  void SetBlind(bool is_blind) { is_blind_ = is_blind; }
  bool IsOfUseElsewhere() const { return calibration_.IsOfUseElsewhere(); }
  const std::optional<Matrix6>& last_score_cov() const { return last_score_cov_; }

 private:
  static Pose PoseAt(double x_m) { return {Quaternion::Identity(), Vector3(x_m, 0.0, 0.0)}; }

  std::uint16_t RingOf(const Eigen::Vector3f& position) const {
    const double elevation_rad = std::asin(position.z() / position.norm());
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < lidar_.elevations_rad.size(); ++i) {
      if (std::abs(lidar_.elevations_rad[i] - elevation_rad) <
          std::abs(lidar_.elevations_rad[nearest] - elevation_rad)) {
        nearest = i;
      }
    }
    return static_cast<std::uint16_t>(nearest);
  }

  BeamScan See(const Pose& T_world_imu) {
    BeamScan scan;
    const Pose T_lidar_imu = lidar_.T_imu_lidar.Inverse();
    for (const Eigen::Vector3f& true_imu : test::CastStill(scene_, lidar_, T_world_imu, random_)) {
      Eigen::Vector3f position = (T_lidar_imu * true_imu.cast<double>()).cast<float>();
      const std::uint16_t ring = RingOf(position);
      position += Displacement(truth_, ring, AxesOf(position));
      position -= Displacement(found(), ring, AxesOf(position));
      scan.beams.push_back({position, 0, ring});
      scan.points_imu.push_back((lidar_.T_imu_lidar * position.cast<double>()).cast<float>());
    }
    return scan;
  }

  void Step(const Pose& T_world_imu, double new_content_share) {
    const BeamScan scan = See(T_world_imu);
    MatchInput input{.points_imu = scan.points_imu,
                     .T_map_imu_guess = T_world_imu,
                     .guess_cov = 1e-4 * Matrix6::Identity(),
                     .T_imu_lidar = lidar_.T_imu_lidar,
                     .calibration = &calibration_,
                     .beam_points = scan.beams};
    const MatchResult match = matcher_.Match(input);
    last_score_cov_ = match.beam_pull.unknown_cov;
    matcher_.Insert({.points_imu = scan.points_imu,
                     .T_imu_lidar = lidar_.T_imu_lidar,
                     .beam_points = scan.beams,
                     .corrected = &found()},
                    match.IsUsable() ? match.T_map_imu : T_world_imu);
    calibration_.Keep(new_content_share, is_blind_);
  }

  std::mt19937_64 random_{7};
  Scene scene_;
  Lidar lidar_;
  BeamErrors truth_;
  BeamCalibration calibration_;
  bool is_blind_ = false;
  std::optional<Matrix6> last_score_cov_;
  NdtMatcher matcher_{NdtOptions{}};
};

// Root of the mean square over the rings, of the truth and of what is left of it.
template <class ValueOf>
std::pair<double, double> TrueAndLeft(const CalibrationDrive& drive, const ValueOf& value_of) {
  double true_sq = 0.0;
  double left_sq = 0.0;
  const std::size_t num_rings = drive.truth().rings.size();
  for (std::size_t i = 0; i < num_rings; ++i) {
    const double truth = value_of(drive.truth().rings[i]);
    true_sq += truth * truth;
    left_sq += std::pow(truth - value_of(drive.found().rings[i]), 2);
  }
  const auto count = static_cast<double>(num_rings);
  return {std::sqrt(true_sq / count), std::sqrt(left_sq / count)};
}

TEST(BeamCalibration, FindsTheErrorsOfBeamsAlongAStreet) {
  CalibrationDrive drive;
  drive.Go(-40.0, 140.0, 0.6);
  ASSERT_GE(drive.found().rings.size(), drive.truth().rings.size());
  const auto [range, range_left] =
      TrueAndLeft(drive, [](const BeamErrors::OfRing& ring) { return ring.range_m; });
  EXPECT_LT(range_left, 0.5 * range);
  const auto [elevation, elevation_left] =
      TrueAndLeft(drive, [](const BeamErrors::OfRing& ring) { return ring.elevation_rad; });
  EXPECT_LT(elevation_left, 0.9 * elevation);
  const auto [azimuth, azimuth_left] =
      TrueAndLeft(drive, [](const BeamErrors::OfRing& ring) { return ring.azimuth_rad; });
  EXPECT_LT(azimuth_left, 0.8 * azimuth);
}

TEST(BeamCalibration, TheErrorsThatAreLeftPullLessTheMoreIsKnown) {
  CalibrationDrive drive;
  drive.Go(-40.0, -30.0, 0.6);
  ASSERT_TRUE(drive.last_score_cov());
  const Matrix6 before = *drive.last_score_cov();
  drive.Go(-30.0, 60.0, 0.6);
  const Matrix6 after = *drive.last_score_cov();
  EXPECT_EQ(Eigen::LDLT<Matrix6>(after).isPositive(), true);
  EXPECT_GT(after.trace(), 0.0);
  const double pull_before = before.diagonal().head<3>().sum();
  const double pull_after = after.diagonal().head<3>().sum();
  EXPECT_LT(pull_after, pull_before);
}

TEST(BeamCalibration, LearnsNothingFromScansThatBringNothingNew) {
  CalibrationDrive drive;
  drive.Stand(20, 0.0);
  EXPECT_TRUE(drive.found().rings.empty());
}

TEST(BeamCalibration, ErrorsFoundWhereMostScansAreBlindAreOfNoUseElsewhere) {
  CalibrationDrive drive;
  EXPECT_TRUE(drive.IsOfUseElsewhere());
  drive.SetBlind(true);
  drive.Go(0.0, 5.0, 0.5);
  EXPECT_FALSE(drive.IsOfUseElsewhere());
  drive.SetBlind(false);
  drive.Go(5.5, 12.0, 0.5);
  EXPECT_TRUE(drive.IsOfUseElsewhere());
}

TEST(BeamCalibration, FrozenItKeepsWhatIsKnownAndHowWell) {
  CalibrationDrive drive;
  drive.Go(0.0, 20.0, 0.5);
  const BeamKnowledge before = drive.Found();
  drive.Freeze();
  drive.Go(20.5, 40.0, 0.5);
  const BeamKnowledge after = drive.Found();
  ASSERT_FALSE(before.std.rings.empty());
  for (std::size_t ring = 0; ring < before.std.rings.size(); ++ring) {
    EXPECT_EQ(after.errors.rings[ring].range_m, before.errors.rings[ring].range_m);
    EXPECT_EQ(after.std.rings[ring].range_m, before.std.rings[ring].range_m);
  }
  EXPECT_TRUE(drive.last_score_cov()) << "what is left of the errors pulls matches all the same";
}

// An error that all sightings of a cell have in common does not show: the prior holds.
TEST(BeamCalibration, WhileStandingNoErrorIsFoundThatIsNotThere) {
  CalibrationDrive drive;
  drive.Stand(60, 0.05);
  ASSERT_FALSE(drive.found().rings.empty());
  for (const BeamErrors::OfRing& ring : drive.found().rings) {
    EXPECT_LT(std::abs(ring.range_m), 0.03f);
    EXPECT_LT(std::abs(ring.elevation_rad), 1.5e-3f);
    EXPECT_LT(std::abs(ring.azimuth_rad), 1.5e-3f);
  }
}

// The rows of one plane that a pose error alone explains teach nothing.
TEST(BeamCalibration, APoseThatIsOffIsNoErrorOfABeam) {
  BeamCalibration calibration;
  CellBeams cell;
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  for (int scan = 0; scan < 50; ++scan) {
    calibration.BeginScan(static_cast<float>(scan), 1);
    for (int i = 0; i < 400; ++i) {
      const double azimuth = 0.1 * i;
      const double range_m = 5.0 + 0.1 * (i % 100);
      const Eigen::Vector3f position(static_cast<float>(range_m * std::cos(azimuth)),
                                     static_cast<float>(range_m * std::sin(azimuth)), -1.7f);
      const auto ring = static_cast<std::uint16_t>(i % 8);
      if (scan == 0) cell.Add({ring, AxesOf(position), Eigen::Vector3f::Zero()}, up, 0.f);
      Vector6f jacobian;
      jacobian << 0, 0, 1, position.y(), -position.x(), 0;
      const float off_m = 0.02f + 0.001f * position.y() - 0.002f * position.x();
      calibration.Add({.ring = ring,
                       .axes = AxesOf(position),
                       .cell = &cell,
                       .normal = up,
                       .residual_m = off_m,
                       .weight = 1e3f,
                       .jacobian = jacobian});
    }
    calibration.Keep(0.1, false);
  }
  ASSERT_EQ(calibration.errors().rings.size(), 8u);
  for (const BeamErrors::OfRing& ring : calibration.errors().rings) {
    EXPECT_LT(std::abs(ring.range_m), 1e-4f);
    EXPECT_LT(std::abs(ring.elevation_rad), 1e-5f);
  }
}

TEST(BeamCalibration, FewRowsAreNoMatch) {
  BeamCalibration calibration;
  CellBeams cell;
  const Eigen::Vector3f position(10.f, 0.f, -1.f);
  cell.Add({0, AxesOf(position), Eigen::Vector3f::Zero()}, Eigen::Vector3f::UnitZ(), 0.f);
  calibration.BeginScan(0.f, 1);
  calibration.Add({.ring = 0,
                   .axes = AxesOf(position),
                   .cell = &cell,
                   .normal = Eigen::Vector3f::UnitZ(),
                   .residual_m = 0.1f,
                   .weight = 1e3f,
                   .jacobian = Vector6f::Ones()});
  calibration.Keep(1.0, false);
  EXPECT_TRUE(calibration.errors().rings.empty());
}

// Returns what is found on rough ground that looks higher by this share of HeightAt(), in matches
// that take off what is found.
float ReliefFoundWhereItIs(float truth, int num_scans) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> place(-10.f, 10.f);
  std::normal_distribution<float> normal;
  BeamCalibration calibration;
  const CellBeams cell;
  for (int scan = 0; scan < num_scans; ++scan) {
    calibration.BeginScan(static_cast<float>(scan), 1);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3f position = {place(random), place(random), -1.f};
      const float height_m = 0.03f * normal(random);
      Vector6f jacobian = Vector6f::Zero();
      jacobian.tail<4>() << 1.f, position.y(), -position.x(), 0.f;
      calibration.Add(
          {.ring = 0,
           .axes = AxesOf(position),
           .cell = &cell,
           .normal = Eigen::Vector3f::UnitZ(),
           .residual_m = (truth - calibration.relief()) * height_m + 0.01f * normal(random),
           .height_m = height_m,
           .weight = 1e4f,
           .jacobian = jacobian});
    }
    calibration.Keep(0.5, false);
  }
  return calibration.relief();
}

TEST(BeamCalibration, FindsByHowMuchRoughGroundLooksHigher) {
  EXPECT_EQ(ReliefFoundWhereItIs(0.5f, 0), 0.f);
  EXPECT_NEAR(ReliefFoundWhereItIs(0.5f, 60), 0.5f, 0.06f);
  EXPECT_LT(ReliefFoundWhereItIs(0.5f, 60), 0.5f) << "a standard deviation below what is found";
  EXPECT_LT(ReliefFoundWhereItIs(0.f, 60), 0.02f);
  EXPECT_EQ(ReliefFoundWhereItIs(-0.5f, 60), 0.f) << "no ground looks lower the flatter it is seen";
}

TEST(BeamCalibration, StartsFromWhatIsKnownAndTheTimeSinceMakesItLessSure) {
  const BeamKnowledge known = test::TwoKnownBeams();
  const BeamCalibration calibration(known);
  ASSERT_EQ(calibration.errors().rings.size(), 2u);
  EXPECT_NEAR(calibration.errors().rings[0].range_m, 0.012f, 1e-7f);
  EXPECT_NEAR(calibration.errors().rings[1].azimuth_rad, 3e-4f, 1e-9f);
  EXPECT_NEAR(calibration.errors().encoder_rad.y(), -5e-5f, 1e-9f);
  const BeamKnowledge found = calibration.Found();
  // Each ring by itself, all together, and the upper ones against the lower ones.
  EXPECT_NEAR(found.std.rings[0].range_m, std::sqrt(0.003 * 0.003 + 3 * 0.002 * 0.002), 1e-6);
  EXPECT_GT(found.std.rings[1].elevation_rad, known.std.rings[1].elevation_rad);
  EXPECT_GT(found.std.encoder_rad.x(), known.std.encoder_rad.x());
}

TEST(BeamCalibration, WithoutScansNothingIsFound) {
  EXPECT_TRUE(BeamCalibration().Found().std.rings.empty());
}

// Errors that were right from the start leave less to be found than zeros do.
TEST(BeamCalibration, WhatADriveFoundHelpsTheNext) {
  CalibrationDrive first;
  first.Go(-40.0, 60.0, 0.6);
  CalibrationDrive next(first.Found());
  next.Go(-40.0, -30.0, 0.6);
  CalibrationDrive anew;
  anew.Go(-40.0, -30.0, 0.6);
  const auto range = [](const BeamErrors::OfRing& ring) { return ring.range_m; };
  EXPECT_LT(TrueAndLeft(next, range).second, 0.7 * TrueAndLeft(anew, range).second);
}

// A wrong file is unlearnt: its standard deviations are taken at their word, but what is seen
// counts more in the end.
TEST(BeamCalibration, ErrorsOfAnotherLidarAreUnlearnt) {
  BeamKnowledge wrong;
  const std::size_t num_rings = CalibrationDrive().truth().rings.size();
  for (std::size_t ring = 0; ring < num_rings; ++ring) {
    wrong.errors.rings.push_back({ring % 2 == 0 ? 0.02f : -0.02f, 0.f, 0.f});
    wrong.std.rings.push_back({0.005f, 3e-4f, 3e-4f});
  }
  wrong.std.encoder_rad = {5e-5f, 5e-5f};
  CalibrationDrive drive(wrong);
  const auto range = [](const BeamErrors::OfRing& ring) { return ring.range_m; };
  const double before = TrueAndLeft(drive, range).second;
  drive.Go(-40.0, 140.0, 0.6);
  EXPECT_LT(TrueAndLeft(drive, range).second, 0.6 * before);
}

}  // namespace
}  // namespace lio
