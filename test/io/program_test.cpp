// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A stdout that takes nothing is tested with the programs: test/integration.
#include "lio/io/program.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

template <class Error>
int CodeAfter() {
  return RunProgram("lio-test", []() -> int { throw Error("what happened"); });
}

TEST(Program, TheBodysCodeIsTheProgramsCode) {
  EXPECT_EQ(RunProgram("lio-test", [] { return 0; }), kExitDone);
  EXPECT_EQ(RunProgram("lio-test", [] { return 6; }), kExitNoTrust);
}

TEST(Program, ExceptionsHaveTheirCodesAndOneLine) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(CodeAfter<WriteError>(), kExitWriteFailed);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "lio-test: what happened\n");
  EXPECT_EQ(CodeAfter<UsageError>(), kExitUsage);
  EXPECT_EQ(CodeAfter<OutputError>(), kExitUsage);
  EXPECT_EQ(CodeAfter<InputError>(), kExitUnusableInput);
  EXPECT_EQ(CodeAfter<std::runtime_error>(), kExitUnusableInput);
}

}  // namespace
}  // namespace lio
