// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_file.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(OutputFile, OverwritesWhatWasThere) {
  const test::TempDir folder;
  const std::filesystem::path path = folder.Write("rows.csv", "older and longer");
  OutputFile file = OpenOutput(path);
  file.stream << "new\n";
  Close(file);
  EXPECT_EQ(test::ReadText(path), "new\n");
}

TEST(OutputFile, NamesAFileThatCannotBeWritten) {
  EXPECT_EQ(MessageOf([] { (void)OpenOutput("/missing/folder/rows.csv"); }),
            "cannot write /missing/folder/rows.csv");
}

TEST(OutputFile, NamesAFileThatTheDiskDidNotTake) {
  OutputFile file = OpenOutput("/dev/full");
  file.stream << "row\n";
  EXPECT_EQ(MessageOf([&] { Close(file); }), "cannot write /dev/full in full");
}

}  // namespace
}  // namespace lio
