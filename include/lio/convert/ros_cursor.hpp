// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the bytes of one serialised ROS message in order: ROS 1 (packed, little-endian) or ROS 2's
// CDR (aligned, either byte order, after a header of four bytes). It never reads past the end: a
// read that does not fit makes ok() false for good and returns zeros.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "lio/base/time.hpp"
#include "lio/convert/byte_order.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio {

enum class RosEncoding { kRos1, kCdr };

class RosCursor {
 public:
  RosCursor(ByteView bytes, RosEncoding encoding);

  bool ok() const { return ok_; }
  bool big_endian() const { return big_endian_; }
  RosEncoding encoding() const { return encoding_; }
  // Returns true when everything is read, except for the few bytes with which CDR may pad.
  [[nodiscard]] bool AtEnd() const;

  template <typename T>
  T Read() {
    Align(sizeof(T));
    const ByteView raw = ReadBytes(sizeof(T));
    return raw.empty() ? T{} : LoadAs<T>(raw.data(), big_endian_);
  }
  std::string_view ReadString();
  // Reads the length of a sequence whose items take at least `min_item_bytes` each. A count that
  // cannot fit into the remaining bytes makes ok() false and is returned as 0.
  std::uint32_t ReadCount(std::size_t min_item_bytes);
  ByteView ReadBytes(std::size_t count);
  // Skips `count` values of `size` bytes (1, 2, 4 or 8) with their alignment.
  void SkipValues(std::size_t count, std::size_t size);
  // Reads seconds and nanoseconds; a nanosecond count of a second and more is wrong and makes ok()
  // false.
  Timestamp ReadTime();

 private:
  void Align(std::size_t size);

  ByteView bytes_;
  std::size_t position_ = 0;
  RosEncoding encoding_;
  bool big_endian_ = false;
  bool ok_ = true;
};

}  // namespace lio
