// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/ply_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "io/cloud_header.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxDigits = 10;
constexpr std::array<std::string_view, 5> kWords{"format", "comment", "obj_info", "element",
                                                 "property"};

// Returns the number of elements that a line states; 0 for a line about something else. A count
// that is no number is more than any file holds.
std::uint64_t NumElements(const std::string& line) {
  std::istringstream words(line);
  std::string word, name, count;
  words >> word >> name >> count;
  if (word != "element") return 0;
  const bool is_number = !count.empty() && count.size() <= kMaxDigits &&
                         count.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::stoull(count) : UINT64_MAX / kMaxPlyHeaderLines;
}

}  // namespace

bool IsSoundPly(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t num_elements = 0;
  std::string line;
  std::getline(file, line);  // "ply", by which the file was found to be one
  for (int i = 0; i < kMaxPlyHeaderLines && std::getline(file, line); ++i) {
    if (line.size() > kMaxHeaderLineBytes) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == "end_header") {
      const auto num_rest =
          std::filesystem::file_size(path) - static_cast<std::uint64_t>(file.tellg());
      return num_elements <= num_rest;  // none is smaller than a byte
    }
    // PCL asserts that the word obj_info stands at the begin of its line.
    const std::string word = line.substr(0, line.find(' '));
    if (std::find(kWords.begin(), kWords.end(), word) == kWords.end()) return false;
    num_elements += NumElements(line);
  }
  return false;
}

}  // namespace lio
