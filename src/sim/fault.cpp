// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/fault.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lio/base/angle.hpp"
#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

bool IsImu(const Message& message) {
  return std::holds_alternative<ImuMessage>(message.body);
}

Timestamp& StampIn(Message& message) {
  if (auto* imu = std::get_if<ImuMessage>(&message.body)) return imu->sample.stamp;
  return std::get<ScanChunk>(message.body).stamp;
}

bool Concerns(const Fault& fault, const Message& message) {
  return fault.channel == FaultChannel::kBoth ||
         (fault.channel == FaultChannel::kImu) == IsImu(message);
}

// Returns a message's own number, which keys its random draws; chunks of one scan share it unless
// `each_chunk`.
std::uint64_t NumberOf(const Message& message, bool each_chunk) {
  if (const auto* imu = std::get_if<ImuMessage>(&message.body)) {
    return static_cast<std::uint64_t>(imu->seq);
  }
  const auto& chunk = std::get<ScanChunk>(message.body);
  const auto scan = static_cast<std::uint64_t>(chunk.scan_seq);
  return HashKey({scan, 1 + (each_chunk ? static_cast<std::uint64_t>(chunk.chunk_index) : 0)});
}

void PutNan(Message& message, std::uint64_t key, double ratio) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (auto* imu = std::get_if<ImuMessage>(&message.body)) {
    if (UnitInterval(key) >= ratio) return;
    imu->sample.w_imu_radps.y() = kNan;
    imu->sample.f_imu_mps2.x() = kNan;
    return;
  }
  auto& chunk = std::get<ScanChunk>(message.body);
  for (std::size_t i = 0; i < chunk.points.size(); ++i) {
    if (UnitInterval(MixBits(key + i)) >= ratio) continue;
    chunk.points[i].x_m = chunk.points[i].y_m = chunk.points[i].z_m = static_cast<float>(kNan);
  }
}

// Replaces the scan by one chunk with at most `num` points of its first one.
void Thin(std::vector<Message>& messages, std::size_t num) {
  auto& chunk = std::get<ScanChunk>(messages.front().body);
  if (chunk.chunk_index > 0) {
    messages.clear();
    return;
  }
  chunk.chunk_count = 1;
  const std::size_t step = num == 0 ? 1 : std::max<std::size_t>(1, chunk.points.size() / num);
  std::vector<LidarPoint> kept;
  for (std::size_t i = 0; i < chunk.points.size() && kept.size() < num; i += step) {
    kept.push_back(chunk.points[i]);
  }
  chunk.points = std::move(kept);
}

void ClipRate(Message& message, double limit) {
  Vector3& w = std::get<ImuMessage>(message.body).sample.w_imu_radps;
  w = w.cwiseMax(-limit).cwiseMin(limit);
}

void Shake(Message& message, std::uint64_t key, double accel_std_mps2, double gyro_std_radps) {
  ImuSample& sample = std::get<ImuMessage>(message.body).sample;
  Random random(key, Purpose::kFault);
  for (double& axis : sample.f_imu_mps2) axis += accel_std_mps2 * random.Gaussian();
  for (double& axis : sample.w_imu_radps) axis += gyro_std_radps * random.Gaussian();
}

void Silence(Message& message, bool is_gyro_dead, bool is_accelerometer_dead) {
  ImuSample& sample = std::get<ImuMessage>(message.body).sample;
  if (is_gyro_dead) sample.w_imu_radps.setZero();
  if (is_accelerometer_dead) sample.f_imu_mps2.setZero();
}

void Offset(Message& message, double rate_z_radps, double force_x_mps2) {
  ImuSample& sample = std::get<ImuMessage>(message.body).sample;
  sample.w_imu_radps.z() += rate_z_radps;
  sample.f_imu_mps2.x() += force_x_mps2;
}

void AppendCopy(std::vector<Message>& messages, double delay_s) {
  Message copy = messages.front();
  copy.arrival = copy.arrival + Duration::FromSeconds(delay_s);
  messages.push_back(std::move(copy));
}

}  // namespace

FaultInjector::FaultInjector(std::vector<Fault> faults, std::uint64_t seed, Timestamp begin)
    : faults_(std::move(faults)), seed_(seed), begin_(begin) {}

