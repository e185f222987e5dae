// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/printable.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(Printable, OrdinaryTextStaysAsItIs) {
  for (const char* text : {"", "/velodyne_points", "a b",
                           "Gr\xC3\xBC\xC3\x9F"
                           "e \xE6\x97\xA5 \xF0\x9F\x9A\x97"}) {
    EXPECT_EQ(Printable(text), text);
  }
}

TEST(Printable, WhatATerminalWouldObeyIsEscaped) {
  EXPECT_EQ(Printable("/velo\x1b]0;owned\x07"), "/velo\\x1b]0;owned\\x07");
  EXPECT_EQ(Printable("/gt\nlio-convert: all is well\r"), "/gt\\nlio-convert: all is well\\x0d");
  EXPECT_EQ(Printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m")
      << "CSI as UTF-8";
  EXPECT_EQ(Printable("\x9B"
                      "31m"),
            "\\x9b31m")
      << "CSI as one byte";
  EXPECT_EQ(Printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(Printable("\xE6\x97"), "\\xe6\\x97") << "a cut sequence";
}

TEST(Printable, AnExcerptIsShort) {
  EXPECT_EQ(Excerpt("short"), "short");
  EXPECT_EQ(Excerpt(std::string(10'000, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace lio
