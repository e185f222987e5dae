// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws pictures with the Python scripts in tools/plot, which run as a child process.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lio {

// Runs `script` with the data (as a temporary JSON file, its first argument) and `arguments`.
// The script is looked for in LIO_PLOT_DIR, beside the program (../share/liod/plot,
// ../../tools/plot), and in the source tree; the interpreter is LIO_PYTHON or /usr/bin/python3.
// Returns the exit code to end with: kExitDone; the script's own after its error message; or
// kExitConfiguration, after an error message, when script or interpreter are missing.
int RunPlot(const std::string& program, const std::string& script,
            const nlohmann::ordered_json& data, const std::vector<std::string>& arguments);

}  // namespace lio
