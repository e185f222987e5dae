// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Captures of a lidar's packets, and what lies beside them.
#include "convert/imu_file.hpp"
#include "convert/ouster_decoder.hpp"
#include "convert/velodyne_decoder.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "lio/convert/pcap_convert.hpp"

namespace lio::fuzz {
namespace {

constexpr std::size_t kVelodynePacketBytes = 1206;
constexpr Timestamp kReceived{1'700'000'000'000'000'000};
constexpr Duration kPacketPeriod{1'000'000};

OusterMetadata SmallOuster(OusterProfile profile) {
  OusterMetadata sensor;
  sensor.profile = profile;
  sensor.columns_per_turn = 16;
  sensor.columns_per_packet = 4;
  sensor.elevation_rad = {0.2, -0.2};
  sensor.azimuth_offset_rad = {0.05, -0.05};
  return sensor;
}

void Decode(PacketDecoder& decoder, ByteView bytes, std::size_t packet_bytes) {
  for (Timestamp received = kReceived; !bytes.empty(); received = received + kPacketPeriod) {
    const std::size_t size = std::min(packet_bytes, bytes.size());
    decoder.Add(bytes.first(size), received);
    bytes = bytes.subspan(size);
  }
  decoder.Finish();
  (void)decoder.TakeImu();
  for (const Turn& turn : decoder.TakeTurns()) {
    if (turn.points.size() != turn.instants_ns.size()) std::abort();
  }
}

}  // namespace

// Ouster's metadata end at the first zero byte, and are missing where there are none; the capture
// comes after them.
void Pcap(ByteView bytes) {
  const ByteView metadata = CutPart(bytes);
  PcapOptions options;
  options.input = ScratchFile("capture.pcap", bytes);
  options.output = ScratchFolder() / "capture.lcm";
  if (!metadata.empty()) options.metadata = ScratchFile("sensor.json", metadata);
  MayRefuse([&] { (void)FormatReport(ConvertPcap(options), options); });
}

// The first byte chooses the sensor, and packets of its size follow.
void LidarPackets(ByteView bytes) {
  if (bytes.empty()) return;
  const ByteView packets = bytes.subspan(1);
  constexpr std::array kVelodynes = {"vlp16", "hdl32e"};
  const unsigned choice = bytes.front() % 4U;
  if (choice < kVelodynes.size()) {
    VelodyneDecoder decoder(kVelodynes[choice], HourClock());
    return Decode(decoder, packets, kVelodynePacketBytes);
  }
  const OusterMetadata sensor =
      SmallOuster(choice == 2 ? OusterProfile::kLegacy : OusterProfile::kRng19);
  OusterDecoder lidar(sensor);
  Decode(lidar, packets, sensor.PacketBytes());
  OusterDecoder imu(sensor);
  Decode(imu, packets, kOusterImuBytes);
}

void ImuTable(ByteView bytes) {
  MayRefuse([&] {
    const ImuFile file = ReadImuFile(ScratchFile("beside.imu.csv", bytes));
    StreamStats stats;
    for (const ReceivedImu& imu : file.samples) stats.Add(imu.sample.stamp, imu.received);
  });
}

void OusterJson(ByteView bytes) {
  MayRefuse([&] {
    const OusterMetadata sensor = ReadOusterMetadata(ScratchFile("sensor.json", bytes));
    OusterDecoder decoder(sensor);
    Decode(decoder, bytes, sensor.PacketBytes());
  });
}

}  // namespace lio::fuzz
