// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes the bytes of an MCAP file apart, for the tests of exports.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lio::test {

class McapCursor {
 public:
  explicit McapCursor(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t Number(int num_bytes) {
    std::uint64_t value = 0;
    const std::string_view raw = Take(static_cast<std::size_t>(num_bytes));
    for (std::size_t i = raw.size(); i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(raw[i]);
    }
    return value;
  }
  std::string_view Text() { return Take(Number(4)); }
  std::string_view Take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("the MCAP file ends too early");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  [[nodiscard]] bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

struct McapPart {
  std::uint8_t op = 0;
  std::string_view content;
  std::size_t begin = 0;  // in the bytes given
  std::size_t end = 0;
};

// Returns the records one behind another, of a file's bytes between its magics or of a chunk.
inline std::vector<McapPart> McapParts(std::string_view bytes, std::size_t begin, std::size_t end) {
  std::vector<McapPart> parts;
  while (begin < end) {
    McapCursor cursor(bytes.substr(begin, end - begin));
    McapPart part;
    part.begin = begin;
    part.op = static_cast<std::uint8_t>(cursor.Number(1));
    part.content = cursor.Take(cursor.Number(8));
    begin += 9 + part.content.size();
    part.end = begin;
    parts.push_back(part);
  }
  return parts;
}

}  // namespace lio::test
