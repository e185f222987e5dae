// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_folder.hpp"

#include <gtest/gtest.h>

#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, AFolderThatHoldsAnythingIsRefusedUnlessItMayBeOverwritten) {
  const test::TempDir folder;
  EXPECT_NO_THROW(RefuseUsedFolder(folder.path() / "new", false));
  EXPECT_NO_THROW(RefuseUsedFolder(folder.path(), false));
  folder.Write("file", "");
  EXPECT_THROW(RefuseUsedFolder(folder.path(), false), UsageError);
  EXPECT_NO_THROW(RefuseUsedFolder(folder.path(), true));
}

TEST(RunFolder, TheNextFreeNumberIsTakenBesideAUsedFolder) {
  const test::TempDir folder;
  const fs::path run = folder.path() / "run";
  EXPECT_EQ(MakeFreeFolder(run), run);
  EXPECT_EQ(MakeFreeFolder(run), run) << "an empty folder is free";
  folder.Write("run/stats.json", "");
  EXPECT_EQ(MakeFreeFolder(run), folder.path() / "run-2");
  EXPECT_TRUE(fs::is_directory(folder.path() / "run-2"));
  folder.Write("run-2/stats.json", "");
  EXPECT_EQ(MakeFreeFolder(run / ""), folder.path() / "run-3") << "a slash at the end";
  EXPECT_EQ(MakeFreeFolder(run / "."), folder.path() / "run-3");
}

TEST(RunFolder, AFileInPlaceOfTheFolderIsNamed) {
  const test::TempDir folder;
  const fs::path file = folder.Write("file", "");
  EXPECT_THROW(static_cast<void>(MakeFreeFolder(file / "run")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(MakeFreeFolder(file)), std::runtime_error);
}

}  // namespace
}  // namespace lio
