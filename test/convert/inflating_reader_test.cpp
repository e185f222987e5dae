// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/inflating_reader.hpp"

#include <gtest/gtest.h>

#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"
#include "support/zstd_file.hpp"

namespace lio {
namespace {

using test::kReceived;

std::vector<std::uint8_t> BytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST(InflatingReader, EachMessageIsInflatedAndADamagedOneIsCounted) {
  const test::TempDir dir;
  test::Bag2Writer bag(dir.path() / "drive");
  bag.Write("/one", "std_msgs/msg/String", kReceived, BytesOf(test::ZstdFrame("first")));
  bag.Write("/one", "std_msgs/msg/String", kReceived, BytesOf("no frame"));
  const std::string cut = test::ZstdFrame(std::string(5000, 'x'));
  bag.Write("/one", "std_msgs/msg/String", kReceived, BytesOf(cut.substr(0, cut.size() - 3)));
  bag.Write("/one", "std_msgs/msg/String", kReceived, BytesOf(test::ZstdFrame("last")));
  bag.Close();
  dir.Write("drive/metadata.yaml",
            test::WithCompression(test::ReadText(dir.path() / "drive/metadata.yaml"), "MESSAGE"));
  const auto reader = OpenBag(dir.path() / "drive");
  std::vector<std::string> texts;
  BagMessage message;
  while (reader->Next(message)) texts.emplace_back(message.data.begin(), message.data.end());
  EXPECT_EQ(texts, (std::vector<std::string>{"first", "last"}));
  EXPECT_EQ(reader->damage().num_messages_damaged, 2);
  EXPECT_EQ(reader->damage().first_reason, "a message that is no Zstandard frame");
}

}  // namespace
}  // namespace lio
