// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/pcd_check.hpp"

#include <gtest/gtest.h>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr const char* kPcdBegin = "# .PCD v0.7\nVERSION 0.7\n";
constexpr const char* kFields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

bool IsSoundPcdText(const std::string& text) {
  const test::TempDir folder;
  return IsSoundPcd(folder.Write("cloud.pcd", text));
}

std::string With(const std::string& rest) {
  return std::string(kPcdBegin) + kFields + rest;
}

TEST(PcdCheck, FilesThatHoldTheirPointsAreSound) {
  EXPECT_TRUE(
      IsSoundPcdText(With("WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n" + std::string(12, 'x'))));
  EXPECT_TRUE(IsSoundPcdText(With("WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n")));
  EXPECT_TRUE(IsSoundPcdText(With("WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n")));
}

TEST(PcdCheck, FilesThatCannotHoldThemAreNot) {
  EXPECT_FALSE(
      IsSoundPcdText(With("WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n" + std::string(11, 'x'))));
  EXPECT_FALSE(IsSoundPcdText(With("WIDTH 99\nHEIGHT 99\nPOINTS 9801\nDATA ascii\n1 2 3\n")));
  EXPECT_FALSE(IsSoundPcdText(With("WIDTH 4294967295\nHEIGHT 4294967295\nDATA binary\n")));
}

TEST(PcdCheck, CompressedSizesMustBeThoseOfTheHeaderAndTheFile) {
  const std::string begin = With("WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary_compressed\n");
  const auto sizes = [](char packed, char unpacked) {
    return std::string{packed, 0, 0, 0, unpacked, 0, 0, 0};
  };
  const std::string points(13, 'x');
  EXPECT_TRUE(IsSoundPcdText(begin + sizes(13, 12) + points));
  EXPECT_FALSE(IsSoundPcdText(begin + sizes(14, 12) + points));
  EXPECT_FALSE(IsSoundPcdText(begin + sizes(13, 24) + points));
  EXPECT_FALSE(IsSoundPcdText(begin + sizes(0, 12) + points));
  EXPECT_FALSE(IsSoundPcdText(begin + "1234"));
}

TEST(PcdCheck, FieldsMustBeDescribed) {
  const std::string end = "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n";
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin + end));
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin + ("FIELDS x y\nSIZE 4\nTYPE F F\n" + end)));
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin + ("FIELDS x\nSIZE 3\nTYPE F\n" + end)));
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin + ("FIELDS x\nSIZE 4\nTYPE Z\n" + end)));
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin + ("FIELDS x\nSIZE 4\nTYPE F\nCOUNT 4294967295\n" + end)));
  EXPECT_TRUE(IsSoundPcdText(kPcdBegin + ("FIELDS x _\nSIZE 4 1\nTYPE F U\nCOUNT 1 12\n" + end)));
}

TEST(PcdCheck, LinesMustBeThoseOfTheFormatInItsOrder) {
  const std::string end = "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n";
  EXPECT_TRUE(IsSoundPcdText(std::string("\n# a comment\n") + kFields + end));
  EXPECT_FALSE(IsSoundPcdText(std::string("rERSION 0.7\n") + kFields + end));
  EXPECT_FALSE(IsSoundPcdText(std::string(kFields) + kFields + end));
  EXPECT_FALSE(IsSoundPcdText("SIZE 4\nFIELDS x\nTYPE F\n" + end));
}

// PCL would take such points for lines of the header.
TEST(PcdCheck, PointsMustNotLookLikeAHeader) {
  const std::string begin = With("WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n");
  for (const std::string points : {"COLUMNS x y z", "\n SIZES4444444", "#\n\nDATA binary"}) {
    EXPECT_FALSE(IsSoundPcdText(begin + points)) << points;
  }
  EXPECT_TRUE(IsSoundPcdText(begin + "#umns\n columns"));
}

TEST(PcdCheck, TextThatIsNoHeaderIsNot) {
  EXPECT_FALSE(IsSoundPcdText(""));
  EXPECT_FALSE(IsSoundPcdText(kPcdBegin));
  EXPECT_FALSE(IsSoundPcdText(With("WIDTH 1\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n")));
  EXPECT_FALSE(IsSoundPcdText(With("WIDTH -1\nHEIGHT 1\nDATA ascii\n")));
  EXPECT_FALSE(IsSoundPcdText(std::string(100'000, 'a')));
}

}  // namespace
}  // namespace lio
