// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/trajectory_file.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "lio/base/stamp_limit.hpp"
#include "lio/io/output_file.hpp"

namespace lio {
namespace {

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;
constexpr double kMaxPosition_m = 1e12;     // more is a damaged number; squares of less stay finite
constexpr double kMaxRotationError = 1e-2;  // so that files with three decimals are accepted

std::vector<std::string_view> SplitWords(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::optional<double> ParseFinite(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Reads a file line by line and keeps the position for messages.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : name_(file.string()) {}

  void Add(std::string_view line) {
    ++line_number_;
    const std::vector<std::string_view> words = SplitWords(line);
    if (words.empty() || words[0].starts_with('#')) return;
    if (num_columns_ == 0) DecideFormat(words.size());
    if (words.size() != num_columns_) {
      Fail(fmt::format("has {} columns, the rows before have {}", words.size(), num_columns_));
    }
    trajectory_.poses.push_back(trajectory_.format == TrajectoryFormat::kTum ? TumPose(words)
                                                                             : KittiPose(words));
  }

  [[nodiscard]] bool empty() const { return trajectory_.poses.empty(); }

  Trajectory Finish() {
    if (trajectory_.poses.empty()) throw std::runtime_error(name_ + ": holds no pose");
    return std::move(trajectory_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line_number_, message));
  }
  [[noreturn]] void FailColumn(std::size_t index, std::string_view word, const char* what) const {
    Fail(fmt::format("column {} ('{}') {}", index + 1, word.substr(0, 40), what));
  }

  void DecideFormat(std::size_t num_columns) {
    if (num_columns != kTumColumns && num_columns != kKittiColumns) {
      Fail(fmt::format("has {} columns; TUM has 8 (t x y z qx qy qz qw), KITTI 12", num_columns));
    }
    num_columns_ = num_columns;
    const bool is_tum = num_columns == kTumColumns;
    trajectory_.format = is_tum ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti;
  }

  double Number(const std::vector<std::string_view>& words, std::size_t index) const {
    const std::optional<double> value = ParseFinite(words[index]);
    if (!value) FailColumn(index, words[index], "is no finite number");
    return *value;
  }

  double Metres(const std::vector<std::string_view>& words, std::size_t index) const {
    const double value = Number(words, index);
    if (std::abs(value) > kMaxPosition_m) FailColumn(index, words[index], "is beyond 1e12 m");
    return value;
  }

  StampedPose TumPose(const std::vector<std::string_view>& words) const {
    const std::optional<Timestamp> stamp = ParseStamp(words[0]);
    if (!stamp) FailColumn(0, words[0], "is no stamp in seconds");
    if (!trajectory_.poses.empty() && *stamp <= trajectory_.poses.back().stamp) {
      FailColumn(0, words[0], "is not above the stamp of the row before");
    }
    StampedPose row;
    row.stamp = *stamp;
    row.pose.translation = Vector3(Metres(words, 1), Metres(words, 2), Metres(words, 3));
    const double x = Number(words, 4), y = Number(words, 5), z = Number(words, 6);
    const Quaternion rotation(Number(words, 7), x, y, z);
    if (std::abs(rotation.norm() - 1.0) > kMaxRotationError) {
      Fail(fmt::format("columns 5 to 8 are no rotation: their norm is {:.4g}", rotation.norm()));
    }
    row.pose.rotation = rotation.normalized();
    return row;
  }

  StampedPose KittiPose(const std::vector<std::string_view>& words) const {
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix;
    for (std::size_t i = 0; i < kKittiColumns; ++i) matrix.data()[i] = Metres(words, i);
    const Matrix3 rotation = matrix.leftCols<3>();
    const double error = (rotation.transpose() * rotation - Matrix3::Identity()).norm();
    if (error > kMaxRotationError || rotation.determinant() < 0) {
      Fail("columns 1-3, 5-7 and 9-11 are no rotation matrix");
    }
    const Eigen::JacobiSVD<Matrix3> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix3 nearest = svd.matrixU() * svd.matrixV().transpose();
    const auto index = static_cast<std::int64_t>(trajectory_.poses.size());
    return {Timestamp{index}, {Quaternion(nearest).normalized(), matrix.col(3)}};
  }

  std::string name_;
  std::int64_t line_number_ = 0;
  std::size_t num_columns_ = 0;
  Trajectory trajectory_;
};

template <class RowText>
void WriteRows(const std::filesystem::path& file, const StampedPoses& poses, RowText row_text) {
  OutputFile output(file, OutputFile::Links::kFollowed);
  for (const StampedPose& pose : poses) output.Write(row_text(pose) + "\n");
  output.Close();
}

std::string KittiRow(const StampedPose& row) {
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> matrix;
  matrix << row.pose.rotation.toRotationMatrix(), row.pose.translation;
  return fmt::format("{:.12e}", fmt::join(matrix.data(), matrix.data() + kKittiColumns, " "));
}

// Holds the parts of a decimal number: digits without leading zeros, times 10^exponent.
struct Decimal {
  bool is_negative = false;
  std::string digits;
  int exponent = 0;
};

std::optional<Decimal> SplitDecimal(std::string_view text) {
  Decimal decimal;
  decimal.is_negative = text.starts_with('-');
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  bool has_digit = false, has_point = false;
  std::size_t i = 0;
  for (; i < text.size() && (text[i] == '.' || (text[i] >= '0' && text[i] <= '9')); ++i) {
    if (text[i] == '.') {
      if (has_point) return std::nullopt;
      has_point = true;
      continue;
    }
    has_digit = true;
    if (has_point) --decimal.exponent;
    if (!decimal.digits.empty() || text[i] != '0') decimal.digits += text[i];
  }
  if (!has_digit) return std::nullopt;
  if (i == text.size()) return decimal;
  if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
  text.remove_prefix(i + 1);
  if (text.starts_with('+')) text.remove_prefix(1);
  int exponent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (std::abs(exponent) > 1000) return std::nullopt;
  decimal.exponent += exponent;
  return decimal;
}

}  // namespace

std::optional<Timestamp> ParseStamp(std::string_view text) {
  std::optional<Decimal> decimal = SplitDecimal(text);
  if (!decimal) return std::nullopt;
  // Converts to nanoseconds: drops the digits below one, rounding by the first of them, or appends
  // zeros.
  const long num_digits = static_cast<long>(decimal->digits.size()) + decimal->exponent + 9;
  if (decimal->digits.empty() || num_digits < 0) return Timestamp{0};
  if (num_digits > 19) return std::nullopt;
  const auto size = static_cast<std::size_t>(num_digits);
  const bool rounds_up = size < decimal->digits.size() && decimal->digits[size] >= '5';
  decimal->digits.resize(size, '0');
  std::uint64_t magnitude = rounds_up ? 1 : 0;
  if (size > 0) magnitude += std::stoull(decimal->digits);
  if (magnitude > static_cast<std::uint64_t>(kMaxStamp_ns)) return std::nullopt;
  const auto ns = static_cast<std::int64_t>(magnitude);
  return Timestamp{decimal->is_negative ? -ns : ns};
}

std::string StampText(Timestamp stamp) {
  constexpr std::uint64_t kNsPerSecond = 1'000'000'000;
  const std::uint64_t magnitude = stamp.ns < 0 ? 0 - static_cast<std::uint64_t>(stamp.ns)
                                               : static_cast<std::uint64_t>(stamp.ns);
  return fmt::format("{}{}.{:09}", stamp.ns < 0 ? "-" : "", magnitude / kNsPerSecond,
                     magnitude % kNsPerSecond);
}

std::string TumRow(const StampedPose& row) {
  const Vector3& p = row.pose.translation;
  const Quaternion& q = row.pose.rotation;
  return fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}", StampText(row.stamp),
                     p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

void TellCutLine(const std::filesystem::path& file) {
  fmt::print(stderr, "{}: the last line is cut and is left out\n", file.string());
}

Trajectory ReadTrajectory(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw std::runtime_error(file.string() + ": cannot be read");
  }
  Reader reader(file);
  for (std::string line; std::getline(stream, line);) {
    const bool has_line_feed = !stream.eof();
    try {
      reader.Add(line);
    } catch (const std::runtime_error&) {
      if (has_line_feed || reader.empty()) throw;
      TellCutLine(file);
    }
  }
  return reader.Finish();
}

void WriteTum(const std::filesystem::path& file, const StampedPoses& poses) {
  WriteRows(file, poses, TumRow);
}

void WriteKitti(const std::filesystem::path& file, const StampedPoses& poses) {
  WriteRows(file, poses, KittiRow);
}

}  // namespace lio
