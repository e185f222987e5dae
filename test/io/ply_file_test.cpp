// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/ply_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// The format's public description has header lines up to end_header, then rows of floats.
TEST(PlyFile, HoldsEveryPointBitByBit) {
  const test::TempDir dir;
  const std::vector<Eigen::Vector3f> points = {{1.5f, -2.25f, 3e-20f}, {0.1f, 1e9f, -0.0f}};
  WritePly(dir.path() / "map.ply", points);
  const std::string file = test::ReadText(dir.path() / "map.ply");
  const std::size_t begin = file.find("end_header\n") + 11;
  const std::string header = file.substr(0, begin);
  EXPECT_THAT(header, StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(header, HasSubstr("\nelement vertex 2\nproperty float x\nproperty float y\n"
                                "property float z\n"));
  ASSERT_EQ(file.size() - begin, sizeof(float) * 6);
  EXPECT_EQ(std::memcmp(file.data() + begin, points.data(), sizeof(float) * 6), 0);
}

TEST(PlyFile, AnEmptyCloudIsAFileToo) {
  const test::TempDir dir;
  WritePly(dir.path() / "map.ply", {});
  EXPECT_THAT(test::ReadText(dir.path() / "map.ply"), HasSubstr("element vertex 0\n"));
}

TEST(PlyFile, TheErrorNamesTheFile) {
  const test::TempDir dir;
  const std::vector<Eigen::Vector3f> points(2, Eigen::Vector3f(1, 2, 3));
  try {
    WritePly(dir.path() / "no" / "map.ply", points);
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/map.ply"));
  }
}

}  // namespace
}  // namespace lio
