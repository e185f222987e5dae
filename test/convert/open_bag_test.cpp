// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/convert/bag_reader.hpp"
#include "lio/io/input_error.hpp"
#include "support/mcap_writer.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::kReceived;
using ::testing::HasSubstr;

class OpenBagTest : public testing::Test {
 protected:
  void WriteRos1(const std::string& name) {
    std::filesystem::create_directories((dir_.path() / name).parent_path());
    test::Bag1Writer bag(dir_.path() / name, {});
    bag.Write("/one", "std_msgs/Byte", kReceived, {1});
    bag.Close();
  }
  void WriteRos2(const std::string& name) {
    test::Bag2Writer bag(dir_.path() / name, 1000);
    bag.Write("/two", "std_msgs/msg/Byte", kReceived, {1}, "");
    bag.Close();
  }
  std::string FirstTopic(const std::string& name) {
    const auto bag = OpenBag(dir_.path() / name);
    BagMessage message;
    return bag->Next(message) ? bag->topics()[message.topic].name : "";
  }
  std::string WhyRefused(const std::filesystem::path& path) {
    try {
      (void)OpenBag(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TempDir dir_;
};

TEST_F(OpenBagTest, BagsOfBothKindsAreTold) {
  WriteRos1("a.bag");
  WriteRos2("drive");
  EXPECT_EQ(FirstTopic("a.bag"), "/one");
  EXPECT_EQ(FirstTopic("drive"), "/two");
  EXPECT_EQ(FirstTopic("drive/metadata.yaml"), "/two");
}

TEST_F(OpenBagTest, AFolderOfRos1BagsIsOneBag) {
  WriteRos1("parts/a.bag");
  EXPECT_EQ(FirstTopic("parts"), "/one");
}

TEST_F(OpenBagTest, McapIsToldByItsContent) {
  for (const char* name : {"a.mcap", "a.bag"}) {
    test::McapWriter bag(dir_.path() / name, {});
    bag.Write("/three", "std_msgs/Byte", kReceived, {1});
    bag.Close();
    EXPECT_EQ(FirstTopic(name), "/three") << name;
  }
}

TEST_F(OpenBagTest, WhatIsNotThereOrNoBagIsRefused) {
  EXPECT_THAT(WhyRefused(dir_.path() / "none.bag"), HasSubstr("no such file or folder"));
  EXPECT_THAT(WhyRefused(dir_.Write("x.mcap", "?")), HasSubstr("no MCAP file"));
}

}  // namespace
}  // namespace lio
