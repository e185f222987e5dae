// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Declares the parts that the commands of lio-eval share.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lio {

inline constexpr char kProgram[] = "lio-eval";

// Tells the message on one line of stderr; gives the exit code back.
int Fail(int exit_code, const std::string& message);

// kExitDone, or kExitUsage after telling that the file cannot be written.
int WriteJson(const std::string& file, const nlohmann::ordered_json& json);

// The command "consistency"; argv[0] is that word.
int ConsistencyMain(int argc, const char* const* argv);

}  // namespace lio
