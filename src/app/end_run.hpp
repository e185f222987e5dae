// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How a run of liod ends: the files are completed, and the exit code says why it ended.
#pragma once

#include <string>

#include "app/live_runner.hpp"
#include "lio/io/command_line.hpp"

namespace lio {

// True when there is nothing more to wait for: the bus has ended or a thread has failed.
[[nodiscard]] bool IsOver(const LiveRunner& runner);

// Tells the verdict on stderr, through the log.
void TellVerdict(const Verdict& verdict);

// Stops the runner and tells in one line on stderr why, unless it was asked to end or a log that
// `lcm_url` names is over; then it tells the verdict on the run and writes its page. Returns the
// exit code, which is kExitNoTrust where files were written that cannot be trusted, and
// kExitWriteFailed where they could not be completed.
[[nodiscard]] ExitCode EndRun(LiveRunner& runner, const std::string& lcm_url);

}  // namespace lio
