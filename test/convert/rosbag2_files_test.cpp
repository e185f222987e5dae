// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/rosbag2_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/io/input_error.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Rosbag2FilesTest : public testing::Test {
 protected:
  void WriteMetadata(const std::string& lines) {
    dir_.Write("drive/metadata.yaml", "rosbag2_bagfile_information:\n" + lines);
  }
  std::string WhyRefused(const fs::path& path) {
    try {
      (void)FindRosbag2Files(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TempDir dir_;
  fs::path folder_ = dir_.path() / "drive";
};

TEST_F(Rosbag2FilesTest, MetadataNamesTheFilesInTheirOrder) {
  WriteMetadata("  message_count: 60\n  relative_file_paths: [b.db3, a.db3]\n");
  for (const fs::path& path : {folder_, folder_ / "metadata.yaml"}) {
    const Rosbag2Files files = FindRosbag2Files(path);
    EXPECT_THAT(files.paths, ElementsAre(folder_ / "b.db3", folder_ / "a.db3"));
    EXPECT_EQ(files.num_messages, 60);
  }
}

TEST_F(Rosbag2FilesTest, NamesWithTheFoldersOwnInFrontAreUnderstood) {
  WriteMetadata("  relative_file_paths: [drive/a.db3]\n");
  EXPECT_THAT(FindRosbag2Files(folder_).paths, ElementsAre(folder_ / "a.db3"));
}

TEST_F(Rosbag2FilesTest, AFolderWithoutMetadataGivesAllFilesByName) {
  dir_.Write("drive/a_1.db3", "");
  dir_.Write("drive/a_0.db3", "");
  dir_.Write("drive/notes.txt", "");
  const Rosbag2Files files = FindRosbag2Files(folder_);
  EXPECT_THAT(files.paths, ElementsAre(folder_ / "a_0.db3", folder_ / "a_1.db3"));
  EXPECT_EQ(files.num_messages, -1);
}

TEST_F(Rosbag2FilesTest, OneFileIsABag) {
  const fs::path file = dir_.Write("a.db3", "");
  EXPECT_THAT(FindRosbag2Files(file).paths, ElementsAre(file));
}

TEST_F(Rosbag2FilesTest, McapIsToldFromSqlite) {
  WriteMetadata("  storage_identifier: mcap\n  relative_file_paths: [b.mcap, a.mcap]\n");
  const Rosbag2Files files = FindRosbag2Files(folder_);
  EXPECT_TRUE(files.is_mcap);
  EXPECT_THAT(files.paths, ElementsAre(folder_ / "b.mcap", folder_ / "a.mcap"));
  fs::remove(folder_ / "metadata.yaml");
  const fs::path file = dir_.Write("drive/c_0.mcap", "");
  EXPECT_TRUE(FindRosbag2Files(folder_).is_mcap);
  EXPECT_THAT(FindRosbag2Files(folder_).paths, ElementsAre(file));
  EXPECT_TRUE(FindRosbag2Files(file).is_mcap);
  dir_.Write("drive/c_0.db3", "");
  EXPECT_FALSE(FindRosbag2Files(folder_).is_mcap);
}

TEST_F(Rosbag2FilesTest, OtherStoragesAreRefusedByName) {
  WriteMetadata("  storage_identifier: rock\n  relative_file_paths: [a.rock]\n");
  EXPECT_THAT(WhyRefused(folder_), HasSubstr("'rock' is not supported"));
  WriteMetadata(
      "  compression_format: lz4\n  compression_mode: file\n  relative_file_paths: [a.db3]\n");
  EXPECT_THAT(WhyRefused(folder_), HasSubstr("'lz4' in mode 'file' is not supported"));
}

TEST_F(Rosbag2FilesTest, WhatNamesNoFilesIsRefused) {
  WriteMetadata("  relative_file_paths: []\n");
  EXPECT_THAT(WhyRefused(folder_), HasSubstr("names no files"));
  dir_.Write("drive/metadata.yaml", "][");
  EXPECT_THAT(WhyRefused(folder_), HasSubstr("cannot be read as YAML"));
  fs::create_directories(dir_.path() / "empty");
  EXPECT_THAT(WhyRefused(dir_.path() / "empty"), HasSubstr("no .db3 or .mcap"));
}

TEST_F(Rosbag2FilesTest, ACountThatCannotBeIsUnknown) {
  WriteMetadata("  message_count: -9223372036854775808\n  relative_file_paths:\n    - bag_0.db3\n");
  EXPECT_EQ(FindRosbag2Files(folder_).num_messages, -1);
}

}  // namespace
}  // namespace lio
