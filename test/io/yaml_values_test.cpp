// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/yaml_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

// Parses `text` as YAML; what it says, and the value that is then in `value`.
template <class T>
std::string Parse(const std::string& text, T& value) {
  return ParseValue(YAML::Load("key: " + text)["key"], value);
}

template <class T>
void ExpectTaken(const std::string& text, const T& expected) {
  T value{};
  EXPECT_EQ(Parse(text, value), "") << text;
  EXPECT_EQ(value, expected) << text;
}

// Refused with these words, and the value left alone.
template <class T>
void ExpectRefused(const std::string& text, const T& before, const std::string& words) {
  T value = before;
  EXPECT_EQ(Parse(text, value), words);
  EXPECT_EQ(value, before) << text;
}

TEST(YamlValues, NumbersInEveryUsualForm) {
  ExpectTaken("1.5", 1.5);
  ExpectTaken("-2", -2.0);
  ExpectTaken("+3", 3.0);
  ExpectTaken("1e-3", 1e-3);
  ExpectTaken(".5", 0.5);
  ExpectTaken("0.1000000000000000055511151231257827", 0.1);
  ExpectTaken("42", 42);
  ExpectTaken("-7", -7);
}

TEST(YamlValues, WhatIsNotExactlyANumberIsRefused) {
  for (const char* text : {"1.5m", "0x10", "one", "1,5", "1_000", "++1"}) {
    ExpectRefused(text, 9.0, std::string("expects a number, not '") + text + "'");
  }
  ExpectRefused("\"1.5\"", 9.0, "expects a number, not quoted '1.5'");
  ExpectRefused("[1.5]", 9.0, "expects a number, not a list");
  ExpectRefused("{a: 1}", 9.0, "expects a number, not a map");
  ExpectRefused("", 9.0, "expects a number, not nothing");
  ExpectRefused("1e999", 9.0, "expects a number, not '1e999'");
}

TEST(YamlValues, WholeNumbersAreWhole) {
  ExpectRefused("1.0", 9, "expects a whole number, not '1.0'");
  ExpectRefused("1e3", 9, "expects a whole number, not '1e3'");
  ExpectRefused("2147483648", 9, "expects a whole number, not '2147483648'");
  ExpectTaken("2147483647", 2147483647);
}

// YAML 1.1 has eleven more words for them; one of each is enough.
TEST(YamlValues, OnlyTrueAndFalseAreTruthValues) {
  ExpectTaken("true", true);
  ExpectTaken("false", false);
  for (const char* text : {"yes", "on", "True", "1", "0"}) {
    ExpectRefused(text, true, std::string("expects true or false, not '") + text + "'");
  }
  ExpectRefused("\"true\"", false, "expects true or false, not quoted 'true'");
}

TEST(YamlValues, NamesMayBeQuoted) {
  ExpectTaken("hdl32e", std::string("hdl32e"));
  ExpectTaken("\"hdl32e\"", std::string("hdl32e"));
  ExpectRefused("[a]", std::string("before"), "expects a name, not a list");
}

TEST(YamlValues, ChoicesAreListed) {
  ExpectTaken("gicp", MatchMethod::kGicp);
  ExpectTaken("removed", GravityInput::kRemoved);
  ExpectRefused("icp", MatchMethod::kLoam, "expects one of ndt, loam, gicp, not 'icp'");
  ExpectRefused("[ndt]", MatchMethod::kLoam, "expects one of ndt, loam, gicp, not a list");
}

TEST(YamlValues, VectorsHaveThreeNumbers) {
  ExpectTaken("[1, -2.5, 3e2]", Vector3(1, -2.5, 300));
  const Vector3 before(7, 8, 9);
  ExpectRefused("[1, 2]", before, "expects a list of 3 numbers, not one of 2");
  ExpectRefused("[1, 2, 3, 4]", before, "expects a list of 3 numbers, not one of 4");
  ExpectRefused("[1, 2, z]", before, "expects a list of 3 numbers, not one with 'z'");
  ExpectRefused("1", before, "expects a list of 3 numbers, not '1'");
}

Quaternion ParsedQuaternion(const std::string& text) {
  Quaternion q = Quaternion::Identity();
  EXPECT_EQ(Parse(text, q), "") << text;
  return q;
}

TEST(YamlValues, QuaternionsHaveWFirst) {
  const Quaternion q = ParsedQuaternion("[0.1, 0.7, 0.5, 0.5]");
  EXPECT_EQ(q.coeffs(), Eigen::Vector4d(0.7, 0.5, 0.5, 0.1));  // Eigen's order; of norm 1
  Quaternion value(0, 1, 0, 0);
  EXPECT_EQ(Parse("[1, 0, 0]", value), "expects a list of 4 numbers, not one of 3");
  EXPECT_EQ(value.x(), 1.0);
}

TEST(YamlValues, RoundedQuaternionsAreNormalisedAndWrongOnesLeftToBeRefused) {
  EXPECT_DOUBLE_EQ(ParsedQuaternion("[0.7071, 0.7071, 0, 0]").norm(), 1.0);
  EXPECT_DOUBLE_EQ(ParsedQuaternion("[1.0009, 0, 0, 0]").w(), 1.0);
  EXPECT_DOUBLE_EQ(ParsedQuaternion("[1.0011, 0, 0, 0]").w(), 1.0011);
  EXPECT_EQ(ParsedQuaternion("[0, 0, 0, 0]").norm(), 0.0);
}

// Printed options load as the same bits.
TEST(YamlValues, QuaternionsRightToTheLastBitsAreLeftAlone) {
  const Quaternion q = ParsedQuaternion("[0.5000000000000001, 0.5, 0.5, 0.5]");
  EXPECT_EQ(q.w(), 0.5000000000000001);
}

TEST(YamlValues, DescribeSaysWhatIsThere) {
  EXPECT_EQ(Describe(YAML::Load("word")), "'word'");
  EXPECT_EQ(Describe(YAML::Load("'word'")), "quoted 'word'");
  EXPECT_EQ(Describe(YAML::Load("[1, 2]")), "a list");
  EXPECT_EQ(Describe(YAML::Load("{a: 1}")), "a map");
  EXPECT_EQ(Describe(YAML::Load("~")), "nothing");
}

TEST(YamlValues, LongTextIsCutAndControlsAreEscaped) {
  double value = 0.0;
  EXPECT_EQ(Parse(std::string(20'000, 'x'), value),
            "expects a number, not '" + std::string(60, 'x') + "...'");
  EXPECT_EQ(Parse("\"\\e[31m\"", value), "expects a number, not quoted '\\x1b[31m'");
}

}  // namespace
}  // namespace lio
