// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_folder.hpp"

#include <gtest/gtest.h>

#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, AnEarlierRunIsRefusedUnlessItMayBeOverwritten) {
  for (const char* name : {"options.yaml", "trajectory.tum", "map.pcd", "map.ply"}) {
    const test::TempDir folder;
    EXPECT_NO_THROW(RefuseEarlierRun(folder.path() / "new", false));
    EXPECT_NO_THROW(RefuseEarlierRun(folder.path(), false));
    folder.Write("config.yaml", "");
    EXPECT_NO_THROW(RefuseEarlierRun(folder.path(), false)) << "other files are no run";
    folder.Write(name, "");
    EXPECT_THROW(RefuseEarlierRun(folder.path(), false), UsageError) << name;
    EXPECT_NO_THROW(RefuseEarlierRun(folder.path(), true)) << name;
  }
}

TEST(RunFolder, AnotherRunTakesThePlaceOfAll) {
  const test::TempDir folder;
  for (const char* name : {"run/trajectory.tum", "run/beams.yaml", "run/log.lcm",
                           "run/segment_2/states.csv", "run/segment_3/states.csv"}) {
    folder.Write(name, "old");
  }
  for (const char* name : {"new/trajectory.tum", "new/map.pcd", "new/segment_2/covariance.csv"}) {
    folder.Write(name, "new");
  }
  const fs::path run = folder.path() / "run";
  ReplaceRun(run, folder.path() / "new");
  for (const char* name : {"trajectory.tum", "map.pcd", "segment_2/covariance.csv"}) {
    EXPECT_EQ(test::ReadText(run / name), "new") << name;
  }
  EXPECT_EQ(test::ReadText(run / "log.lcm"), "old") << "it is no file of a run";
  for (const char* name : {"beams.yaml", "segment_2/states.csv", "segment_3"}) {
    EXPECT_FALSE(fs::exists(run / name)) << name;
  }
}

TEST(RunFolder, TheNextFreeNumberIsTakenBesideAUsedFolder) {
  const test::TempDir folder;
  const fs::path run = folder.path() / "run";
  EXPECT_EQ(MakeFreeFolder(run), run);
  folder.Write("run/liod.log", "");
  EXPECT_EQ(MakeFreeFolder(run), run) << "other files are no run";
  folder.Write("run/options.yaml", "");
  EXPECT_EQ(MakeFreeFolder(run), folder.path() / "run-2");
  EXPECT_TRUE(fs::is_directory(folder.path() / "run-2"));
  folder.Write("run-2/options.yaml", "");
  EXPECT_EQ(MakeFreeFolder(run / ""), folder.path() / "run-3") << "a slash at the end";
  EXPECT_EQ(MakeFreeFolder(run / "."), folder.path() / "run-3");
}

TEST(RunFolder, AFileInPlaceOfTheFolderIsNamed) {
  const test::TempDir folder;
  const fs::path file = folder.Write("file", "");
  EXPECT_THROW(static_cast<void>(MakeFreeFolder(file / "run")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(MakeFreeFolder(file)), std::runtime_error);
}

TEST(RunFolder, WhatCannotBeWrittenIsNamedAndNothingIsMade) {
  const test::TempDir folder;
  const fs::path file = folder.Write("file", "");
  EXPECT_EQ(WhyNotWritable(folder.path() / "a" / "b"), "");
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
  EXPECT_EQ(WhyNotWritable(file / "run"), file.string() + " is not a folder");
}

}  // namespace
}  // namespace lio
