// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "eval_program.hpp"

#include <fstream>
#include <iostream>

#include "lio/io/command_line.hpp"

namespace lio {

int Fail(int exit_code, const std::string& message) {
  std::cerr << kProgram << ": " << message << "\n";
  return exit_code;
}

int WriteJson(const std::string& file, const nlohmann::ordered_json& json) {
  std::ofstream stream(file, std::ios::trunc);
  stream << json.dump(2) << "\n";
  stream.close();
  return stream ? kExitDone : Fail(kExitUsage, file + ": cannot be written");
}

}  // namespace lio
