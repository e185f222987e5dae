// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The outermost part of every program: it makes the exit code.
#pragma once

#include <functional>
#include <string>

namespace lio {

// Runs `body` and returns its exit code. Exceptions are told in one line on stderr: kExitUsage
// after UsageError and OutputError, kExitWriteFailed after WriteError, and kExitUnusableInput after
// any other. A stdout that could not be written in full is told likewise; the code is then
// kExitWriteFailed, unless the body failed on its own. A file that would grow beyond the limit of
// the shell (ulimit -f) is a WriteError and does not kill the program.
[[nodiscard]] int RunProgram(const std::string& name, const std::function<int()>& body);

}  // namespace lio
