// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-log info: prints what a log contains and what is missing in it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>

#include "commands.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/output_account.hpp"
#include "lio/io/printable.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/io/stream_stats.hpp"

namespace lio {
namespace {

constexpr const char* kAboutInfo =
    "Prints the contents of a log: channels with counts, rates and gaps, the time span, damage,\n"
    "and the same figures of the inertial samples and sweeps by their own stamps. If the log has\n"
    "LIO_STATUS, too, its counts are held against what was recorded.\n\n"
    "Example:\n"
    "  lio-log info drive.lcm";

struct ChannelInfo {
  StreamStats events;  // stamped with the time when the log received them
  std::int64_t num_bytes = 0;
};

class LogInfo {
 public:
  explicit LogInfo(const std::string& prefix) : channels_(prefix), account_(channels_) {}

  void Read(EventLogReader& reader) {
    ProgressBar bar("lio-log", reader.size_bytes());
    LogEvent event;
    while (reader.Next(event)) {
      bar.Update(reader.position_bytes());
      const Timestamp received = ReceiveStamp(event.utime);
      ChannelInfo& channel = by_channel_[Printable(event.channel)];
      channel.events.Add(received, received);
      channel.num_bytes += static_cast<std::int64_t>(event.data.size());
      first_ = std::min(first_.value_or(received), received);
      last_ = std::max(last_.value_or(received), received);
      account_.Add(event.channel, event.data);
      if (event.channel == channels_.imu) AddSample(event, received);
      if (event.channel == channels_.scan) AddChunk(event, received);
    }
  }

  void Print(const std::string& file, const EventLogReader& reader) const {
    const double span_s = first_ ? SecondsBetween(*first_, *last_) : 0.0;
    fmt::print("{}: {:.1f} MB, {:.3f} s\n", file, 1e-6 * static_cast<double>(reader.size_bytes()),
               span_s);
    if (first_) {
      fmt::print("  received from {:.6f} to {:.6f}\n", 1e-9 * static_cast<double>(first_->ns),
                 1e-9 * static_cast<double>(last_->ns));
    }
    fmt::print("\n{:24} {:>9} {:>9} {:>10} {:>6} {:>10}\n", "channel", "messages", "MB",
               "rate [Hz]", "gaps", "longest [s]");
    for (const auto& [name, channel] : by_channel_) {
      fmt::print("{:24} {:9} {:9.2f} {:10.2f} {:6} {:10.3f}\n", name, channel.events.num(),
                 1e-6 * static_cast<double>(channel.num_bytes), channel.events.rate_hz(),
                 channel.events.num_gaps(), channel.events.longest_gap_s());
    }
    fmt::print(
        "A gap is a pause of more than three usual periods; the chunks of a sweep count, too.\n");
    if (samples_.num() + sweeps_.num() > 0) fmt::print("\nBoth kinds by their own stamps:\n");
    PrintStream("inertial samples", samples_);
    PrintStream("sweeps", sweeps_);
    if (samples_.num() > 0) {
      fmt::print("  accelerometer: {:.3f} m/s^2 in its quietest second: {}\n",
                 forces_.quiet_mean_mps2(), forces_.Suggestion());
    }
    if (sweeps_.num() > 0) {
      fmt::print("  points per sweep: {:.0f}\n",
                 static_cast<double>(num_points_) / static_cast<double>(sweeps_.num()));
    }
    fmt::print("{}", account_.Text());
    fmt::print("\ndamage: {} bytes skipped, {} messages refused, {} inertial samples missing\n",
               reader.skipped_bytes(), decoder_.counters().TotalRefused(),
               decoder_.counters().num_imu_missing);
  }

  bool HasEvents() const { return first_.has_value(); }
  std::int64_t num_refused() const { return decoder_.counters().TotalRefused(); }

 private:
  void AddSample(const LogEvent& event, Timestamp received) {
    ImuSample sample;
    if (!decoder_.Imu(event.data, sample)) return;
    samples_.Add(sample.stamp, received);
    forces_.Add(sample);
  }

  // The first chunk of a sweep stands for the sweep.
  void AddChunk(const LogEvent& event, Timestamp received) {
    if (!decoder_.Chunk(event.data, chunk_)) return;
    num_points_ += static_cast<std::int64_t>(chunk_.points.size());
    if (last_seq_ == chunk_.scan_seq) return;
    last_seq_ = chunk_.scan_seq;
    sweeps_.Add(chunk_.stamp, received);
  }

  static void PrintStream(const char* name, const StreamStats& stats) {
    if (stats.num() == 0) return;
    fmt::print(
        "  {}: {}, {:.3f} s at {:.2f} Hz, {} gaps (longest {:.3f} s), {} stamped no later than the "
        "one before, received {:.1f} ms after their stamp\n",
        name, stats.num(), stats.span_s(), stats.rate_hz(), stats.num_gaps(), stats.longest_gap_s(),
        stats.num_backwards(), 1e3 * stats.mean_delay_s());
  }

  Channels channels_;
  OutputAccount account_;
  InputDecoder decoder_;
  ScanChunk chunk_;
  std::map<std::string, ChannelInfo> by_channel_;
  std::optional<Timestamp> first_, last_;
  StreamStats samples_, sweeps_;
  AccelerometerStats forces_;
  std::optional<std::int32_t> last_seq_;
  std::int64_t num_points_ = 0;
};

}  // namespace

CLI::App* AddInfoCommand(CLI::App& app, InfoArguments& arguments) {
  CLI::App* command = app.add_subcommand("info", kAboutInfo);
  command->add_option("LOG", arguments.log, "LCM log")->type_name("IN.lcm")->required();
  arguments.channel_prefix = kDefaultChannelPrefix;
  command
      ->add_option("--channel-prefix", arguments.channel_prefix,
                   "First part of the channels' names")
      ->type_name("NAME")
      ->capture_default_str();
  return command;
}

int RunInfo(const InfoArguments& arguments) {
  EventLogReader reader(arguments.log);
  LogInfo info(arguments.channel_prefix);
  info.Read(reader);
  if (!info.HasEvents()) {
    fmt::print(stderr, "lio-log: {} contains no LCM events: is it an LCM log?\n", arguments.log);
    return kExitUnusableInput;
  }
  info.Print(arguments.log, reader);
  if (reader.skipped_bytes() == 0 && info.num_refused() == 0) return kExitDone;
  fmt::print(stderr, "lio-log: {} is damaged: {} bytes skipped, {} messages refused\n",
             arguments.log, reader.skipped_bytes(), info.num_refused());
  return kExitUnusableInput;
}

}  // namespace lio
