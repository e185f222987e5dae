// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/plain_bag.hpp"

#include <gmock/gmock.h>

#include "convert/rosbag2_files.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"
#include "support/zstd_file.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

using test::kReceived;

constexpr int kNumPlainMessages = 30;

int CountMessages(const fs::path& path) {
  const auto bag = OpenBag(path);
  BagMessage message;
  int count = 0;
  while (bag->Next(message)) ++count;
  EXPECT_FALSE(bag->damage().Any()) << bag->damage().first_reason;
  return count;
}

class PlainBagTest : public testing::Test {
 protected:
  // A bag of two files, each of which is compressed as a whole.
  fs::path WriteCompressed() {
    const fs::path folder = dir_.path() / "drive";
    test::Bag2Writer bag(folder, kNumPlainMessages / 2);
    for (int i = 0; i < kNumPlainMessages; ++i) {
      bag.Write("/one", "std_msgs/msg/Byte", kReceived + Duration{i}, {1});
    }
    bag.Close();
    std::string metadata = test::ReadText(folder / "metadata.yaml");
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".db3") continue;
      const std::string name = entry.path().filename();
      metadata.replace(metadata.find(name), name.size(), name + ".zstd");
      test::CompressFile(entry.path());
    }
    dir_.Write("drive/metadata.yaml", test::WithCompression(metadata, "FILE"));
    return folder;
  }

  test::TempDir dir_;
};

TEST_F(PlainBagTest, AFolderIsReadWholeAndTheInflatedFilesGo) {
  const fs::path folder = WriteCompressed();
  EXPECT_EQ(KindOf(folder), FileKind::kRosBag);
  fs::path inflated;
  for (const fs::path& path : {folder, folder / "metadata.yaml"}) {
    const PlainBag plain(path);
    inflated = plain.path();
    EXPECT_NE(inflated, path);
    EXPECT_EQ(CountMessages(inflated), kNumPlainMessages);
  }
  EXPECT_FALSE(fs::exists(inflated));
}

TEST_F(PlainBagTest, AFolderWithoutMetadataAndASingleFileAreReadToo) {
  const fs::path folder = WriteCompressed();
  fs::remove(folder / "metadata.yaml");
  EXPECT_EQ(KindOf(folder), FileKind::kRosBag);
  EXPECT_EQ(CountMessages(PlainBag(folder).path()), kNumPlainMessages);
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_EQ(KindOf(entry.path()), FileKind::kRosBag);
    EXPECT_EQ(CountMessages(PlainBag(entry.path()).path()), kNumPlainMessages / 2);
  }
}

TEST_F(PlainBagTest, WhatIsNotCompressedStaysWhereItIs) {
  const fs::path file = dir_.Write("a.bag", "#ROSBAG V2.0");
  EXPECT_EQ(PlainBag(file).path(), file);
  EXPECT_EQ(PlainBag(dir_.path()).path(), dir_.path());
  EXPECT_EQ(PlainBag("/no/such.mcap.zstd").path(), "/no/such.mcap.zstd");
}

TEST_F(PlainBagTest, AFileThatIsCutIsInflatedUpToTheCutOrRefused) {
  const fs::path folder = WriteCompressed();
  std::string bytes;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (IsZstdFile(entry.path())) bytes = test::ReadText(entry.path());
  }
  for (const std::size_t size : {std::size_t{5}, bytes.size() / 2}) {
    const fs::path cut = dir_.Write("cut.db3.zstd", bytes.substr(0, size));
    try {
      const PlainBag plain(cut);
      EXPECT_GT(fs::file_size(plain.path()), 0u);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("nothing in it can be inflated"));
    }
  }
}

}  // namespace
}  // namespace lio
