// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/ply_check.hpp"

#include <gtest/gtest.h>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

bool IsSoundPlyText(const std::string& text) {
  const test::TempDir folder;
  return IsSoundPly(folder.Write("cloud.ply", text));
}

const std::string kPlyBegin = "ply\nformat ascii 1.0\n";
const std::string kPoint = "property float x\nproperty float y\nproperty float z\nend_header\n";

TEST(PlyCheck, FilesThatHoldTheirElementsAreSound) {
  EXPECT_TRUE(IsSoundPlyText(kPlyBegin + "element vertex 1\n" + kPoint + "1 2 3\n"));
  EXPECT_TRUE(
      IsSoundPlyText(kPlyBegin + "comment by hand\nobj_info none\nelement vertex 0\n" + kPoint));
  EXPECT_TRUE(IsSoundPlyText("ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nend_header\r\n1\r\n"));
}

TEST(PlyCheck, FilesThatCannotHoldThemAreNot) {
  EXPECT_FALSE(IsSoundPlyText(kPlyBegin + "element vertex 4294967295\n" + kPoint + "1 2 3\n"));
  EXPECT_FALSE(IsSoundPlyText(kPlyBegin + "element vertex -1\n" + kPoint + "1 2 3\n"));
  EXPECT_FALSE(
      IsSoundPlyText(kPlyBegin + "element vertex 99999999999999999999\n" + kPoint + "1 2 3\n"));
}

TEST(PlyCheck, LinesMustBeThoseOfTheFormat) {
  EXPECT_FALSE(IsSoundPlyText("ply\n"));
  EXPECT_FALSE(IsSoundPlyText(kPlyBegin + "element vertex 0\n"));
  EXPECT_FALSE(IsSoundPlyText(kPlyBegin + " obj_info none\n" + kPoint));
  EXPECT_FALSE(IsSoundPlyText(kPlyBegin + "elephant vertex 0\n" + kPoint));
  EXPECT_FALSE(IsSoundPlyText("ply\n" + std::string(100'000, 'a')));
}

}  // namespace
}  // namespace lio
