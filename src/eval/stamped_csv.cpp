// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/stamped_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  if (line.ends_with('\r')) line.remove_suffix(1);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : name_(file.string()), stream_(file) {
    if (!stream_ || std::filesystem::is_directory(file)) {
      throw std::runtime_error(name_ + ": cannot be read");
    }
  }

  StampedTable Read(const std::vector<std::string>& wanted) {
    ReadHeader(wanted);
    std::string line;
    while (std::getline(stream_, line)) {
      ++line_number_;
      if (line.empty()) continue;
      const std::size_t num_rows = table_.rows.size();
      const bool has_line_feed = !stream_.eof();
      try {
        ReadRow(line);
      } catch (const std::runtime_error&) {
        if (has_line_feed) throw;
        table_.stamps.resize(num_rows);
        table_.rows.resize(num_rows);
        TellCutLine(name_);
      }
    }
    return std::move(table_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line_number_, message));
  }

  void ReadHeader(const std::vector<std::string>& wanted) {
    std::string line;
    line_number_ = 1;
    if (!std::getline(stream_, line)) Fail("has no header");
    const std::vector<std::string_view> names = Cells(line);
    if (names[0] != "t_s") Fail("the first column must be t_s");
    num_cells_ = names.size();
    table_.columns = wanted;
    if (wanted.empty()) table_.columns.assign(names.begin() + 1, names.end());
    for (const std::string& column : table_.columns) {
      const auto found = std::find(names.begin(), names.end(), column);
      if (found == names.end()) Fail("has no column " + column);
      indices_.push_back(static_cast<std::size_t>(found - names.begin()));
    }
  }

  void ReadRow(std::string_view line) {
    const std::vector<std::string_view> cells = Cells(line);
    if (cells.size() != num_cells_) {
      Fail(fmt::format("has {} cells, the header {}", cells.size(), num_cells_));
    }
    const std::optional<Timestamp> stamp = ParseStamp(cells[0]);
    if (!stamp) Fail(fmt::format("t_s ('{}') is no stamp in seconds", cells[0].substr(0, 40)));
    table_.stamps.push_back(*stamp);
    std::vector<double>& row = table_.rows.emplace_back();
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      row.push_back(Number(cells[indices_[i]], table_.columns[i]));
    }
  }

  double Number(std::string_view text, const std::string& column) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      Fail(fmt::format("{} ('{}') is no finite number", column, text.substr(0, 40)));
    }
    return value;
  }

  std::string name_;
  std::ifstream stream_;
  std::int64_t line_number_ = 0;
  std::size_t num_cells_ = 0;
  std::vector<std::size_t> indices_;  // positions of the wanted columns in a row
  StampedTable table_;
};

}  // namespace

StampedTable ReadStampedCsv(const std::filesystem::path& file,
                            const std::vector<std::string>& wanted) {
  return Reader(file).Read(wanted);
}

}  // namespace lio
