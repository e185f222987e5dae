// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the written form of faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "lio/sim/fault.hpp"

namespace lio::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ParseFault, ANameAloneHasItsDefaults) {
  const Fault fault = ParseFault("drop");
  EXPECT_EQ(fault.kind, FaultKind::kDrop);
  EXPECT_EQ(fault.channel, FaultChannel::kBoth);
  EXPECT_EQ(fault.Get("ratio"), 0.05);
  EXPECT_EQ(fault.Get("start"), 0.0);
  EXPECT_GT(fault.Get("duration"), 1e6) << "to the end";
  EXPECT_EQ(ParseFault("imu_gap").channel, FaultChannel::kImu);
  EXPECT_EQ(ParseFault("clock_offset").channel, FaultChannel::kLidar);
}

TEST(ParseFault, KeysOverrideDefaultsTheLastOneCounts) {
  const Fault fault = ParseFault("drop:start=2.5,channel=imu,ratio=1e-1,start=3");
  EXPECT_EQ(fault.channel, FaultChannel::kImu);
  EXPECT_EQ(fault.Get("ratio"), 0.1);
  EXPECT_EQ(fault.Get("start"), 3.0);
  EXPECT_EQ(ParseFault("stamp_jump:offset=-1.5").Get("offset"), -1.5);
}

std::string WordsOf(const std::string& text) {
  try {
    (void)ParseFault(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ParseFault, SaysWhatIsWrongAndWhatThereIs) {
  EXPECT_THAT(WordsOf("imu_hole"), StartsWith("no fault 'imu_hole'; there are: imu_gap lidar_gap"));
  EXPECT_THAT(WordsOf(""), StartsWith("no fault ''"));
  EXPECT_EQ(WordsOf("imu_gap:begin=3"),
            "fault 'imu_gap' has no key 'begin'; it has: start duration");
  EXPECT_EQ(WordsOf("drop:begin=3"),
            "fault 'drop' has no key 'begin'; it has: channel ratio start duration");
  EXPECT_EQ(WordsOf("imu_gap:start"), "fault part 'start' is not of the form key=value");
  EXPECT_EQ(WordsOf("drop:channel=gps"), "fault channel 'gps' is none of imu, lidar, both");
  EXPECT_THAT(WordsOf("imu_gap:channel=imu"), HasSubstr("has no key 'channel'"));
}

TEST(ParseFault, NumbersAreWholeAndFinite) {
  for (const char* text : {"soon", "", "3s", "nan", "inf", "1e999"}) {
    EXPECT_EQ(WordsOf(std::string("imu_gap:start=") + text),
              std::string("fault key 'start' needs a number, not '") + text + "'");
  }
}

TEST(DescribeFaults, EveryKindIsDescribedAndParsesByItsNameAlone) {
  const std::string text = DescribeFaults();
  for (const char* kind :
       {"imu_gap", "lidar_gap", "drop", "duplicate", "reorder", "chunk_loss", "stamp_jump",
        "clock_offset", "nan", "gyro_saturation", "shaking", "imu_dead", "imu_offset", "empty_scan",
        "sparse_scan", "dust", "wrong_extrinsic"}) {
    EXPECT_THAT(text, HasSubstr("  " + std::string(kind) + " ")) << kind;
    EXPECT_EQ(WordsOf(kind), "") << kind;
  }
}

// The defaults that --help shows are valid: each line of keys can be typed as it is.
TEST(DescribeFaults, TheKeysShownAreThoseOfTheKind) {
  std::istringstream lines(DescribeFaults());
  std::string kind, line;
  int num_kinds = 0;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    if (line[2] != ' ') {
      words >> kind;
      continue;
    }
    std::string text = kind + ":";
    for (std::string word; words >> word;) {
      if (word.ends_with("=(to")) words >> word >> word;
      if (word.find('=') != std::string::npos) text += (text.ends_with(":") ? "" : ",") + word;
    }
    EXPECT_EQ(WordsOf(text), "") << text;
    EXPECT_EQ(ParseFault(text).values, ParseFault(kind).values) << text;
    ++num_kinds;
  }
  EXPECT_EQ(num_kinds, 17);
}

}  // namespace
}  // namespace lio::sim
