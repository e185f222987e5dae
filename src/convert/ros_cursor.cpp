// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_cursor.hpp"

namespace lio {
namespace {

constexpr std::size_t kCdrHeaderBytes = 4;  // representation identifier (2), options (2)
constexpr std::size_t kMaxCdrPadding = 7;   // writers round a message up to 4 or 8 bytes

}  // namespace

RosCursor::RosCursor(ByteView bytes, RosEncoding encoding) : bytes_(bytes), encoding_(encoding) {
  if (encoding_ == RosEncoding::kRos1) return;
  // The identifiers 0 and 1 are plain CDR, big- and little-endian.
  ok_ = bytes_.size() >= kCdrHeaderBytes && bytes_[0] == 0 && bytes_[1] <= 1;
  big_endian_ = ok_ && bytes_[1] == 0;
  if (ok_) bytes_ = bytes_.subspan(kCdrHeaderBytes);
}

bool RosCursor::AtEnd() const {
  const std::size_t left = bytes_.size() - position_;
  return ok_ && left <= (encoding_ == RosEncoding::kCdr ? kMaxCdrPadding : 0);
}

std::string_view RosCursor::ReadString() {
  const ByteView raw = ReadBytes(ReadCount(1));
  std::string_view text(reinterpret_cast<const char*>(raw.data()), raw.size());
  if (encoding_ == RosEncoding::kCdr && !text.empty() && text.back() == '\0') {
    text.remove_suffix(1);
  }
  return text;
}

std::uint32_t RosCursor::ReadCount(std::size_t min_item_bytes) {
  const auto count = Read<std::uint32_t>();
  if (ok_ && count > (bytes_.size() - position_) / min_item_bytes) ok_ = false;
  return ok_ ? count : 0;
}

ByteView RosCursor::ReadBytes(std::size_t count) {
  if (!ok_ || count > bytes_.size() - position_) {
    ok_ = false;
    return {};
  }
  const ByteView raw = bytes_.subspan(position_, count);
  position_ += count;
  return raw;
}

void RosCursor::SkipValues(std::size_t count, std::size_t size) {
  if (count == 0) return;
  Align(size);
  ReadBytes(count > bytes_.size() / size ? bytes_.size() + 1 : count * size);
}

Timestamp RosCursor::ReadTime() {
  // ROS 1 counts unsigned seconds, ROS 2 signed ones; both fit here.
  const std::int64_t seconds =
      encoding_ == RosEncoding::kRos1 ? Read<std::uint32_t>() : Read<std::int32_t>();
  const std::int64_t nanoseconds = Read<std::uint32_t>();
  if (nanoseconds >= 1'000'000'000) ok_ = false;
  return ok_ ? Timestamp{seconds * 1'000'000'000 + nanoseconds} : Timestamp{};
}

void RosCursor::Align(std::size_t size) {
  if (encoding_ == RosEncoding::kRos1 || size == 1) return;
  const std::size_t padding = (size - position_ % size) % size;
  if (padding > 0) ReadBytes(padding);
}

}  // namespace lio
