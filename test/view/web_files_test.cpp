// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/web_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace lio {
namespace {

std::string Content(std::string_view path) {
  const auto file = FindWebFile(path);
  return file ? std::string(file->content) : "";
}

std::string Path(const std::string& name) {
  return std::string("/").append(name);
}

TEST(WebFiles, ThePageAndAllThatItNamesAreThere) {
  const std::string page = Content("/");
  EXPECT_EQ(FindWebFile("/")->type, "text/html; charset=utf-8");
  const std::regex link("(?:src|href)=\"([^\":]+)\"");
  int num = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++num) {
    EXPECT_TRUE(FindWebFile(Path((*at)[1].str()))) << (*at)[1];
  }
  EXPECT_GE(num, 4);
}

TEST(WebFiles, EveryModuleThatAModuleNamesIsThere) {
  const std::regex import("from \"\\./([^\"]+)\"");
  for (const char* path : {"/main.js", "/stage.js", "/cloud.js", "/track.js", "/plots.js"}) {
    const std::string script = Content(path);
    ASSERT_FALSE(script.empty()) << path;
    for (std::sregex_iterator at(script.begin(), script.end(), import), end; at != end; ++at) {
      EXPECT_TRUE(FindWebFile(Path((*at)[1].str()))) << path << ": " << (*at)[1];
    }
  }
}

TEST(WebFiles, NoFileOfOursNamesAnotherHost) {
  for (const char* path :
       {"/", "/view.css", "/main.js", "/link.js", "/frames.js", "/stage.js", "/cloud.js",
        "/splats.js", "/track.js", "/panel.js", "/plots.js", "/timeline.js"}) {
    EXPECT_THAT(Content(path), ::testing::Not(::testing::HasSubstr("://"))) << path;
  }
}

TEST(WebFiles, LicencesAreServed) {
  EXPECT_THAT(Content("/licence/three.txt"), ::testing::HasSubstr("three.js authors"));
  EXPECT_THAT(Content("/licence/uplot.txt"), ::testing::HasSubstr("Leon Sorokin"));
}

TEST(WebFiles, OtherPathsAreNotThere) {
  for (const char* path : {"", "/..", "/../etc/passwd", "//", "/main.js/", "/Main.js", "main.js"}) {
    EXPECT_FALSE(FindWebFile(path)) << path;
  }
}

}  // namespace
}  // namespace lio
