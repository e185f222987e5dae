// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A file that is written as a stream and knows its path, for errors that name it.
#pragma once

#include <filesystem>
#include <fstream>

namespace lio {

struct OutputFile {
  std::filesystem::path path;
  std::ofstream stream;
};

// Overwrites an existing file. Throws std::runtime_error naming the file when it cannot.
[[nodiscard]] OutputFile OpenOutput(const std::filesystem::path& path);
// Throws std::runtime_error naming the file when it could not be written in full.
void Close(OutputFile& file);

}  // namespace lio
