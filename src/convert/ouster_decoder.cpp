// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "ouster_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lio/base/angle.hpp"
#include "lio/base/stamp_limit.hpp"
#include "lio/convert/byte_order.hpp"
#include "lio/convert/point_time.hpp"

namespace lio {
namespace {

constexpr std::size_t kHeaderBytes = 32;        // in a RNG19 packet
constexpr std::size_t kColumnHeaderBytes = 12;  // in a RNG19 packet
constexpr std::size_t kLegacyHeaderBytes = 16;
constexpr std::size_t kLegacyStatusBytes = 4;
constexpr std::uint32_t kLegacyValid = 0xffffffff;
constexpr std::uint32_t kLegacyRangeMask = 0xfffff, kRangeMask = 0x7ffff;
constexpr double kStandardGravity_mps2 = 9.80665;

template <typename T>
T At(ByteView bytes, std::size_t at) {
  return LoadAs<T>(bytes.data() + at, false);
}

bool IsStamp(std::int64_t ns) {
  return ns >= 0 && ns <= kMaxStamp_ns;
}

}  // namespace

OusterDecoder::OusterDecoder(OusterMetadata metadata)
    : metadata_(std::move(metadata)), ring_of_beam_(metadata_.elevation_rad.size()) {
  std::vector<std::size_t> from_below(ring_of_beam_.size());
  std::iota(from_below.begin(), from_below.end(), std::size_t{0});
  std::stable_sort(from_below.begin(), from_below.end(), [this](std::size_t a, std::size_t b) {
    return metadata_.elevation_rad[a] < metadata_.elevation_rad[b];
  });
  for (std::size_t ring = 0; ring < from_below.size(); ++ring) {
    ring_of_beam_[from_below[ring]] = static_cast<std::uint16_t>(ring);
  }
}

void OusterDecoder::Add(ByteView payload, Timestamp received) {
  last_received_ = received;
  if (payload.size() == kOusterImuBytes) return AddImu(payload, received);
  if (payload.size() != metadata_.PacketBytes()) return;
  bool is_damaged = false;
  for (std::size_t i = 0; i < metadata_.columns_per_packet; ++i) {
    const Column column = ReadColumn(payload, i);
    if (!column.is_valid) continue;  // the window of the azimuth, or a lost firing
    if (column.number >= metadata_.columns_per_turn || !IsInTime(column)) {
      is_damaged = true;
      continue;
    }
    AddColumn(column, received);
  }
  ++(is_damaged ? counts_.num_damaged : counts_.num_taken);
}

OusterDecoder::Column OusterDecoder::ReadColumn(ByteView payload, std::size_t index) const {
  const std::size_t pixels = kOusterPixelBytes * metadata_.elevation_rad.size();
  Column column;
  if (metadata_.profile == OusterProfile::kLegacy) {
    const ByteView at = payload.subspan(index * (kLegacyHeaderBytes + pixels + kLegacyStatusBytes));
    column.frame = At<std::uint16_t>(at, 10);
    column.is_valid = At<std::uint32_t>(at, kLegacyHeaderBytes + pixels) == kLegacyValid;
    column.pixels = at.subspan(kLegacyHeaderBytes, pixels);
    column.stamp_ns = At<std::int64_t>(at, 0);
    column.number = At<std::uint16_t>(at, 8);
    return column;
  }
  const ByteView at = payload.subspan(kHeaderBytes + index * (kColumnHeaderBytes + pixels));
  column.frame = At<std::uint16_t>(payload, 2);
  column.is_valid = (At<std::uint16_t>(at, 10) & 1) != 0;
  column.pixels = at.subspan(kColumnHeaderBytes, pixels);
  column.stamp_ns = At<std::int64_t>(at, 0);
  column.number = At<std::uint16_t>(at, 8);
  return column;
}

// No turn takes longer than kMaxSweepSeconds.
bool OusterDecoder::IsInTime(const Column& column) const {
  if (!IsStamp(column.stamp_ns)) return false;
  if (frame_ != column.frame || turn_.instants_ns.empty()) return true;
  const std::int64_t since_first_ns = column.stamp_ns - turn_.instants_ns.front();
  return Abs(Duration{since_first_ns}) <= Duration::FromSeconds(kMaxSweepSeconds);
}

void OusterDecoder::AddColumn(const Column& column, Timestamp received) {
  // Packets may overtake one another: columns of the turn before are late and left out.
  if (frame_ && static_cast<std::int16_t>(column.frame - *frame_) < 0) {
    ++counts_.num_lost;
    return;
  }
  if (frame_ && column.frame != *frame_) Cut(received);
  frame_ = column.frame;
  ++num_columns_;
  for (std::size_t beam = 0; beam < metadata_.elevation_rad.size(); ++beam) AddPixel(column, beam);
}

// A beam leaves at `beam_origin_m` from the axis, in the direction of the column, and is turned by
// its own offset: ranges are measured from the axis along both legs.
void OusterDecoder::AddPixel(const Column& column, std::size_t beam) {
  const ByteView pixel = column.pixels.subspan(kOusterPixelBytes * beam, kOusterPixelBytes);
  const bool is_legacy = metadata_.profile == OusterProfile::kLegacy;
  const std::uint32_t range_mm =
      At<std::uint32_t>(pixel, 0) & (is_legacy ? kLegacyRangeMask : kRangeMask);
  if (range_mm == 0) return;
  const double leg_m = kMetresPerMillimetre * range_mm - metadata_.beam_origin_m;
  const double head_rad = kTurn_rad * (1.0 - static_cast<double>(column.number) /
                                                 static_cast<double>(metadata_.columns_per_turn));
  const double heading_rad = head_rad - metadata_.azimuth_offset_rad[beam];
  const double elevation_rad = metadata_.elevation_rad[beam];
  const double flat_m = leg_m * std::cos(elevation_rad);
  const Vector3 p_lidar(
      flat_m * std::cos(heading_rad) + metadata_.beam_origin_m * std::cos(head_rad),
      flat_m * std::sin(heading_rad) + metadata_.beam_origin_m * std::sin(head_rad),
      leg_m * std::sin(elevation_rad));
  const Vector3 p_sensor = metadata_.T_sensor_lidar * p_lidar;
  LidarPoint point;
  point.x_m = static_cast<float>(p_sensor.x());
  point.y_m = static_cast<float>(p_sensor.y());
  point.z_m = static_cast<float>(p_sensor.z());
  point.intensity = is_legacy ? At<std::uint16_t>(pixel, 4) : pixel[4];
  point.ring = ring_of_beam_[beam];
  turn_.points.push_back(point);
  turn_.instants_ns.push_back(column.stamp_ns);
}

void OusterDecoder::AddImu(ByteView payload, Timestamp received) {
  const auto vector = [&](std::size_t at) {
    return Vector3(At<float>(payload, at), At<float>(payload, at + 4), At<float>(payload, at + 8));
  };
  const auto stamp_ns = At<std::int64_t>(payload, 16);  // the gyro's own time
  if (!IsStamp(stamp_ns)) {
    ++counts_.num_damaged;
    return;
  }
  ReceivedImu imu;
  imu.received = received;
  imu.sample.stamp = Timestamp{stamp_ns};
  imu.sample.f_imu_mps2 = kStandardGravity_mps2 * vector(24);
  imu.sample.w_imu_radps = kRadPerDeg * vector(36);
  imu_.push_back(imu);
}

void OusterDecoder::Cut(Timestamp received) {
  turn_.is_whole = static_cast<double>(num_columns_) >
                   kWholeTurn * static_cast<double>(metadata_.columns_per_turn);
  turn_.received = received;
  num_columns_ = 0;
  if (!turn_.points.empty()) turns_.push_back(std::move(turn_));
  turn_ = Turn();
}

}  // namespace lio
