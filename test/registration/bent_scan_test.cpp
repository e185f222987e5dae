// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/bent_scan.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

// Puts points at the corners of a sweep that began and ended half a sweep from its middle.
class BentScanTest : public testing::Test {
 protected:
  MatchInput Input() const {
    MatchInput input;
    input.points_imu = points_imu_;
    input.shares_of_correction = shares_;
    return input;
  }

  std::vector<Eigen::Vector3f> points_imu_{{10, 0, 1}, {0, 10, 1}, {-10, 0, 1}};
  std::vector<float> shares_{0.5f, 1.f, 1.5f};
  Vector6 correction_ = (Vector6() << 0.2, -0.1, 0.05, 0.01, -0.02, 0.1).finished();
};

TEST_F(BentScanTest, WithoutSharesItIsRigid) {
  shares_.clear();
  BentScan scan(Input());
  EXPECT_EQ(scan.At(ExpSe3(correction_)).points_imu.data(), points_imu_.data());
}

TEST_F(BentScanTest, AtTheGuessItIsAsItWas) {
  BentScan scan(Input());
  const MatchInput& bent = scan.At(Pose::Identity());
  for (std::size_t i = 0; i < points_imu_.size(); ++i) {
    EXPECT_EQ(bent.points_imu[i], points_imu_[i]) << i;
  }
}

TEST_F(BentScanTest, EachInstantTakesItsShareOfTheCorrection) {
  BentScan scan(Input());
  const MatchInput& bent = scan.At(ExpSe3(correction_));
  for (std::size_t i = 0; i < points_imu_.size(); ++i) {
    const Pose T_guess_instant = ExpSe3(static_cast<double>(shares_[i]) * correction_);
    const Vector3 seen = T_guess_instant * points_imu_[i].cast<double>();
    const Vector3 found = ExpSe3(correction_) * bent.points_imu[i].cast<double>();
    EXPECT_LT((found - seen).norm(), 1e-4) << i;
  }
  EXPECT_EQ(bent.points_imu[1], points_imu_[1]) << "at the middle";
}

TEST_F(BentScanTest, InstantsBetweenTwoStepsAreNear) {
  points_imu_ = {{10, 0, 0}, {10, 0, 0}, {10, 0, 0}};
  shares_ = {0.5f, 0.7512f, 1.5f};
  BentScan scan(Input());
  const MatchInput& bent = scan.At(ExpSe3(correction_));
  const Vector3 seen = ExpSe3((0.7512 - 1.0) * correction_) * Vector3(10, 0, 0);
  EXPECT_LT((bent.points_imu[1].cast<double>() - seen).norm(), 0.006);
}

TEST_F(BentScanTest, EqualSharesAreOneStep) {
  shares_ = {0.8f, 0.8f, 0.8f};
  BentScan scan(Input());
  const MatchInput& bent = scan.At(ExpSe3(correction_));
  const Vector3 seen = ExpSe3(-0.2 * correction_) * points_imu_[0].cast<double>();
  EXPECT_LT((bent.points_imu[0].cast<double>() - seen).norm(), 1e-4);
}

}  // namespace
}  // namespace lio
