// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the launcher's messages; SpyTypes (test/spy) tests that liod's types decode in Java.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

const std::string kSpy = test::Program("lio-spy");

TEST(LioSpy, HelpTeachesAndVersionTells) {
  const auto help = test::RunProgram({kSpy, "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("lio-spy -- --lcm-url="));
  EXPECT_EQ(test::RunProgram({kSpy, "--version"}).exit_code, 0);
}

TEST(LioSpy, ArgumentsOfLcmSpyStandBehindTwoDashes) {
  const auto result = test::RunProgram({kSpy, "-l"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("after --"));
}

TEST(LioSpy, WhatIsMissingIsNamedWithThePackageThatHasIt) {
  const auto result = test::RunProgram({kSpy}, {"LIO_JCHART2D_JAR=/nonexistent.jar", "DISPLAY="});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, ::testing::ContainsRegex("apt install|setup.sh --spy"));
}

}  // namespace
}  // namespace lio
