// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_decoder.hpp"

#include <cmath>

#include "lcm_wire.hpp"
#include "lio/base/counters_fields.hpp"

namespace lio {
namespace {

// These are sizes of the encoded messages, including the eight bytes of the fingerprint;
// docs/messages.md has them, too. A filter state has a covariance behind it, a status its texts.
constexpr std::size_t kOdometryBytes = 834;
constexpr std::size_t kFilterStateFixedBytes = 212;
constexpr std::size_t kRegistrationBytes = 134;
constexpr std::size_t kStatusFixedBytes = 821;
constexpr int kMaxDim = 64;  // states of a filter; liod has 21

// Reads fields and remembers whether all of them were values that can be.
class SoundReader {
 public:
  explicit SoundReader(ByteView bytes) : fields_(bytes.data() + sizeof(std::uint64_t)) {}

  [[nodiscard]] DecodeStatus status() const {
    return is_sound_ ? DecodeStatus::kOk : DecodeStatus::kBadFormat;
  }

  template <typename Number>
  Number Read() {
    const auto number = fields_.Read<Number>();
    if constexpr (std::is_floating_point_v<Number>) Demand(std::isfinite(number));
    return number;
  }
  template <typename Number>
  void Read(Number& number) {
    number = Read<Number>();
  }
  template <typename Enum>
  Enum ReadEnum(Enum last) {
    const auto value = fields_.Read<std::int8_t>();
    Demand(value >= 0 && value <= static_cast<std::int8_t>(last));
    return static_cast<Enum>(value);
  }
  Timestamp ReadStamp() {
    const auto utime = fields_.Read<std::int64_t>();
    Demand(utime >= 0 && utime <= kMaxUtime);
    return is_sound_ ? Timestamp::FromMicroseconds(utime) : Timestamp{};
  }
  Vector3 ReadVector() {
    const Vector3 vector = fields_.ReadVector();
    Demand(vector.allFinite());
    return vector;
  }
  Quaternion ReadRotation() {
    constexpr double kTolerance = 1e-3;  // rounding is far below, anything else is no rotation
    const auto w = Read<double>();
    const Vector3 xyz = ReadVector();
    const Quaternion rotation(w, xyz.x(), xyz.y(), xyz.z());
    Demand(std::abs(rotation.norm() - 1.0) < kTolerance);
    return is_sound_ ? rotation.normalized() : Quaternion::Identity();
  }
  template <typename Matrix>
  void ReadMatrix(Matrix& matrix) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) Read(matrix(row, column));
    }
  }
  void Demand(bool holds) { is_sound_ = is_sound_ && holds; }

 private:
  FieldReader fields_;
  bool is_sound_ = true;
};

DecodeStatus CheckSize(ByteView bytes, std::uint64_t fingerprint, std::size_t size) {
  const DecodeStatus head = CheckHead(bytes, fingerprint, size);
  if (head != DecodeStatus::kOk) return head;
  return bytes.size() == size ? DecodeStatus::kOk : DecodeStatus::kSizeMismatch;
}

void ReadCounts(SoundReader& reader, StatusReport& report) {
  for (const CounterField& field : kCounterFields) reader.Read(report.counters.*field.count);
  for (int reason = 1; reason < kNumDecodeStatuses; ++reason) {
    reader.Read(report.input.num_refused[static_cast<std::size_t>(reason)]);
  }
  for (std::int64_t* count :
       {&report.input.num_imu_missing, &report.num_imu_queue_dropped,
        &report.num_chunk_queue_dropped, &report.num_kernel_dropped, &report.num_publish_failed,
        &report.num_outputs_dropped, &report.num_commands_refused, &report.num_handler_faults}) {
    reader.Read(*count);
  }
  for (AccountPage& page : report.account) {
    for (AccountEntry& entry : page.entries) reader.Read(entry.count);
  }
}

// Takes a text from the front as LCM writes it: its length with the NUL, and both. Returns false
// where there is none.
bool TakeText(ByteView& bytes, std::string& text) {
  constexpr std::size_t kLengthBytes = 4;
  if (bytes.size() <= kLengthBytes) return false;
  const std::size_t length = FieldReader(bytes.data()).Read<std::uint32_t>();
  bytes = bytes.subspan(kLengthBytes);
  if (length == 0 || length > bytes.size() || bytes[length - 1] != 0) return false;
  text.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length) - 1);
  bytes = bytes.subspan(length);
  return true;
}

DecodeStatus TakeTexts(ByteView bytes, StatusReport& report) {
  if (!TakeText(bytes, report.note) || !TakeText(bytes, report.options) || !bytes.empty()) {
    return DecodeStatus::kSizeMismatch;
  }
  const bool is_short =
      report.note.size() <= kMaxStatusText && report.options.size() <= kMaxStatusText;
  return is_short ? DecodeStatus::kOk : DecodeStatus::kBadFormat;
}

void ReadLoad(SoundReader& reader, StatusReport& report) {
  for (LatencySummary* latency : {&report.queue, &report.compute, &report.latency}) {
    reader.Read(latency->p50_ms);
    reader.Read(latency->p99_ms);
    reader.Read(latency->max_ms);
  }
  reader.Read(report.cpu_load_cores);
  reader.Read(report.rss_mb);
  reader.Read(report.map_mb);
  report.imu_noise.gyro = static_cast<double>(reader.Read<float>());
  report.imu_noise.accel = static_cast<double>(reader.Read<float>());
  reader.Read(report.clock_offset.offset_s);
  reader.Read(report.clock_offset.std_s);
}

}  // namespace

