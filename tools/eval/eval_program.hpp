// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Helps the commands of lio-eval.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lio {

inline constexpr char kProgram[] = "lio-eval";

// Writes the message on one line of stderr and returns the exit code.
int Fail(int exit_code, const std::string& message);

// Writes the file. Returns kExitDone, or kExitUsage after an error message.
void WriteJson(const std::string& file, const nlohmann::ordered_json& json);

// Runs the command "consistency"; argv[0] is that word.
int ConsistencyMain(int argc, const char* const* argv);

}  // namespace lio
