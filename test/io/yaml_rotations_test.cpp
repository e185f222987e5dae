// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/yaml_rotations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

using ::testing::HasSubstr;

std::string Rpy(const std::string& text, Quaternion& rotation) {
  return ParseRpyDeg(YAML::Load(text), rotation);
}
std::string Matrix(const std::string& text, Quaternion& rotation) {
  return ParseRotationMatrix(YAML::Load(text), rotation);
}
std::string Transform(const std::string& text, Pose& pose) {
  return ParseTransformMatrix(YAML::Load(text), pose);
}

TEST(YamlRotations, RollPitchYawTurnAboutTheFixedAxesInThisOrder) {
  Quaternion rotation;
  ASSERT_EQ(Rpy("[0, 0, 90]", rotation), "");
  EXPECT_TRUE((rotation * Vector3::UnitX()).isApprox(Vector3::UnitY(), 1e-12));
  // Roll carries z to -y first, then yaw carries -y to x.
  ASSERT_EQ(Rpy("[90, 0, 90]", rotation), "");
  EXPECT_TRUE((rotation * Vector3::UnitZ()).isApprox(Vector3::UnitX(), 1e-12));
  // Pitch carries x down, where yaw leaves it.
  ASSERT_EQ(Rpy("[0, 90, 30]", rotation), "");
  EXPECT_TRUE((rotation * Vector3::UnitX()).isApprox(-Vector3::UnitZ(), 1e-12));
}

TEST(YamlRotations, AnglesThatAreNoDegreesAreRefused) {
  Quaternion rotation = Quaternion::Identity();
  EXPECT_EQ(Rpy("[0, 0]", rotation), "expects a list of 3 numbers, not one of 2");
  EXPECT_THAT(Rpy("[0, 0, 400]", rotation), HasSubstr("-360 .. 360"));
  EXPECT_THAT(Rpy("[0, 0, .nan]", rotation), HasSubstr("number"));
  EXPECT_EQ(rotation.coeffs(), Quaternion::Identity().coeffs());
}

TEST(YamlRotations, AMatrixIsReadRowByRowNestedOrFlat) {
  for (const char* text : {"[[0, -1, 0], [1, 0, 0], [0, 0, 1]]", "[0, -1, 0, 1, 0, 0, 0, 0, 1]"}) {
    Quaternion rotation;
    ASSERT_EQ(Matrix(text, rotation), "") << text;
    EXPECT_TRUE((rotation * Vector3::UnitX()).isApprox(Vector3::UnitY(), 1e-12)) << text;
  }
}

TEST(YamlRotations, ARoundedMatrixBecomesTheNearestRotation) {
  Quaternion rotation;
  ASSERT_EQ(Matrix("[[0.866, -0.5, 0], [0.5, 0.866, 0], [0, 0, 1]]", rotation), "");
  EXPECT_NEAR(rotation.norm(), 1.0, 1e-15);
  EXPECT_NEAR(YawOf(rotation), M_PI / 6.0, 1e-4);
}

TEST(YamlRotations, WhatIsNoRotationMatrixIsRefusedWithItsReason) {
  Quaternion rotation = Quaternion::Identity();
  EXPECT_THAT(Matrix("[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]", rotation), HasSubstr("right angles"));
  EXPECT_THAT(Matrix("[[2, 0, 0], [0, 2, 0], [0, 0, 2]]", rotation), HasSubstr("off by 3"));
  EXPECT_THAT(Matrix("[[1, 0, 0], [0, 1, 0], [0, 0, -1]]", rotation), HasSubstr("wrong sign"));
  EXPECT_EQ(Matrix("[[1, 0, 0], [0, 1, 0]]", rotation),
            "expects 3 rows of 3 numbers, not a list of 2");
  EXPECT_EQ(Matrix("[[1, 0, 0], [0, 1], [0, 0, 1]]", rotation),
            "expects 3 rows of 3 numbers, not with a row of 2");
  EXPECT_EQ(Matrix("[1, 0, x]", rotation), "expects 3 rows of 3 numbers, not with '1'");
  EXPECT_EQ(Matrix("one", rotation), "expects 3 rows of 3 numbers, not 'one'");
  EXPECT_EQ(rotation.coeffs(), Quaternion::Identity().coeffs());
}

TEST(YamlRotations, ATransformHoldsRotationAndTranslation) {
  Pose pose;
  ASSERT_EQ(Transform("[[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]", pose), "");
  EXPECT_EQ(pose.translation, Vector3(1, 2, 3));
  EXPECT_TRUE((pose * Vector3(1, 0, 0)).isApprox(Vector3(1, 3, 3), 1e-12));
}

TEST(YamlRotations, ATransposedOrMirroredTransformIsRefused) {
  Pose pose;
  EXPECT_THAT(Transform("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]]", pose),
              HasSubstr("row by row"));
  EXPECT_THAT(Transform("[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]", pose),
              HasSubstr("mirror"));
  EXPECT_EQ(pose.translation, Vector3::Zero());
}

}  // namespace
}  // namespace lio
