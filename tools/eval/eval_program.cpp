// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "eval_program.hpp"

#include <iostream>

#include "lio/io/output_file.hpp"

namespace lio {

int Fail(int exit_code, const std::string& message) {
  std::cerr << kProgram << ": " << message << "\n";
  return exit_code;
}

void WriteJson(const std::string& file, const nlohmann::ordered_json& json) {
  WriteText(file, json.dump(2) + "\n", OutputFile::Links::kFollowed);
}

}  // namespace lio
