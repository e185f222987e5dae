// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/cloud_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

class CloudFile : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) {
    const auto path = dir_.path() / "cloud";
    std::ofstream(path) << text;
    return path;
  }

  test::TempDir dir_;
};

const std::string kPcd =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
    "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3\nnan 5 6\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n7 8 9\n";

TEST_F(CloudFile, TheFirstWordsTellTheKind) {
  EXPECT_EQ(KindOfCloud(Write(kPcd)), CloudKind::kPcd);
  EXPECT_EQ(KindOfCloud(Write(kPcd.substr(kPcd.find("VERSION")))), CloudKind::kPcd);
  EXPECT_EQ(KindOfCloud(Write(kPly)), CloudKind::kPly);
  EXPECT_EQ(KindOfCloud(Write("# a comment\n")), CloudKind::kOther);
  EXPECT_EQ(KindOfCloud(Write("")), CloudKind::kOther);
  EXPECT_EQ(KindOfCloud("/no/such/file"), CloudKind::kOther);
}

TEST_F(CloudFile, PointsOfBothKindsAreRead) {
  const auto pcd = ReadCloud(Write(kPcd), CloudKind::kPcd);
  ASSERT_TRUE(pcd);
  const auto points = PointsOf(*pcd);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0], Eigen::Vector3f(1.f, 2.f, 3.f));
  EXPECT_FALSE(points[1].allFinite());
  const auto ply = ReadCloud(Write(kPly), CloudKind::kPly);
  ASSERT_TRUE(ply);
  EXPECT_EQ(PointsOf(*ply), std::vector<Eigen::Vector3f>{Eigen::Vector3f(7.f, 8.f, 9.f)});
}

TEST_F(CloudFile, WhatIsNoCloudIsAbsentAndNothingIsPrinted) {
  testing::internal::CaptureStderr();
  EXPECT_FALSE(ReadCloud("/no/such/file", CloudKind::kPcd));
  EXPECT_FALSE(ReadCloud(Write("nothing of the kind\n"), CloudKind::kPcd));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(CloudFile, ACloudWithoutPointsIsEmpty) {
  EXPECT_TRUE(PointsOf(pcl::PCLPointCloud2()).empty());
}

}  // namespace
}  // namespace lio
