// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "packet_streams.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lio/io/input_error.hpp"
#include "velodyne_decoder.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxDelays = 2000;
constexpr std::size_t kMaxStreams = 1000;  // a capture of something else may have many more

void Identify(ByteView payload, const std::optional<OusterMetadata>& ouster, PacketStream& stream) {
  if (ouster && payload.size() == ouster->PacketBytes()) {
    stream.model = "ouster";
    stream.what = "an Ouster";
  } else if (const auto model = VelodyneModel(payload)) {
    stream.model = *model;
    stream.what = model->empty() ? fmt::format("a Velodyne of product {}, which is not supported",
                                               VelodyneProduct(payload))
                                 : "a Velodyne " + *model;
  } else if (stream.what.empty()) {
    stream.what = fmt::format("datagrams of {} bytes", payload.size());
  }
}

PacketStream* StreamOf(const UdpDatagram& datagram, std::vector<PacketStream>& streams) {
  const auto found = std::find_if(streams.begin(), streams.end(), [&](const PacketStream& stream) {
    return stream.source == datagram.source && stream.port == datagram.port;
  });
  if (found != streams.end()) return &*found;
  if (streams.size() == kMaxStreams) return nullptr;
  PacketStream stream;
  stream.source = datagram.source;
  stream.port = datagram.port;
  return &streams.emplace_back(std::move(stream));
}

bool IsLidar(const PacketStream& stream) {
  return !stream.model.empty();
}

std::string List(const std::vector<PacketStream>& streams, bool (*is_listed)(const PacketStream&)) {
  constexpr int kMaxListed = 8;
  std::string text;
  int num_listed = 0;
  for (const PacketStream& stream : streams) {
    if (!is_listed(stream) || num_listed++ >= kMaxListed) continue;
    text += fmt::format("{}{} ({}, {} packets)", text.empty() ? "" : ", ", stream.name(),
                        stream.what, stream.num_packets);
  }
  return text.empty() ? "no UDP at all" : text;
}

}  // namespace

std::string PacketStream::name() const {
  return fmt::format("{}:{}", AddressText(source), port);
}

std::vector<PacketStream> FindStreams(const std::filesystem::path& file,
                                      const std::optional<OusterMetadata>& ouster) {
  UdpCapture capture(file);
  std::vector<PacketStream> streams;
  UdpDatagram datagram;
  while (capture.Next(datagram)) {
    PacketStream* stream = StreamOf(datagram, streams);
    if (stream == nullptr) continue;
    ++stream->num_packets;
    if (stream->model.empty()) Identify(datagram.payload, ouster, *stream);
    const bool is_velodyne = !stream->model.empty() && stream->model != "ouster";
    if (is_velodyne && stream->delays_s.size() < kMaxDelays && VelodyneModel(datagram.payload)) {
      const Timestamp told = HourClock().At(VelodyneTime(datagram.payload), datagram.received);
      stream->delays_s.push_back(SecondsBetween(told, datagram.received));
    }
  }
  return streams;
}

PacketStream ChooseStream(const std::vector<PacketStream>& streams,
                          const std::optional<std::string>& wanted) {
  const auto num_lidars = std::count_if(streams.begin(), streams.end(), IsLidar);
  if (num_lidars == 0) {
    throw InputError(
        "no packets of a VLP-16 or HDL-32E, nor (with its metadata, --metadata FILE.json) of an "
        "Ouster: it has " +
        List(streams, [](const PacketStream&) { return true; }));
  }
  for (const PacketStream& stream : streams) {
    const bool is_wanted = wanted ? stream.name() == *wanted : num_lidars == 1;
    if (IsLidar(stream) && is_wanted) return stream;
  }
  throw UsageError((wanted ? "no lidar " + *wanted + " in the capture: "
                           : std::string("several lidars: choose one with --sensor: ")) +
                   List(streams, IsLidar));
}

}  // namespace lio
