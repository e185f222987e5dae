// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the binary frames from lio-view to its page; src/view/page/frames.js reads them. A frame
// is
//   u32 magic "LIV1", then sections: u32 kind, u32 size of the payload, payload padded to 4 bytes,
// all little-endian. Payloads:
//   kHello, kStatus, kTimeline  JSON
//   kMap     u32 generation, u32 index of the first point, u32 points in all, f32 voxel, points
//   kScan    u32 number, u32 scans left out so far, points
//   kPath    u32 generation, u32 first, u32 in all, u32 count, then f32 x y z status each
//   kPose    f64 stamp [s], f64 received [s], then f32: position 3, rotation xyzw 4, ellipsoid's
//            axes xyzw 4 and standard deviations 3, velocity in world 3, status; u32 poses left out
//   kStates  u32 generation, u32 first, u32 in all, u32 count, f64 begin [s], then f32 each:
//   seconds
//            since begin, the values of StateRow
// Points are u32 count, f32 origin 3, f32 step, then u16 x y z each: origin + step * u16. A client
// that sees another generation forgets what it has.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>

#include "lio/io/lcm_codec.hpp"

namespace lio {

enum class Section : std::uint32_t {
  kHello = 1,
  kMap = 2,
  kScan = 3,
  kPath = 4,
  kPose = 5,
  kStates = 6,
  kStatus = 7,
  kTimeline = 8,
};

class FrameWriter {
 public:
  FrameWriter();

  void Begin(Section section);
  void End();
  void Text(Section section, std::string_view json);

  template <typename Number>
  void Put(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    PutBytes(&number, sizeof(number));
  }
  template <typename Vector>
  void PutFloats(const Vector& vector) {
    for (Eigen::Index i = 0; i < vector.size(); ++i) Put(static_cast<float>(vector(i)));
  }
  void PutPoints(std::span<const Eigen::Vector3f> points);

  [[nodiscard]] bool is_empty() const { return num_sections_ == 0; }
  [[nodiscard]] Bytes Take() { return std::move(bytes_); }

 private:
  void PutBytes(const void* bytes, std::size_t size);

  Bytes bytes_;
  std::size_t payload_at_ = 0;
  int num_sections_ = 0;
};

}  // namespace lio
