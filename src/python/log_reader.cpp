// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/log_reader.hpp"

#include <array>
#include <utility>

#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/output_decoder.hpp"

namespace lio::python {
namespace {

// The estimator closes a sweep with lost chunks so long after its end, unless it is told otherwise
// (PipelineOptions).
constexpr Duration kIncompleteWait{50'000'000};
constexpr std::size_t kMostSamples = 10'000;  // in a batch: 100 s at 100 Hz; chosen

const std::filesystem::path& Checked(const std::filesystem::path& log) {
  RefuseIrregular(log);
  if (const std::string why = WhyNoLog(log); !why.empty()) throw InputError(why);
  return log;
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& log, const std::string& channel_prefix)
    : channels_(channel_prefix), reader_(Checked(log)), assembler_(counters_) {}

std::optional<LogItem> LogReader::Next() {
  while (items_.empty() && !is_at_end_) {
    if (reader_.Next(event_)) {
      Add(event_);
    } else {
      End();
    }
  }
  if (items_.empty()) return std::nullopt;
  LogItem item = std::move(items_.front());
  items_.pop_front();
  return item;
}

void LogReader::Add(const LogEvent& event) {
  const std::array<const std::string*, 5> nav_channels = {
      &channels_.odometry, &channels_.odometry_imu_rate, &channels_.odometry_local,
      &channels_.odometry_base, &channels_.odometry_base_imu_rate};
  for (const std::string* channel : nav_channels) {
    if (event.channel == *channel) return AddNav(event);
  }
  if (event.channel == channels_.imu) return AddImu(event);
  if (event.channel == channels_.scan) return AddChunk(event);
  if (event.channel == channels_.state) AddState(event);
}

void LogReader::AddImu(const LogEvent& event) {
  ImuSample sample;
  if (!decoder_.Imu(event.data, sample)) return;
  // A sweep comes before the sample that closes it, so that it closes it in the estimator, too.
  CloseSweepsAt(event.utime);
  samples_.samples.push_back(sample);
  if (samples_.samples.size() >= kMostSamples) GiveSamples();
}

void LogReader::AddChunk(const LogEvent& event) {
  ScanChunk chunk;
  if (!decoder_.Chunk(event.data, chunk)) return;
  last_chunk_ = {chunk.stamp + LastOffset(chunk), event.utime};
  assembler_.Add(std::move(chunk), 0);
  GiveSweeps();
}

// The lidar's time is told by when the log received its last chunk, since the samples' clock may be
// another one. It is floating point, because a damaged log may hold any number.
void LogReader::CloseSweepsAt(std::int64_t utime) {
  constexpr double kLongest_us = 1e12;
  const double since_us = static_cast<double>(utime) - static_cast<double>(last_chunk_.utime);
  if (!(since_us > 0.0 && since_us < kLongest_us)) return;
  assembler_.CloseUpTo(last_chunk_.end + Duration::FromSeconds(since_us * 1e-6) - kIncompleteWait);
  GiveSweeps();
}

void LogReader::AddNav(const LogEvent& event) {
  NavOutput nav;
  if (DecodeOdometry(event.data, nav) != DecodeStatus::kOk) {
    ++num_outputs_refused_;
    return;
  }
  GiveSamples();
  items_.emplace_back(EstimateOf(event.channel, nav));
}

void LogReader::AddState(const LogEvent& event) {
  FilterReport report;
  if (DecodeFilterState(event.data, report) != DecodeStatus::kOk) {
    ++num_outputs_refused_;
    return;
  }
  GiveSamples();
  items_.emplace_back(EstimateOfState(event.channel, report));
}

void LogReader::GiveSamples() {
  if (samples_.samples.empty()) return;
  items_.emplace_back(std::exchange(samples_, {}));
}

void LogReader::GiveSweeps() {
  while (std::optional<Sweep> sweep = assembler_.Take()) {
    GiveSamples();
    items_.emplace_back(std::move(*sweep));
  }
}

void LogReader::End() {
  is_at_end_ = true;
  assembler_.CloseAll();
  GiveSweeps();
  GiveSamples();
}

}  // namespace lio::python
