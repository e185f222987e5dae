// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <charconv>
#include <numeric>

#include "lcm_wire.hpp"
#include "lio/base/counters_fields.hpp"
#include "lio/io/output_account.hpp"
#include "lio/io/status_report.hpp"
#include "lio/status_t.hpp"

namespace lio {
namespace {

// On the wire the estimator's counts follow one another in the order of kCounterFields, after the
// fingerprint, utime, start_utime, sensor_utime, seq and state. A test compares with the type.
constexpr std::size_t kCountersOffset = 8 + 8 + 8 + 8 + 4 + 1;
constexpr std::size_t kStartUtimeOffset = 8 + 8;
constexpr std::size_t kCountBytes = 8;
// Behind them stand the refusals by reason, and what was lost on the way in and out; then the pages
// of the account.
constexpr std::size_t kLossesOffset = kCountersOffset + kCounterFields.size() * kCountBytes;
constexpr std::size_t kNumLosses = kNumDecodeStatuses - 1 + 8;
constexpr std::size_t kAccountOffset = kLossesOffset + kNumLosses * kCountBytes;
constexpr std::int64_t kMaxCount = std::int64_t{1} << 50;  // sums of these do not overflow

// Writes a count at `at`, and moves on to the next.
void WriteCount(std::int64_t count, Bytes& bytes, std::size_t& at) {
  const auto value = static_cast<std::uint64_t>(count);
  for (int shift = 56; shift >= 0; shift -= 8) {
    bytes.at(at++) = static_cast<std::uint8_t>(value >> shift);
  }
}

void WriteCounters(const Counters& counters, Bytes& bytes) {
  std::size_t at = kCountersOffset;
  for (const CounterField& field : kCounterFields) WriteCount(counters.*field.count, bytes, at);
}

void WriteAccount(const std::vector<AccountPage>& account, Bytes& bytes) {
  std::size_t at = kAccountOffset;
  for (const AccountPage& page : account) {
    for (const AccountEntry& entry : page.entries) WriteCount(entry.count, bytes, at);
  }
}

std::size_t NumEntries(const std::vector<AccountPage>& account) {
  return std::accumulate(
      account.begin(), account.end(), std::size_t{0},
      [](std::size_t num, const AccountPage& page) { return num + page.entries.size(); });
}

std::int64_t ReadInt64(ByteView bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + kCountBytes; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

void CopyLosses(const StatusReport& from, status_t& to) {
  const auto refused = [&](DecodeStatus reason) {
    return from.input.num_refused[static_cast<std::size_t>(reason)];
  };
  to.bad_truncated = refused(DecodeStatus::kTruncated);
  to.bad_wrong_type = refused(DecodeStatus::kWrongType);
  to.bad_size_mismatch = refused(DecodeStatus::kSizeMismatch);
  to.bad_format = refused(DecodeStatus::kBadFormat);
  to.bad_too_large = refused(DecodeStatus::kTooLarge);
  to.imu_seq_missing = from.input.num_imu_missing;
  to.imu_queue_dropped = from.num_imu_queue_dropped;
  to.chunk_queue_dropped = from.num_chunk_queue_dropped;
  to.kernel_dropped = from.num_kernel_dropped;
  to.publish_failed = from.num_publish_failed;
  to.outputs_dropped = from.num_outputs_dropped;
  to.commands_refused = from.num_commands_refused;
  to.handler_faults = from.num_handler_faults;
}

void CopyLatencies(const StatusReport& from, status_t& to) {
  to.queue_p50_ms = from.queue.p50_ms;
  to.queue_p99_ms = from.queue.p99_ms;
  to.queue_max_ms = from.queue.max_ms;
  to.compute_p50_ms = from.compute.p50_ms;
  to.compute_p99_ms = from.compute.p99_ms;
  to.compute_max_ms = from.compute.max_ms;
  to.latency_p50_ms = from.latency.p50_ms;
  to.latency_p99_ms = from.latency.p99_ms;
  to.latency_max_ms = from.latency.max_ms;
}

// Turns "1.2.3" into {1, 2, 3}; what is missing is 0.
void CopyVersion(const std::string& text, std::int8_t (&version)[3]) {
  const char* next = text.data();
  const char* end = next + text.size();
  for (std::int8_t& part : version) {
    int number = 0;
    next = std::from_chars(next, end, number).ptr;
    part = static_cast<std::int8_t>(number);
    if (next != end) ++next;
  }
}

}  // namespace

Bytes EncodeStatus(const StatusReport& report, const std::string& version) {
  status_t message{};
  message.utime = report.utime;
  message.start_utime = report.start_utime;
  message.sensor_utime = report.newest_stamp.Microseconds();
  message.seq = report.seq;
  message.state = static_cast<std::int8_t>(report.state);
  CopyLosses(report, message);
  message.rcvbuf_bytes = report.receive_buffer_bytes;
  CopyLatencies(report, message);
  message.cpu_load = report.cpu_load_cores;
  message.rss_mb = report.rss_mb;
  message.map_mb = report.map_mb;
  message.gyro_noise_ratio = static_cast<float>(report.imu_noise.gyro);
  message.accel_noise_ratio = static_cast<float>(report.imu_noise.accel);
  message.clock_offset_s = report.clock_offset.offset_s;
  message.clock_offset_std_s = report.clock_offset.std_s;
  message.trust = static_cast<std::int8_t>(report.trust);
  message.config_hash = static_cast<std::int64_t>(report.config_hash);
  CopyVersion(version, message.version);
  message.note = report.note;
  message.options = report.options;
  Bytes bytes = EncodeMessage(message);
  WriteCounters(report.counters, bytes);
  WriteAccount(report.account, bytes);
  return bytes;
}

std::optional<StatusCounts> DecodeStatusCounts(ByteView bytes) {
  StatusCounts counts;
  if (bytes.size() < kAccountOffset + NumEntries(counts.account) * kCountBytes) return std::nullopt;
  if (ReadInt64(bytes, 0) != status_t::getHash()) return std::nullopt;
  counts.start_utime = ReadInt64(bytes, kStartUtimeOffset);
  std::size_t at = kCountersOffset;
  bool is_sound = true;
  const auto next = [&](std::int64_t least = 0) {
    const std::int64_t count = ReadInt64(bytes, at);
    at += kCountBytes;
    is_sound = is_sound && count >= least && count <= kMaxCount;
    return is_sound ? count : 0;  // a hostile count would overflow a sum
  };
  for (const CounterField& field : kCounterFields) counts.counters.*field.count = next();
  for (int i = 1; i < kNumDecodeStatuses && is_sound; ++i) counts.num_refused += next();
  at += kCountBytes;  // imu_seq_missing
  for (int i = 0; i < 2 && is_sound; ++i) counts.num_queue_dropped += next();
  at = kAccountOffset;
  for (AccountPage& page : counts.account) {
    for (AccountEntry& entry : page.entries) entry.count = next(-kMaxCount);
  }
  return is_sound ? std::optional(counts) : std::nullopt;
}

std::uint64_t Fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) {
    hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3;
  }
  return hash;
}

}  // namespace lio
