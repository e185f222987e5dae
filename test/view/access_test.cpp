// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/access.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

const std::string kShortToken = "0123456789abcdef";

TEST(Access, OnlyTheWholeTokenIsTheToken) {
  EXPECT_TRUE(IsToken(kShortToken, kShortToken));
  EXPECT_FALSE(IsToken(kShortToken, ""));
  EXPECT_FALSE(IsToken("", ""));
  EXPECT_FALSE(IsToken("", "x"));
  EXPECT_FALSE(IsToken(kShortToken, kShortToken.substr(1)));
  EXPECT_FALSE(IsToken(kShortToken, kShortToken + kShortToken));
  EXPECT_FALSE(IsToken(kShortToken, "0123456789abcdeF"));
}

TEST(Access, ATokenIsLongEnoughAndStandsInAnAddress) {
  EXPECT_EQ(WhyNoToken(kShortToken), "");
  EXPECT_EQ(WhyNoToken(RandomToken()), "");
  EXPECT_NE(WhyNoToken("short"), "");
  EXPECT_NE(WhyNoToken(kShortToken + "&a=b"), "");
  EXPECT_NE(WhyNoToken(std::string(129, 'a')), "");
}

TEST(Access, MadeTokensDiffer) {
  EXPECT_EQ(RandomToken().size(), 32U);
  EXPECT_NE(RandomToken(), RandomToken());
}

TEST(Access, TheTokenIsReadFromTheAddress) {
  EXPECT_EQ(ParseTarget("/data").path, "/data");
  EXPECT_EQ(ParseTarget("/data").token, "");
  EXPECT_EQ(ParseTarget("/data?token=abc").token, "abc");
  EXPECT_EQ(ParseTarget("/data?a=b&token=abc&c").token, "abc");
  EXPECT_EQ(ParseTarget("/data?token=").token, "");
  EXPECT_EQ(ParseTarget("?&&=").path, "");
  EXPECT_EQ(ParseTarget("").path, "");
}

TEST(Access, WithoutATokenOnlyNamesOfThisMachineAreServed) {
  for (const char* host :
       {"localhost", "localhost:8080", "127.0.0.1:8080", "[::1]:8080", "[::1]"}) {
    EXPECT_TRUE(MaySee({host, "", ""}, "")) << host;
  }
  for (const char* host :
       {"", "evil.example:8080", "127.0.0.1.evil.example", "[::1", "localhost."}) {
    EXPECT_FALSE(MaySee({host, "", ""}, "")) << host;
  }
}

TEST(Access, AnotherSitesPageIsTurnedAway) {
  EXPECT_TRUE(MaySee({"localhost:8080", "http://localhost:8080", ""}, ""));
  for (const char* origin : {"http://evil.example", "http://localhost:9090", "null", "http://"}) {
    EXPECT_FALSE(MaySee({"localhost:8080", origin, ""}, "")) << origin;
  }
  EXPECT_FALSE(MaySee({"localhost:8080", "http://evil.example", kShortToken}, kShortToken));
}

TEST(Access, WithATokenItDecides) {
  EXPECT_TRUE(
      MaySee({"robot.example:8080", "http://robot.example:8080", kShortToken}, kShortToken));
  EXPECT_FALSE(MaySee({"robot.example:8080", "", ""}, kShortToken));
  EXPECT_FALSE(MaySee({"localhost:8080", "", ""}, kShortToken));
}

}  // namespace
}  // namespace lio
