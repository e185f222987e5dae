// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The rows are tested with RunWriter.
#include "lio/io/row_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

TEST(RowFiles, TheBaseHasAFileWhereTheRigNamesOne) {
  const test::TempDir folder;
  const std::filesystem::path base = folder.path() / "new" / "trajectory_base.tum";
  for (const bool has_base : {false, true, false}) {
    RowFiles(folder.path() / "new", has_base).Finish();
    EXPECT_EQ(std::filesystem::exists(base), has_base);
  }
}

TEST(RowFiles, AFolderThatCannotBeMadeIsNamed) {
  const test::TempDir folder;
  std::ofstream(folder.path() / "file").close();
  EXPECT_THROW(RowFiles(folder.path() / "file" / "out", false), std::runtime_error);
}

}  // namespace
}  // namespace lio
