// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lcm_wire.hpp"
#include "lio/command_t.hpp"
#include "lio/io/command.hpp"
#include "lio/reply_t.hpp"

namespace lio {
namespace {

constexpr std::uint64_t kFingerprint = 0x63c135619d4a2bc2;
constexpr std::size_t kNameBytesAt = 8 + 8 + 8 + 4 + 3 * 8 + 4 * 8 + 1 + 36 * 8;
constexpr std::size_t kFixedBytes =
    kNameBytesAt + 4;  // the name's length, with the zero at its end

Pose ReadPose(FieldReader& reader) {
  const Vector3 position = reader.ReadVector();
  const double w = reader.Read<double>();
  const Vector3 xyz = reader.ReadVector();
  return {Quaternion(w, xyz.x(), xyz.y(), xyz.z()), position};
}

Matrix6 ReadMatrix(FieldReader& reader) {
  Matrix6 matrix;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) matrix(row, column) = reader.Read<double>();
  }
  return matrix;
}

}  // namespace

DecodeStatus DecodeCommand(ByteView bytes, Command& command) {
  const DecodeStatus head = CheckHead(bytes, kFingerprint, kFixedBytes);
  if (head != DecodeStatus::kOk) return head;
  const auto num_name = FieldReader(bytes.data() + kNameBytesAt).Read<std::uint32_t>();
  if (num_name == 0 || bytes.size() - kFixedBytes < num_name) return DecodeStatus::kTruncated;
  if (bytes.size() - kFixedBytes > num_name) return DecodeStatus::kSizeMismatch;
  FieldReader reader(bytes.data() + sizeof(kFingerprint));
  reader.Read<std::int64_t>();  // utime
  command.request_id = reader.Read<std::int64_t>();
  const auto action = reader.Read<std::int32_t>();
  command.action = static_cast<CommandAction>(action);
  command.T_world_imu = ReadPose(reader);
  const bool has_cov = reader.Read<std::int8_t>() != 0;
  const Matrix6 cov = ReadMatrix(reader);
  command.pose_cov = has_cov ? std::optional(cov) : std::nullopt;
  if (action < 0 || action >= kNumCommandActions || num_name > kMaxCommandName + 1) {
    return DecodeStatus::kBadFormat;
  }
  const auto name = bytes.begin() + kFixedBytes;
  command.name.assign(name, name + num_name - 1);
  return DecodeStatus::kOk;
}

Bytes EncodeCommand(const Command& command) {
  command_t message{};
  message.request_id = command.request_id;
  message.action = static_cast<std::int32_t>(command.action);
  const Quaternion& rotation = command.T_world_imu.rotation;
  for (int i = 0; i < 3; ++i) message.pos[i] = command.T_world_imu.translation[i];
  const double quat[] = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  for (int i = 0; i < 4; ++i) message.quat[i] = quat[i];
  message.has_cov = command.pose_cov ? 1 : 0;
  const Matrix6 cov = command.pose_cov.value_or(Matrix6::Zero());
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) message.pose_cov[row][column] = cov(row, column);
  }
  message.name = command.name;
  return EncodeMessage(message);
}

Bytes EncodeReply(const Reply& reply) {
  reply_t message{};
  message.utime = reply.utime;
  message.request_id = reply.request_id;
  message.action = reply.action;
  message.result = reply.is_done ? reply_t::DONE : reply_t::REFUSED;
  message.text = reply.text;
  return EncodeMessage(message);
}

}  // namespace lio
