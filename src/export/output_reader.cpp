// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/output_reader.hpp"

#include "lio/io/event_log.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::int64_t kMaxUtime = std::int64_t{1} << 52;  // in the year 2112

// Decodes the message and hands it on, when there is somebody to take it.
template <typename Message>
void Take(DecodeStatus (*decode)(ByteView, Message&), const LogEvent& event,
          const std::function<void(const Message&, Timestamp)>& taker, ExportCounts& counts) {
  if (!taker) return;
  Message message;
  if (decode(event.data, message) != DecodeStatus::kOk) {
    ++counts.num_refused;
    return;
  }
  ++counts.num_messages;
  const bool is_time = event.utime >= 0 && event.utime < kMaxUtime;
  taker(message, Timestamp::FromMicroseconds(is_time ? event.utime : 0));
}

DecodeStatus DecodeSample(ByteView bytes, ImuSample& sample) {
  std::int32_t seq = 0;
  return DecodeImu(bytes, sample, seq);
}

void TakeEvent(const LogEvent& event, const Channels& channels, const OutputTakers& takers,
               ExportCounts& counts) {
  if (event.channel == channels.odometry) {
    Take(&DecodeOdometry, event, takers.odometry, counts);
  } else if (event.channel == channels.odometry_imu_rate) {
    Take(&DecodeOdometry, event, takers.odometry_imu, counts);
  } else if (event.channel == channels.state) {
    Take(&DecodeFilterState, event, takers.state, counts);
  } else if (event.channel == channels.registration) {
    Take(&DecodeRegistration, event, takers.registration, counts);
  } else if (event.channel == channels.status) {
    Take(&DecodeStatusReport, event, takers.status, counts);
  } else if (event.channel == channels.cloud || event.channel == channels.cloud_full) {
    Take(&DecodeChunk, event, takers.cloud, counts);
  } else if (event.channel == channels.imu) {
    Take(&DecodeSample, event, takers.imu, counts);
  } else if (event.channel == channels.scan) {
    Take(&DecodeChunk, event, takers.scan, counts);
  }
}

}  // namespace

ExportCounts ReadOutputs(const std::filesystem::path& log, const ExportOptions& options,
                         const OutputTakers& takers) {
  EventLogReader reader(log);
  const Channels channels(options.channel_prefix);
  ExportCounts counts;
  LogEvent event;
  while (reader.Next(event)) {
    if (options.progress) options.progress(reader.position_bytes(), reader.size_bytes());
    TakeEvent(event, channels, takers, counts);
  }
  counts.skipped_bytes = reader.skipped_bytes();
  if (counts.num_messages == 0) {
    throw InputError(log.string() +
                     ": has none of the messages of liod that are asked for; a log of " +
                     "its outputs is needed, as lcm-logger records them beside the inputs (" +
                     channels.odometry + ", " + channels.cloud + " and so on)");
  }
  return counts;
}

}  // namespace lio
