// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "convert/numbered_messages.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/io/input_error.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::ReceivedAt;

constexpr int kNumFolderMessages = 60;

class Rosbag2 : public testing::Test {
 protected:
  void Write(int messages_per_file) {
    test::Bag2Writer writer(folder_, messages_per_file);
    for (int i = 0; i < kNumFolderMessages; ++i) {
      const std::vector<std::uint8_t> data(1000, static_cast<std::uint8_t>(i));
      writer.Write(i % 2 == 0 ? "/imu" : "/other", "a/msg/B", ReceivedAt(i), data, "float64 x");
    }
    writer.Close();
  }
  int Count(const std::filesystem::path& path, BagDamage* damage = nullptr) {
    const auto bag = OpenBag(path);
    BagMessage message;
    int num = 0;
    while (bag->Next(message)) {
      const bool is_next = message.received == ReceivedAt(num);
      EXPECT_TRUE(!is_next || message.data.front() == num) << num;
      ++num;
    }
    if (damage != nullptr) *damage = bag->damage();
    return num;
  }

  test::TempDir dir_;
  std::filesystem::path folder_ = dir_.path() / "drive";
};

TEST_F(Rosbag2, GivesTheMessagesOfAllFilesInOrder) {
  for (const int per_file : {1000, 25}) {
    std::filesystem::remove_all(folder_);
    Write(per_file);
    BagDamage damage;
    EXPECT_EQ(Count(folder_, &damage), kNumFolderMessages);
    EXPECT_FALSE(damage.Any()) << damage.first_reason;
    EXPECT_EQ(Count(folder_ / "metadata.yaml"), kNumFolderMessages);
  }
}

TEST_F(Rosbag2, KnowsTopicsTypesAndDefinitions) {
  Write(25);
  const auto bag = OpenBag(folder_);
  EXPECT_TRUE(bag->knows_all_topics());
  ASSERT_EQ(bag->topics().size(), 2u);
  EXPECT_EQ(bag->topics()[0].name, "/imu");
  EXPECT_EQ(bag->topics()[0].type, "a/B");
  EXPECT_EQ(bag->topics()[0].definition, "float64 x");
  EXPECT_EQ(bag->topics()[0].encoding, RosEncoding::kCdr);
}

TEST_F(Rosbag2, OpensOneFileAndAFolderWithoutMetadata) {
  Write(25);
  EXPECT_EQ(Count(folder_ / "bag_1.db3"), 25);
  std::filesystem::remove(folder_ / "metadata.yaml");
  EXPECT_EQ(Count(folder_), kNumFolderMessages);
}

TEST_F(Rosbag2, SaysHowManyMessagesAMissingFileTookAlong) {
  Write(25);
  std::filesystem::remove(folder_ / "bag_1.db3");
  BagDamage damage;
  EXPECT_EQ(Count(folder_, &damage), kNumFolderMessages - 25);
  EXPECT_TRUE(damage.cut_short);
  EXPECT_EQ(damage.num_messages_missing, 25);
  EXPECT_EQ(damage.first_reason, "bag_1.db3 is missing");
}

TEST_F(Rosbag2, GivesWhatACutFileHolds) {
  Write(1000);
  const std::string whole = test::ReadText(folder_ / "bag_0.db3");
  for (const double share : {0.95, 0.7, 0.5, 0.3}) {
    const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    dir_.Write("drive/bag_0.db3", whole.substr(0, size));
    BagDamage damage;
    const int num = Count(folder_, &damage);
    EXPECT_LT(num, kNumFolderMessages) << share;
    EXPECT_TRUE(damage.cut_short) << share;
    EXPECT_EQ(damage.num_messages_missing, kNumFolderMessages - num) << share;
  }
}

TEST_F(Rosbag2, SurvivesRandomMutations) {
  Write(1000);
  const std::string whole = test::ReadText(folder_ / "bag_0.db3");
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    std::string bytes = whole;
    for (int i = 0; i < 20; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    dir_.Write("drive/bag_0.db3", bytes);
    try {
      const auto bag = OpenBag(folder_);
      BagMessage message;
      int num = 0;
      while (bag->Next(message)) ++num;
      EXPECT_LE(num, 10 * kNumFolderMessages);
    } catch (const InputError&) {  // there are no topics left
    }
  }
}

TEST_F(Rosbag2, RefusesWhatIsNoDatabase) {
  EXPECT_THROW((void)OpenBag(dir_.Write("x.db3", "not a database, but long enough to look at")),
               InputError);
  std::filesystem::create_directories(dir_.path() / "empty");
  EXPECT_THROW((void)OpenBag(dir_.path() / "empty"), InputError);
}

}  // namespace
}  // namespace lio
