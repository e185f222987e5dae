// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compresses bytes and files as ROS 2's recorder does.
#pragma once

#include <zstd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace lio::test {

inline std::string ZstdFrame(const std::string& bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 1));
  return frame;
}

// Puts file.zstd in the place of file.
inline void CompressFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  std::ofstream(file.string() + ".zstd", std::ios::binary) << ZstdFrame(bytes);
  std::filesystem::remove(file);
}

// The metadata of a ROS 2 bag that says "zstd" and this mode, in the place of "not compressed".
inline std::string WithCompression(std::string metadata, const std::string& mode) {
  const std::string none = "compression_format: \"\"\n  compression_mode: \"\"\n";
  const std::size_t at = metadata.find(none);
  if (at == std::string::npos) return metadata;
  return metadata.replace(at, none.size(),
                          "compression_format: zstd\n  compression_mode: " + mode + "\n");
}

}  // namespace lio::test
