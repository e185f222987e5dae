// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/pcap_convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "imu_file.hpp"
#include "lio/base/median.hpp"
#include "lio/io/input_error.hpp"
#include "lio/sensor/scan_chunk.hpp"
#include "ordered_log.hpp"
#include "ouster_decoder.hpp"
#include "packet_streams.hpp"
#include "sweep_to_chunks.hpp"
#include "udp_capture.hpp"
#include "velodyne_decoder.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

fs::path MetadataBeside(const fs::path& capture) {
  fs::path beside = capture;
  return beside.replace_extension(".json");
}

std::optional<OusterMetadata> MetadataOf(const PcapOptions& options) {
  if (options.metadata) return ReadOusterMetadata(*options.metadata);
  const fs::path beside = MetadataBeside(options.input);
  if (!fs::is_regular_file(beside)) return std::nullopt;
  return ReadOusterMetadata(beside);
}

// A sensor that GPS sets is heard within a second of the time that it tells. Else its hour began
// anywhere, and the packet that was heard soonest after it was sent gives the offset.
HourClock ClockOf(const std::vector<double>& delays_s, std::string& text) {
  constexpr double kLongestDelay_s = 1.0;
  HourClock clock;
  const double delay_s = UpperMedian(delays_s);
  text = fmt::format("the sensor's own, set by GPS (packets are heard {:.1f} ms later)",
                     1e3 * delay_s);
  if (std::abs(delay_s) < kLongestDelay_s) return clock;
  const double least_s = *std::min_element(delays_s.begin(), delays_s.end());
  clock.offset = Duration::FromSeconds(least_s);
  text = fmt::format(
      "the capturing host's: the sensor's own is not set by GPS, and was moved by {:.3f} s",
      least_s);
  return clock;
}

class PcapConversion {
 public:
  PcapConversion(const PcapOptions& options, PcapReport& report)
      : options_(options), report_(report) {}

  void Run();

 private:
  void MakeDecoder(const std::optional<OusterMetadata>& metadata);
  void LoadImu();
  [[nodiscard]] bool IsWanted(const UdpDatagram& datagram) const;
  void TakeDecoded(OrderedLog& log);
  void AddTurn(Turn turn, OrderedLog& log);
  void AddImu(const ReceivedImu& imu, OrderedLog& log);
  void AddImuUntil(Timestamp received, OrderedLog& log);

  const PcapOptions& options_;
  PcapReport& report_;
  PacketStream stream_;
  std::unique_ptr<PacketDecoder> decoder_;
  ImuFile imu_file_;
  std::size_t next_imu_ = 0;  // index into the file's samples
  std::int32_t imu_seq_ = 0;
  std::int32_t scan_seq_ = 0;
};

void PcapConversion::MakeDecoder(const std::optional<OusterMetadata>& metadata) {
  report_.sensor = stream_.name();
  report_.model = stream_.model;
  if (stream_.model == "ouster") {
    report_.clock_text = "the sensor's own";
    report_.T_imu_lidar = metadata->T_sensor_imu.Inverse();
    decoder_ = std::make_unique<OusterDecoder>(*metadata);
    return;
  }
  const HourClock clock = ClockOf(stream_.delays_s, report_.clock_text);
  decoder_ = std::make_unique<VelodyneDecoder>(stream_.model, clock);
}

void PcapConversion::LoadImu() {
  const auto file = options_.imu ? options_.imu : ImuFileBeside(options_.input);
  if (!file) return;
  imu_file_ = ReadImuFile(*file);
  report_.losses.num_imu_damaged = imu_file_.num_damaged;
  report_.imu_text = fmt::format("{} ({})", file->string(), imu_file_.description);
  report_.T_imu_lidar.reset();  // it says where the lidar's own IMU sits
}

// The IMU of an Ouster sends to a port of its own.
bool PcapConversion::IsWanted(const UdpDatagram& datagram) const {
  if (datagram.source != stream_.source) return false;
  if (datagram.port == stream_.port) return true;
  return stream_.model == "ouster" && datagram.payload.size() == kOusterImuBytes &&
         imu_file_.samples.empty();
}