std::vector<Message> FaultInjector::Apply(Message message) const {
  std::vector<Message> messages;
  messages.push_back(std::move(message));
  for (std::size_t i = 0; i < faults_.size() && !messages.empty(); ++i) {
    ApplyOne(faults_[i], HashKey({seed_, static_cast<std::uint64_t>(Purpose::kFault), i}),
             messages);
  }
  return messages;
}

bool FaultInjector::InWindow(const Fault& fault, const Message& message) const {
  if (!fault.values.contains("start")) return true;
  // The arrival decides, because another fault may have changed the stamp.
  const double t_s = SecondsBetween(begin_, message.arrival);
  return t_s >= fault.Get("start") && t_s < fault.Get("start") + fault.Get("duration");
}

// Alters the first of `messages` only; a copy made by an earlier fault stays as it is.
void FaultInjector::ApplyOne(const Fault& fault, std::uint64_t fault_key,
                             std::vector<Message>& messages) const {
  Message& message = messages.front();
  if (!Concerns(fault, message) || !InWindow(fault, message)) return;
  const bool each_chunk = fault.kind != FaultKind::kDrop && fault.kind != FaultKind::kEmptyScan;
  const std::uint64_t key = MixBits(fault_key ^ NumberOf(message, each_chunk));
  const bool hit = fault.values.contains("ratio") && UnitInterval(key) < fault.Get("ratio");
  switch (fault.kind) {
    case FaultKind::kImuGap:
    case FaultKind::kLidarGap:
      messages.clear();
      break;
    case FaultKind::kDrop:
    case FaultKind::kChunkLoss:
      if (hit) messages.clear();
      break;
    case FaultKind::kDuplicate:
      if (hit) AppendCopy(messages, fault.Get("delay"));
      break;
    case FaultKind::kReorder:
      if (hit) message.arrival = message.arrival + Duration::FromSeconds(fault.Get("delay"));
      break;
    case FaultKind::kStampJump:
    case FaultKind::kClockOffset:
      StampIn(message) = StampIn(message) + Duration::FromSeconds(fault.Get("offset"));
      break;
    case FaultKind::kNan:
      PutNan(message, key, fault.Get("ratio"));
      break;
    case FaultKind::kGyroSaturation:
      ClipRate(message, fault.Get("limit"));
      break;
    case FaultKind::kShaking:
      Shake(message, key, fault.Get("accel"), fault.Get("gyro"));
      break;
    case FaultKind::kImuDead:
      Silence(message, fault.Get("gyro") != 0.0, fault.Get("accel") != 0.0);
      break;
    case FaultKind::kImuOffset:
      Offset(message, fault.Get("gyro"), fault.Get("accel"));
      break;
    case FaultKind::kEmptyScan:
      if (hit) Thin(messages, 0);
      break;
    case FaultKind::kSparseScan:
      Thin(messages, static_cast<std::size_t>(std::max(0.0, fault.Get("points"))));
      break;
    case FaultKind::kDust:            // applied at the rays: see DustOf
    case FaultKind::kWrongExtrinsic:  // applied in the configuration: see ClaimedExtrinsic
      break;
  }
}

std::vector<Dust> DustOf(const std::vector<Fault>& faults, double begin_s) {
  std::vector<Dust> dust;
  for (const Fault& fault : faults) {
    if (fault.kind != FaultKind::kDust) continue;
    const double start_s = begin_s + fault.Get("start");
    dust.push_back({start_s, start_s + fault.Get("duration"), fault.Get("density")});
  }
  return dust;
}

Pose ClaimedExtrinsic(const std::vector<Fault>& faults, const Pose& T_imu_lidar) {
  Pose claimed = T_imu_lidar;
  for (const Fault& fault : faults) {
    if (fault.kind != FaultKind::kWrongExtrinsic) continue;
    const Quaternion turn(Eigen::AngleAxisd(kRadPerDeg * fault.Get("yaw_deg"), Vector3::UnitZ()) *
                          Eigen::AngleAxisd(kRadPerDeg * fault.Get("pitch_deg"), Vector3::UnitY()) *
                          Eigen::AngleAxisd(kRadPerDeg * fault.Get("roll_deg"), Vector3::UnitX()));
    const Vector3 shift(fault.Get("x"), fault.Get("y"), fault.Get("z"));
    claimed = {(turn * claimed.rotation).normalized(), claimed.translation + shift};
  }
  return claimed;
}

}  // namespace lio::sim
