// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/frame_writer.hpp"

#include <bit>
#include <cmath>
#include <cstring>

namespace lio {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little-endian");

constexpr std::uint32_t kMagic = 0x3156494c;  // "LIV1"
constexpr float kSteps = 65535.0F;            // the largest u16
constexpr float kFinestStep_m = 1e-4F;

}  // namespace

FrameWriter::FrameWriter() {
  Put(kMagic);
}

void FrameWriter::PutBytes(const void* bytes, std::size_t size) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + size);
  if (size > 0) std::memcpy(bytes_.data() + at, bytes, size);
}

void FrameWriter::Begin(Section section) {
  Put(static_cast<std::uint32_t>(section));
  Put(std::uint32_t{0});  // End knows the size
  payload_at_ = bytes_.size();
  ++num_sections_;
}

void FrameWriter::End() {
  const auto size = static_cast<std::uint32_t>(bytes_.size() - payload_at_);
  std::memcpy(bytes_.data() + payload_at_ - sizeof(size), &size, sizeof(size));
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
}

void FrameWriter::Text(Section section, std::string_view json) {
  Begin(section);
  PutBytes(json.data(), json.size());
  End();
}

void FrameWriter::PutPoints(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  if (!points.empty()) low = high = points.front();
  for (const Eigen::Vector3f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const float step = std::max(kFinestStep_m, (high - low).maxCoeff() / kSteps);
  Put(static_cast<std::uint32_t>(points.size()));
  PutFloats(low);
  Put(step);
  bytes_.reserve(bytes_.size() + points.size() * 3 * sizeof(std::uint16_t));
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3f scaled = (point - low) / step;
    for (int i = 0; i < 3; ++i) {
      Put(static_cast<std::uint16_t>(std::lround(std::min(kSteps, scaled[i]))));
    }
  }
}

}  // namespace lio
