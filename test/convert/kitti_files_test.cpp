// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

TEST(KittiStamp, IsReadToTheNanosecond) {
  EXPECT_EQ(ParseKittiStamp("1970-01-01 00:00:00.000000001"), Timestamp{1});
  EXPECT_EQ(ParseKittiStamp("2011-09-26 13:04:32.335337762"), Timestamp{1'317'042'272'335'337'762});
  EXPECT_EQ(ParseKittiStamp("2011-09-26 13:04:32"), Timestamp{1'317'042'272'000'000'000});
}

TEST(KittiStamp, RefusesNonsense) {
  for (const char* text : {"", "2011", "2011-13-26 13:04:32", "2011-09-31 13:04:32",
                           "2011-09-26 24:04:32", "2011-09-26 13:04:32x", "2011-09-26 13:04:3",
                           "2011-09-26 13:04:32.x", "-011-09-26 13:04:32"}) {
    EXPECT_FALSE(ParseKittiStamp(text)) << text;
  }
}

TEST(KittiStamps, NameFileAndLineOfAFault) {
  const test::TempDir dir;
  const auto good = dir.Write("good.txt", "2011-09-26 13:04:32.3\r\n2011-09-26 13:04:32.4\n\n");
  EXPECT_EQ(ReadKittiStamps(good).size(), 2u);
  try {
    (void)ReadKittiStamps(dir.Write("bad.txt", "2011-09-26 13:04:32.3\noops\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bad.txt:2"), std::string::npos);
  }
  EXPECT_THROW((void)ReadKittiStamps(dir.path() / "none.txt"), InputError);
}

TEST(KittiCalibration, GivesNumbersByKey) {
  const test::TempDir dir;
  auto rows = ReadKittiCalibration(
      dir.Write("c.txt", "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: 1e-1 2 -3\n"));
  EXPECT_EQ(rows["R"].size(), 9u);
  EXPECT_EQ(rows["T"], (std::vector<double>{0.1, 2.0, -3.0}));
  const Pose pose = ToPose(rows["R"], rows["T"], "c.txt");
  EXPECT_EQ(pose.translation.z(), -3.0);
  EXPECT_THROW((void)ToPose(rows["R"], {1.0}, "c.txt"), InputError);
  EXPECT_THROW((void)ToPose({1, 0, 0, 0, 2, 0, 0, 0, 1}, rows["T"], "c.txt"), InputError);
  EXPECT_THROW((void)ToPose({1, 0, 0, 0, 1, 0, 0, 0, -1}, rows["T"], "c.txt"), InputError);
}

// Returns rings as KITTI stores them: the top ring first, azimuth from 0 upward and around to below
// 0.
std::vector<LidarPoint> Rings(int num_rings, double begin_deg = 0.1) {
  std::vector<LidarPoint> points;
  for (int ring = 0; ring < num_rings; ++ring) {
    for (double azimuth = begin_deg; azimuth < 359.95; azimuth += 1.7) {
      const double radians = azimuth * std::numbers::pi / 180.0;
      points.push_back({.x_m = static_cast<float>(10.0 * std::cos(radians)),
                        .y_m = static_cast<float>(10.0 * std::sin(radians)),
                        .z_m = static_cast<float>(3 - ring)});
    }
  }
  return points;
}

TEST(KittiRings, AreCountedFromBelow) {
  auto points = Rings(64);
  AssignKittiRings(points);
  for (const LidarPoint& point : points) {
    EXPECT_EQ(point.ring, 63 - (3 - static_cast<int>(point.z_m)));
  }
}

TEST(KittiRings, AreNotSplitByNoiseAroundForward) {
  auto points = Rings(3, 0.1);
  points[1].y_m = -0.02f;  // slightly to the right, at the ring's beginning
  AssignKittiRings(points);
  EXPECT_EQ(points[2].ring, 63);
  EXPECT_EQ(points.back().ring, 61);
}

TEST(KittiRings, StopAtTheLowest) {
  auto points = Rings(70);
  AssignKittiRings(points);
  EXPECT_EQ(points.back().ring, 0);
}

std::string Binary(const std::vector<float>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size());
}

TEST(KittiScan, IsReadFromBinaryAndText) {
  const test::TempDir dir;
  const auto binary =
      ReadKittiScan(dir.Write("a.bin", Binary({1, 2, 3, 0.5f, 4, 5, 6, 1, 0, 0, 0, 0})));
  const auto text = ReadKittiScan(dir.Write("a.txt", "1 2 3 0.5\n4 5 6 1\n"));
  for (const auto& points : {binary, text}) {
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), 2u);
    EXPECT_EQ((*points)[1].y_m, 5.0f);
    EXPECT_EQ((*points)[0].intensity, 128);
    EXPECT_EQ((*points)[1].intensity, 255);
  }
}

TEST(KittiScan, RefusesWhatIsNoScan) {
  const test::TempDir dir;
  EXPECT_FALSE(ReadKittiScan(dir.path() / "none.bin"));
  EXPECT_FALSE(ReadKittiScan(dir.Write("empty.bin", "")));
  EXPECT_FALSE(ReadKittiScan(dir.Write("cut.bin", Binary({1, 2, 3}))));
  EXPECT_FALSE(ReadKittiScan(dir.Write("nan.bin", Binary({NAN, 2, 3, 1}))));
  EXPECT_FALSE(ReadKittiScan(dir.Write("bad.txt", "1 2 x 4\n")));
}

TEST(NumberedFiles, AreFoundByNumber) {
  const test::TempDir dir;
  for (const char* name : {"0000000007.bin", "3.bin", "x.bin", "5.png", "-1.bin"})
    dir.Write(name, "");
  const auto files = NumberedFiles(dir.path());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files.begin()->first, 3);
  EXPECT_EQ(files.at(7).filename(), "0000000007.bin");
  EXPECT_TRUE(NumberedFiles(dir.path() / "none").empty());
}

}  // namespace
}  // namespace lio
