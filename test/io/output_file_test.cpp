// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
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
  OutputFile file(path);
  file.Write("new\n");
  file.Close();
  EXPECT_EQ(test::ReadText(path), "new\n");
}

TEST(OutputFile, ADashIsNoFilesName) {
  EXPECT_THROW(OutputFile("-"), UsageError);
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(OutputFile, RowsAreInTheFileAfterAFlushAndAtTheEnd) {
  const test::TempDir folder;
  const std::filesystem::path path = folder.path() / "rows.csv";
  {
    OutputFile file(path);
    file.Write("1\n");
    EXPECT_EQ(test::ReadText(path), "");
    file.Flush();
    EXPECT_EQ(test::ReadText(path), "1\n");
    file.Write("2\n");
  }
  EXPECT_EQ(test::ReadText(path), "1\n2\n");
}

TEST(OutputFile, ManyRowsAreWrittenAsTheyAre) {
  const test::TempDir folder;
  const std::filesystem::path path = folder.path() / "rows.csv";
  std::string all;
  OutputFile file(path);
  for (std::size_t i = 0; i < 500; ++i) {
    const std::string row = std::string(i * 37 % 6000, 'a') + "\n";
    file.Write(row);
    all += row;
    if (i % 100 == 0) file.Flush();
  }
  file.Close();
  EXPECT_EQ(test::ReadText(path), all);
}

TEST(RowsWithinPage, EndWithARowBeforeThePageEnds) {
  EXPECT_EQ(RowsWithinPage("one\ntwo\nthree\n", 0), "one\ntwo\nthree\n");
  EXPECT_EQ(RowsWithinPage("one\ntwo\nthree\n", 4096 - 10), "one\ntwo\n");
  EXPECT_EQ(RowsWithinPage("one\ntwo\nthree\n", 8192 - 8), "one\ntwo\n");
  EXPECT_EQ(RowsWithinPage("one\ntwo\nthree\n", 4096 - 2), "one\n") << "it crosses the page";
  EXPECT_EQ(RowsWithinPage("no row", 4096 - 2), "no row");
}

TEST(OutputFile, ASymbolicLinkIsReplacedOrFollowed) {
  const test::TempDir folder;
  const std::filesystem::path precious = folder.Write("precious", "precious");
  const std::filesystem::path link = folder.path() / "link";
  std::filesystem::create_symlink(precious, link);
  WriteText(link, "followed", OutputFile::Links::kFollowed);
  EXPECT_EQ(test::ReadText(precious), "followed");
  WriteText(link, "replaced");
  EXPECT_EQ(test::ReadText(precious), "followed");
  EXPECT_FALSE(std::filesystem::is_symlink(link));
  EXPECT_EQ(test::ReadText(link), "replaced");
}

TEST(OutputFile, AFifoThatNobodyReadsIsNamedAndNotWaitedFor) {
  const test::TempDir folder;
  const std::filesystem::path fifo = folder.path() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(MessageOf([&] { OutputFile file(fifo); }),
            "cannot write " + fifo.string() + ": No such device or address");
}

TEST(OutputFile, AFileThatMayNotGrowEndsWithItsLastWholeRow) {
  const test::TempDir folder;
  const std::filesystem::path path = folder.path() / "rows.csv";
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{.rlim_cur = 10, .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = MessageOf([&] { WriteText(path, "row 1\nrow 2\nrow 3\n"); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(message, "cannot write " + path.string() + " in full: File too large");
  EXPECT_EQ(test::ReadText(path), "row 1\n");
}

TEST(OutputFile, NamesAFileThatCannotBeWritten) {
  EXPECT_EQ(MessageOf([] { OutputFile file("/missing/folder/rows.csv"); }),
            "cannot write /missing/folder/rows.csv: No such file or directory");
}

TEST(OutputFile, NamesAFileThatTheDiskDidNotTake) {
  OutputFile file("/dev/full");
  file.Write("row\n");
  EXPECT_EQ(MessageOf([&] { file.Close(); }),
            "cannot write /dev/full in full: No space left on device");
}

TEST(OutputFile, AllAreClosedWhenOneCannotBeWritten) {
  const test::TempDir folder;
  OutputFile full("/dev/full");
  OutputFile file(folder.path() / "rows.csv");
  full.Write("row\n");
  file.Write("row\n");
  OutputFile* const both[] = {&full, &file};
  EXPECT_THROW(CloseAll(both), WriteError);
  EXPECT_EQ(test::ReadText(file.path()), "row\n");
}

}  // namespace
}  // namespace lio
