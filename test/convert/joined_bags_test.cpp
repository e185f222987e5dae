// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/joined_bags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/io/input_error.hpp"
#include "support/mcap_writer.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;

Timestamp AtSecond(int second) {
  return {1'700'000'000'000'000'000 + second * 1'000'000'000LL};
}

class JoinedBagsTest : public ::testing::Test {
 protected:
  // Writes a bag with a message of one byte at each second.
  void Write(const std::string& name, const std::vector<int>& seconds, const std::string& topic,
             bool with_index = true) {
    test::Bag1Writer::Options options;
    options.with_index = with_index;
    test::Bag1Writer bag(dir_.path() / name, options);
    for (const int second : seconds) {
      bag.Write(topic, "std_msgs/Byte", AtSecond(second), {static_cast<std::uint8_t>(second)});
    }
    bag.Close();
  }
  static std::vector<int> ReadAll(BagReader& bag) {
    std::vector<int> seen;
    BagMessage message;
    while (bag.Next(message)) seen.push_back(message.data[0]);
    return seen;
  }

  test::TempDir dir_;
};

TEST_F(JoinedBagsTest, PartsComeInTheOrderOfTheirTimesNotOfTheirNames) {
  Write("drive_10.bag", {5, 6}, "/b");
  Write("drive_2.bag", {3, 4}, "/a");
  Write("drive_1.bag", {1, 2}, "/a");
  const auto bag = OpenBag(dir_.path());
  EXPECT_TRUE(bag->knows_all_topics());
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_THAT(ReadAll(*bag), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(bag->begin_time(), AtSecond(1));
  EXPECT_EQ(bag->position_bytes(), bag->size_bytes());
  EXPECT_FALSE(bag->damage().Any());
  BagMessage message;
  EXPECT_FALSE(bag->Next(message)) << "the end stays the end";
}

TEST_F(JoinedBagsTest, TopicsHaveOneIndexInAllParts) {
  Write("a.bag", {1}, "/late_in_the_list");
  Write("b.bag", {2}, "/other");
  Write("c.bag", {3}, "/late_in_the_list");
  const auto bag = OpenBag(dir_.path());
  bag->Select([](const BagTopic& topic) { return topic.name == "/late_in_the_list"; });
  BagMessage message;
  std::vector<std::size_t> indices;
  while (bag->Next(message)) indices.push_back(message.topic);
  ASSERT_EQ(indices.size(), 2u);
  EXPECT_EQ(indices[0], indices[1]);
  EXPECT_EQ(bag->topics()[indices[0]].name, "/late_in_the_list");
  EXPECT_EQ(bag->topics()[indices[0]].num_messages, 2);
}

TEST_F(JoinedBagsTest, DamageOfOnePartIsThatOfAll) {
  Write("a.bag", {1}, "/a", false);
  Write("b.bag", {2}, "/a");
  const auto bag = OpenBag(dir_.path());
  EXPECT_THAT(ReadAll(*bag), ElementsAre(1, 2));
  EXPECT_TRUE(bag->damage().Any());
}

class JoinedMcapTest : public JoinedBagsTest {
 protected:
  void WritePart(const std::string& name, const std::vector<int>& seconds) {
    test::McapWriter part(dir_.path() / name, {.compression = "zstd"});
    for (const int second : seconds) {
      part.Write("/a", "std_msgs/Byte", AtSecond(second), {static_cast<std::uint8_t>(second)});
      part.Write("/b", "std_msgs/Byte", AtSecond(second), {100});
    }
    part.Close();
  }
  void WriteMetadata(int num_messages) {
    dir_.Write("metadata.yaml",
               "rosbag2_bagfile_information:\n  storage_identifier: mcap\n"
               "  relative_file_paths: [x_0.mcap, x_1.mcap]\n  message_count: " +
                   std::to_string(num_messages) + "\n");
  }
  std::vector<int> ReadOneTopic(BagReader& bag) {
    bag.Select([](const BagTopic& topic) { return topic.name == "/a"; });
    return ReadAll(bag);
  }
};

TEST_F(JoinedMcapTest, AFolderOfRos2IsOneBagWithAndWithoutItsMetadata) {
  WritePart("x_0.mcap", {1, 2});
  WritePart("x_1.mcap", {3});
  for (const bool has_metadata : {false, true}) {
    if (has_metadata) WriteMetadata(6);
    const auto bag = OpenBag(dir_.path());
    EXPECT_TRUE(bag->knows_all_topics());
    EXPECT_THAT(ReadOneTopic(*bag), ElementsAre(1, 2, 3));
    EXPECT_FALSE(bag->damage().Any()) << bag->damage().first_reason;
    EXPECT_EQ(bag->topics()[1].num_messages, 3) << "those that nobody wanted count, too";
  }
}

TEST_F(JoinedMcapTest, MessagesOfAMissingPartAreCounted) {
  WritePart("x_0.mcap", {1, 2});
  WriteMetadata(6);
  const auto bag = OpenBag(dir_.path() / "metadata.yaml");
  EXPECT_THAT(ReadOneTopic(*bag), ElementsAre(1, 2));
  EXPECT_TRUE(bag->damage().cut_short);
  EXPECT_EQ(bag->damage().num_messages_missing, 2);
  EXPECT_EQ(bag->damage().first_reason, "x_1.mcap is missing");
}

TEST_F(JoinedBagsTest, APartThatIsNoBagIsNamed) {
  Write("a.bag", {1}, "/a");
  dir_.Write("b.bag", "no bag");
  try {
    (void)OpenBag(dir_.path());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("b.bag"));
  }
}

}  // namespace
}  // namespace lio