void PcapConversion::Run() {
  const std::optional<OusterMetadata> metadata = MetadataOf(options_);
  stream_ = ChooseStream(FindStreams(options_.input, metadata), options_.sensor);
  MakeDecoder(metadata);
  LoadImu();
  UdpCapture capture(options_.input);
  OrderedLog log(options_.output);
  UdpDatagram datagram;
  while (capture.Next(datagram)) {
    if (options_.progress && capture.counts().num_frames % 256 == 0) {
      options_.progress(capture.progress());
    }
    if (IsWanted(datagram)) {
      decoder_->Add(datagram.payload, datagram.received);
      TakeDecoded(log);
    } else {
      ++report_.num_datagrams_other;
    }
  }
  decoder_->Finish();
  TakeDecoded(log);
  if (report_.lidar.num() > 0) AddImuUntil(Timestamp{INT64_MAX}, log);
  log.Close();
  report_.num_packets = decoder_->counts().num_taken;
  report_.losses.num_packets_damaged = decoder_->counts().num_damaged;
  report_.losses.num_packets_lost = decoder_->counts().num_lost;
  report_.num_frames_other = capture.counts().num_other;
  report_.losses.num_frames_cut = capture.counts().num_cut;
  report_.losses.num_fragments_lost = capture.counts().num_fragments_lost;
  report_.losses.fault = capture.counts().fault;
  report_.num_events = log.num_events();
  report_.num_late_events = log.num_late();
}

void PcapConversion::TakeDecoded(OrderedLog& log) {
  for (const ReceivedImu& imu : decoder_->TakeImu()) {
    report_.imu_text = "the lidar's own";
    AddImu(imu, log);
  }
  for (Turn& turn : decoder_->TakeTurns()) {
    AddImuUntil(turn.received, log);
    AddTurn(std::move(turn), log);
  }
}

void PcapConversion::AddImuUntil(Timestamp received, OrderedLog& log) {
  while (next_imu_ < imu_file_.samples.size() &&
         imu_file_.samples[next_imu_].received <= received) {
    AddImu(imu_file_.samples[next_imu_++], log);
  }
}

void PcapConversion::AddImu(const ReceivedImu& imu, OrderedLog& log) {
  report_.imu.Add(imu.sample.stamp, imu.received);
  report_.accelerometer.Add(imu.sample);
  log.Add(imu.received, kImuChannel, EncodeImu(imu.sample, imu_seq_++));
}

void PcapConversion::AddTurn(Turn turn, OrderedLog& log) {
  if (!turn.is_whole) {
    ++report_.num_parts_of_turns;
    return;
  }
  const TimedSweep sweep = SortSweep(std::move(turn.points), turn.instants_ns);
  report_.lidar.Add(sweep.first, turn.received);
  report_.num_points += static_cast<std::int64_t>(sweep.points.size());
  const std::size_t max_points =
      options_.whole_scans ? sweep.points.size() : std::size_t{kMaxChunkPoints};
  for (const SentChunk& sent : SplitSweep(sweep, scan_seq_++, turn.received, max_points)) {
    log.Add(sent.sent, kScanChannel, EncodeChunk(sent.chunk));
  }
}

}  // namespace

std::optional<fs::path> ImuFileBeside(const fs::path& capture) {
  fs::path stem = capture;
  stem.replace_extension();
  for (const char* ending : {".imu.csv", ".imu.lcm", ".imu.bag", ".imu.db3", ".imu.mcap"}) {
    const fs::path file = stem.string() + ending;
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

std::vector<fs::path> InputsOf(const PcapOptions& options) {
  std::vector<fs::path> inputs = {options.input,
                                  options.metadata.value_or(MetadataBeside(options.input))};
  if (const auto imu = options.imu ? options.imu : ImuFileBeside(options.input)) {
    inputs.push_back(*imu);
  }
  return inputs;
}

PcapReport ConvertPcap(const PcapOptions& options) {
  PcapReport report;
  PcapConversion(options, report).Run();
  if (report.lidar.num() == 0) {
    throw InputError(fmt::format("{}: {} has no whole turn of {} in it", options.input.string(),
                                 report.sensor, report.model));
  }
  return report;
}

}  // namespace lio
