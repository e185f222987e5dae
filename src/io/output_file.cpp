// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_file.hpp"

#include <stdexcept>

namespace lio {

OutputFile OpenOutput(const std::filesystem::path& path) {
  OutputFile file{path, std::ofstream(path, std::ios::binary | std::ios::trunc)};
  if (!file.stream) throw std::runtime_error("cannot write " + path.string());
  return file;
}

void Close(OutputFile& file) {
  file.stream.close();
  if (!file.stream) throw std::runtime_error("cannot write " + file.path.string() + " in full");
}

}  // namespace lio
