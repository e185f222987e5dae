// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/pcd_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/cloud_header.hpp"

namespace lio {
namespace {

using Words = std::vector<std::string>;

constexpr std::uint64_t kMaxPoints = 1'000'000'000;
constexpr std::uint64_t kMaxStepBytes = 4096;  // size of one point
constexpr std::uint64_t kMaxRatio = 100;       // LZF packs 264 bytes into 3 at best
constexpr int kMaxWord = 16;                   // characters; no key is as long

std::optional<std::uint64_t> Number(const std::string& word) {
  if (word.empty() || word.size() > 10 ||
      word.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return std::stoull(word);
}

// The keys are in the order of the format; PCL breaks down over another order, and over any other
// word.
enum Key { kVersion, kFields, kSize, kType, kCount, kWidth, kHeight, kViewpoint, kPoints, kData };
constexpr std::array<std::string_view, 10> kKeys{
    "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

struct Header {
  std::array<Words, kKeys.size()> words;  // behind each key

  [[nodiscard]] const Words& Of(Key key) const { return words[key]; }

  // Bytes of a point; nothing where the fields are not described.
  [[nodiscard]] std::optional<std::uint64_t> Step() const {
    const Words &sizes = Of(kSize), &types = Of(kType), &counts = Of(kCount);
    const std::size_t num = Of(kFields).size();
    const bool has_counts = !counts.empty();
    if (num == 0 || sizes.size() != num || types.size() != num ||
        (has_counts && counts.size() != num)) {
      return std::nullopt;
    }
    std::uint64_t step = 0;
    for (std::size_t i = 0; i < num; ++i) {
      const auto size = Number(sizes[i]);
      const auto count = has_counts ? Number(counts[i]) : 1;
      const bool is_known = types[i] == "F" || types[i] == "I" || types[i] == "U";
      if (!is_known || !size || !count || *count == 0) return std::nullopt;
      if (*size != 1 && *size != 2 && *size != 4 && *size != 8) return std::nullopt;
      step += *size * *count;
      if (step > kMaxStepBytes) return std::nullopt;
    }
    return step;
  }

  [[nodiscard]] std::optional<std::uint64_t> NumPoints() const {
    const Words &height = Of(kHeight), &points = Of(kPoints);
    if (Of(kWidth).size() != 1) return std::nullopt;
    const auto columns = Number(Of(kWidth)[0]);
    const auto rows = height.size() == 1 ? Number(height[0]) : 1;
    if (!columns || !rows || *columns * *rows > kMaxPoints) return std::nullopt;
    const std::uint64_t num = *columns * *rows;
    if (points.size() == 1 && Number(points[0]) != num) return std::nullopt;
    return num;
  }
};

// Reads up to the line DATA, after which the stream stands at the points.
std::optional<Header> ReadHeader(std::istream& file) {
  Header header;
  std::size_t num_passed = 0;  // keys that may not come any more
  std::string line;
  for (int i = 0; i < kMaxPcdHeaderLines && std::getline(file, line); ++i) {
    if (line.size() > kMaxHeaderLineBytes) return std::nullopt;
    std::istringstream stream(line);
    std::string word;
    if (!(stream >> word) || word.front() == '#') continue;
    if (word == "COLUMNS") word = kKeys[kFields];
    const auto key =
        std::find(kKeys.begin() + static_cast<std::ptrdiff_t>(num_passed), kKeys.end(), word);
    if (key == kKeys.end()) return std::nullopt;
    const auto at = static_cast<std::size_t>(key - kKeys.begin());
    num_passed = at + 1;
    header.words[at] = Words(std::istream_iterator<std::string>(stream), {});
    if (at == kData) return header;
  }
  return std::nullopt;
}

// PCL looks for lines of the header behind the line DATA, too, and breaks down where the points
// look like one. It leaves out comments and empty lines, and takes any word that begins with a key.
bool BeginsLikeHeader(std::istream& file) {
  std::string word;
  while (file >> std::setw(kMaxWord) >> word) {
    if (word.front() != '#') break;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  const auto is_begin = [&](std::string_view key) { return word.starts_with(key); };
  return std::ranges::any_of(kKeys, is_begin) || is_begin("COLUMNS");
}

// Checks the sizes that stand before compressed points against those of the header and of the file.
bool IsSoundCompressed(std::istream& file, std::uint64_t num_rest, std::uint64_t num_points_bytes) {
  std::array<std::uint8_t, 8> bytes{};
  if (!file.read(reinterpret_cast<char*>(bytes.data()), bytes.size())) return false;
  const auto little_endian = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes[at + i];
    return value;
  };
  const std::uint64_t packed = little_endian(0);
  return packed > 0 && packed <= num_rest - bytes.size() && little_endian(4) == num_points_bytes &&
         num_points_bytes <= kMaxRatio * packed;
}

}  // namespace

bool IsSoundPcd(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::optional<Header> header = ReadHeader(file);
  if (!header || header->Of(kData).size() != 1) return false;
  const auto step = header->Step();
  const auto num_points = header->NumPoints();
  if (!step || !num_points) return false;
  const std::uint64_t num_rest =
      std::filesystem::file_size(path) - static_cast<std::uint64_t>(file.tellg());
  const std::streampos begin = file.tellg();
  if (BeginsLikeHeader(file)) return false;
  file.clear();
  file.seekg(begin);
  const std::uint64_t num_bytes = *num_points * *step;
  const std::string& kind = header->Of(kData)[0];
  if (kind == "binary") return num_bytes <= num_rest;
  if (kind == "binary_compressed") return IsSoundCompressed(file, num_rest, num_bytes);
  return kind == "ascii" && *num_points <= num_rest;
}

}  // namespace lio
