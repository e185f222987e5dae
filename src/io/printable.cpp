// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace lio {
namespace {

// Returns the length of the UTF-8 sequence that the text begins with; 0 where there is none.
std::size_t SequenceBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  const std::size_t size = lead < 0x80   ? 1
                           : lead < 0xC2 ? 0
                           : lead < 0xE0 ? 2
                           : lead < 0xF0 ? 3
                                         : 4;
  if (lead >= 0xF5 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  return size;
}

// Says yes to the controls below 0x20, 0x7f, and those of U+0080 to U+009F.
bool IsControl(std::string_view sequence) {
  const auto first = static_cast<std::uint8_t>(sequence[0]);
  if (sequence.size() == 1) return first < 0x20 || first == 0x7F;
  return first == 0xC2 && static_cast<std::uint8_t>(sequence[1]) < 0xA0;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string printable;
  while (!text.empty()) {
    const std::size_t size = SequenceBytes(text);
    const std::string_view sequence = text.substr(0, std::max<std::size_t>(1, size));
    text.remove_prefix(sequence.size());
    if (sequence == "\n") {
      printable += "\\n";
    } else if (size == 0 || IsControl(sequence)) {
      for (const char c : sequence) {
        printable += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(c));
      }
    } else {
      printable += sequence;
    }
  }
  return printable;
}

std::string Excerpt(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return Printable(text);
  return Printable(text.substr(0, max_bytes)) + "...";
}

}  // namespace lio
