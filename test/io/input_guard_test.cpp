// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/input_guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lio/io/input_error.hpp"
#include "lio/io/run_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

TEST(InputGuard, AFileIsNotReplacedUnderAnyOfItsNames) {
  const test::TempDir dir;
  const fs::path file = dir.Write("drive/bag_0.db3", "x");
  const fs::path other = dir.Write("drive/other", "x");
  fs::create_hard_link(file, dir.path() / "hard");
  fs::create_symlink(file, dir.path() / "soft");
  for (const fs::path& name :
       {file, dir.path() / "drive/../drive/bag_0.db3", dir.path() / "hard", dir.path() / "soft"}) {
    EXPECT_THROW(RefuseToOverwrite({file}, {name}), UsageError) << name;
    EXPECT_THROW(RefuseToOverwrite({other, file}, {"not there", name}), UsageError) << name;
  }
  EXPECT_NO_THROW(RefuseToOverwrite({file}, {other}));
}

TEST(InputGuard, RecordedDataInAFolderAreNotReplaced) {
  const test::TempDir dir;
  const fs::path folder = dir.path() / "drive";
  for (const char* name : {"bag_0.db3", "part_1.bag", "part_1.mcap", "metadata.yaml", "times.txt",
                           "velodyne_points/data/0.bin"}) {
    const fs::path file = dir.Write(std::string("drive/") + name, "x");
    EXPECT_THROW(RefuseToOverwrite({folder}, {file}), UsageError) << name;
  }
  EXPECT_NO_THROW(RefuseToOverwrite({folder}, {dir.Write("drive/out.lcm", "x")}));
  EXPECT_NO_THROW(RefuseToOverwrite({folder}, {dir.Write("other/0.bin", "x")}));
}

TEST(InputGuard, WhatIsMissingOrNotNamedIsNoObstacle) {
  const test::TempDir dir;
  const fs::path file = dir.Write("file", "x");
  EXPECT_NO_THROW(RefuseToOverwrite({file, ""}, {dir.path() / "not there", ""}));
  EXPECT_NO_THROW(RefuseToOverwrite({dir.path() / "not there"}, {file}));
  EXPECT_NO_THROW(RefuseToOverwrite({}, {file}));
}

ScanOutput ScanAt(std::int64_t stamp_s) {
  ScanOutput output;
  output.scan.stamp = Timestamp{stamp_s * 1'000'000'000};
  output.filter.emplace();
  output.filter->nav.stamp = output.scan.stamp;
  return output;
}

TEST(InputGuard, EveryFileOfARunIsListed) {
  const test::TempDir dir;
  Options options;
  options.rig.T_base_imu = Pose::Identity();
  RunWriter writer(dir.path(), options);
  writer.Write(ScanAt(20));
  writer.Write(ScanAt(10));
  const std::vector<Eigen::Vector3f> points = {Eigen::Vector3f::Ones()};
  writer.WriteMap(points);
  writer.WriteMap(points, MapFormat::kPly);
  writer.Flush();
  const auto expect_all_listed = [&] {
    const Paths listed = FilesOfRun(dir.path());
    int num_files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(dir.path())) {
      if (!entry.is_regular_file()) continue;
      ++num_files;
      EXPECT_EQ(std::count(listed.begin(), listed.end(), entry.path()), 1) << entry.path();
    }
    EXPECT_GT(num_files, 20) << "with those of the second segment";
  };
  expect_all_listed();
  writer.Finish({});
  expect_all_listed();
}

}  // namespace
}  // namespace lio