DecodeStatus DecodeOdometry(ByteView bytes, NavOutput& nav) {
  const DecodeStatus size = CheckSize(bytes, kOdometryFingerprint, kOdometryBytes);
  if (size != DecodeStatus::kOk) return size;
  SoundReader reader(bytes);
  nav.stamp = reader.ReadStamp();
  reader.Read(nav.scan_seq);
  nav.status = reader.ReadEnum(TrackingStatus::kLost);
  nav.source = reader.ReadEnum(OdometrySource::kImuPropagated);
  nav.T_world_imu.translation = reader.ReadVector();
  nav.T_world_imu.rotation = reader.ReadRotation();
  nav.v_world_imu_mps = reader.ReadVector();
  nav.w_imu_radps = reader.ReadVector();
  reader.ReadMatrix(nav.pose_cov);
  reader.ReadMatrix(nav.velocity_cov);
  nav.T_map_imu.translation = reader.ReadVector();
  nav.T_map_imu.rotation = reader.ReadRotation();
  reader.ReadMatrix(nav.map_pose_cov);
  return reader.status();
}

DecodeStatus DecodeFilterState(ByteView bytes, FilterReport& report) {
  const DecodeStatus head = CheckHead(bytes, kFilterStateFingerprint, kFilterStateFixedBytes);
  if (head != DecodeStatus::kOk) return head;
  SoundReader reader(bytes);
  report.nav.stamp = reader.ReadStamp();
  reader.Read(report.nav.scan_seq);
  report.nav.T_world_imu.translation = reader.ReadVector();
  report.nav.v_world_imu_mps = reader.ReadVector();
  report.nav.T_world_imu.rotation = reader.ReadRotation();
  report.gyro_bias_radps = reader.ReadVector();
  report.accel_bias_mps2 = reader.ReadVector();
  report.g_world_mps2 = reader.ReadVector();
  reader.Read(report.clock_offset_s);
  reader.Read(report.clock_offset_std_s);
  reader.Read(report.nis);
  reader.Read(report.nis_dof);
  const auto dim = reader.Read<std::int32_t>();
  const auto num_entries = reader.Read<std::int32_t>();
  if (dim < 0 || dim > kMaxDim) return DecodeStatus::kBadFormat;
  const std::size_t size =
      kFilterStateFixedBytes + static_cast<std::size_t>(dim) * static_cast<std::size_t>(dim) * 8;
  if (num_entries != dim * dim || bytes.size() != size) return DecodeStatus::kSizeMismatch;
  report.cov.resize(dim, dim);
  reader.ReadMatrix(report.cov);
  return reader.status();
}

DecodeStatus DecodeRegistration(ByteView bytes, ScanReport& report) {
  const DecodeStatus size = CheckSize(bytes, kRegistrationFingerprint, kRegistrationBytes);
  if (size != DecodeStatus::kOk) return size;
  SoundReader reader(bytes);
  report.stamp = reader.ReadStamp();
  report.scan_seq = reader.Read<std::int32_t>();
  reader.Read(report.num_raw);
  reader.Read(report.num_used);
  reader.Read(report.num_matched);
  reader.Read(report.iterations);
  report.status = reader.ReadEnum(MatchStatus::kDegenerate);
  report.fused = reader.Read<std::int8_t>() != 0;
  reader.Read(report.residual_rms_m);
  reader.ReadMatrix(report.information_eigenvalues);
  report.degenerate_mask = static_cast<unsigned>(reader.Read<std::int32_t>());
  reader.Read(report.nis);
  for (const Stage stage : {Stage::kDecode, Stage::kReduce, Stage::kDeskew, Stage::kMatch,
                            Stage::kInsert, Stage::kFilter, Stage::kTotal}) {
    constexpr float kMaxStage_us = 1e12F;  // so that nanoseconds fit 64 bits
    const float time_us = reader.Read<float>();
    reader.Demand(std::abs(time_us) < kMaxStage_us);
    if (reader.status() != DecodeStatus::kOk) return reader.status();
    report.stage_ns[static_cast<std::size_t>(stage)] =
        static_cast<std::int64_t>(static_cast<double>(time_us) * 1e3);
  }
  return reader.status();
}

DecodeStatus DecodeStatusReport(ByteView bytes, StatusReport& report) {
  const DecodeStatus head = CheckHead(bytes, kStatusFingerprint, kStatusFixedBytes);
  if (head != DecodeStatus::kOk) return head;
  SoundReader reader(bytes);
  reader.Read(report.utime);
  reader.Read(report.start_utime);
  report.newest_stamp = reader.ReadStamp();
  reader.Read(report.seq);
  report.state = reader.ReadEnum(TrackingStatus::kLost);
  ReadCounts(reader, report);
  reader.Read(report.receive_buffer_bytes);
  ReadLoad(reader, report);
  report.trust = reader.ReadEnum(Trust::kNo);
  report.config_hash = static_cast<std::uint64_t>(reader.Read<std::int64_t>());
  for (int part = 0; part < 3; ++part) reader.Read<std::int8_t>();  // version
  const DecodeStatus texts = TakeTexts(bytes.subspan(kStatusFixedBytes), report);
  return texts == DecodeStatus::kOk ? reader.status() : texts;
}

}  // namespace lio
