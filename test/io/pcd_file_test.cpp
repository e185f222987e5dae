// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/pcd_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

// Reads a PCD file by its public description: header lines up to DATA, then rows of floats.
struct ReadPcd {
  explicit ReadPcd(const std::filesystem::path& path) {
    const std::string file = test::ReadText(path);
    const std::size_t begin = file.find('\n', file.find("DATA "));
    header = file.substr(0, begin + 1);
    data = file.substr(begin + 1);
  }
  // Returns the text after the word in the header.
  std::string Word(const std::string& key) const {
    const std::size_t at = header.find("\n" + key + " ");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + key.size() + 2;
    return header.substr(begin, header.find('\n', begin) - begin);
  }
  std::string header;
  std::string data;
};

TEST(PcdFile, HoldsEveryPointBitByBit) {
  const test::TempDir dir;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {
      {1.5f, -2.25f, 3e-20f}, {0.1f, 1e9f, -0.0f}, {nan, 4.0f, 5.0f}};
  WritePcd(dir.path() / "map.pcd", points);
  const ReadPcd pcd(dir.path() / "map.pcd");
  EXPECT_EQ(pcd.Word("FIELDS"), "x y z");
  EXPECT_EQ(pcd.Word("TYPE"), "F F F");
  EXPECT_EQ(pcd.Word("SIZE"), "4 4 4");
  EXPECT_EQ(pcd.Word("POINTS"), "3");
  EXPECT_EQ(pcd.Word("DATA"), "binary");
  ASSERT_GE(pcd.data.size(), sizeof(float) * 9);
  EXPECT_EQ(std::memcmp(pcd.data.data(), points.data(), sizeof(float) * 9), 0);
}

TEST(PcdFile, AnEmptyCloudIsAFileToo) {
  const test::TempDir dir;
  WritePcd(dir.path() / "map.pcd", {});
  const ReadPcd pcd(dir.path() / "map.pcd");
  EXPECT_EQ(pcd.Word("FIELDS"), "x y z");
  EXPECT_EQ(pcd.Word("POINTS"), "0");
  EXPECT_EQ(pcd.data, "");
}

TEST(PcdFile, IsReadAsItWasWritten) {
  const test::TempDir dir;
  const std::vector<Eigen::Vector3f> points = {{1.5f, -2.25f, 3e-20f}, {0.1f, 1e9f, -0.0f}};
  WritePcd(dir.path() / "map.pcd", points);
  EXPECT_EQ(LoadPcd(dir.path() / "map.pcd"), points);
  WritePcd(dir.path() / "none.pcd", {});
  EXPECT_TRUE(LoadPcd(dir.path() / "none.pcd").empty());
  EXPECT_THROW(static_cast<void>(LoadPcd(dir.path() / "missing.pcd")), std::runtime_error);
}

TEST(PcdFile, OverwritesWhatIsThere) {
  const test::TempDir dir;
  const auto path = dir.Write("map.pcd", std::string(100'000, 'x'));
  const std::vector<Eigen::Vector3f> points(2, Eigen::Vector3f(1, 2, 3));
  WritePcd(path, points);
  EXPECT_EQ(ReadPcd(path).Word("POINTS"), "2");
  EXPECT_LT(std::filesystem::file_size(path), 10'000u);
}

TEST(PcdFile, WhatCannotBeWrittenIsNamed) {
  const test::TempDir dir;
  for (const std::size_t num_points : {0, 2}) {
    const std::vector<Eigen::Vector3f> points(num_points);
    try {
      WritePcd(dir.path() / "no" / "map.pcd", points);
      FAIL() << "must throw";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("cannot write "));
      EXPECT_THAT(error.what(), HasSubstr("no/map.pcd"));
    }
  }
}

}  // namespace
}  // namespace lio
