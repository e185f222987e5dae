// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads frames as the page does, for the tests of lio-view.
#pragma once

#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

#include "view/frame_writer.hpp"

namespace lio::test {

class PayloadReader {
 public:
  explicit PayloadReader(ByteView bytes) : bytes_(bytes) {}

  template <typename Number>
  Number Read() {
    Number number{};
    if (at_ + sizeof(number) > bytes_.size()) throw std::runtime_error("the payload is too short");
    std::memcpy(&number, bytes_.data() + at_, sizeof(number));
    at_ += sizeof(number);
    return number;
  }
  std::uint32_t U32() { return Read<std::uint32_t>(); }
  float F32() { return Read<float>(); }
  std::vector<Eigen::Vector3f> Points() {
    std::vector<Eigen::Vector3f> points(U32());
    const float x0 = F32();
    const float y0 = F32();
    const float z0 = F32();
    const float step = F32();
    for (Eigen::Vector3f& point : points) {
      const auto x = static_cast<float>(Read<std::uint16_t>());
      const auto y = static_cast<float>(Read<std::uint16_t>());
      const auto z = static_cast<float>(Read<std::uint16_t>());
      point = Eigen::Vector3f(x0, y0, z0) + step * Eigen::Vector3f(x, y, z);
    }
    return points;
  }
  [[nodiscard]] std::string Text() const { return {bytes_.begin(), bytes_.end()}; }
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  ByteView bytes_;
  std::size_t at_ = 0;
};

// Returns the payloads of a frame by their kind. `frame` must outlive them.
inline std::map<Section, PayloadReader> Sections(const Bytes& frame) {
  PayloadReader reader(frame);
  if (reader.U32() != 0x3156494c) throw std::runtime_error("no frame");
  std::map<Section, PayloadReader> found;
  for (std::size_t at = 4; at < frame.size();) {
    PayloadReader head(ByteView(frame).subspan(at, 8));
    const auto kind = static_cast<Section>(head.U32());
    const std::uint32_t size = head.U32();
    found.emplace(kind, ByteView(frame).subspan(at + 8, size));
    at += 8 + (size + 3) / 4 * 4;
  }
  return found;
}

}  // namespace lio::test
