// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/receiver.hpp"

#include <chrono>

#include "app/command_rules.hpp"

namespace lio {
namespace {

using std::chrono::milliseconds;

constexpr int kImuCapacity = 4096;  // samples: some seconds at 1 kHz
constexpr int kScanCapacity =
    1024;  // chunks: forty sweeps; LCM's default of 30 would lose two thirds of them
// The capacity exceeds the inbox's, so that those that are too many are answered.
constexpr int kCommandCapacity = 2 * FilterInbox::kMaxRequests;
constexpr int kStatusCapacity = 64;        // chosen: a minute of one daemon's
constexpr milliseconds kPollInterval(50);  // after which Stop is noticed
constexpr milliseconds kQuiet(20);         // after which without a message all have arrived
constexpr milliseconds kMaxDrain(200);

}  // namespace

Receiver::Receiver(Bus& bus, const Channels& channels, ClockNs clock, FilterInbox& inbox,
                   StatusBoard& board, OtherDaemons& others, Refuse refuse)
    : bus_(bus), clock_(clock), inbox_(inbox), board_(board), refuse_(std::move(refuse)) {
  bus.Subscribe(channels.imu, kImuCapacity,
                [this](ByteView data, std::int64_t utime) { OnImu(data, utime); });
  bus.Subscribe(channels.scan, kScanCapacity,
                [this](ByteView data, std::int64_t utime) { OnScan(data, utime); });
  bus.Subscribe(channels.command, kCommandCapacity,
                [this](ByteView data, std::int64_t) { OnCommand(data); });
  bus.Subscribe(channels.status, kStatusCapacity,
                [&others](ByteView data, std::int64_t) { others.Hear(data); });
}

void Receiver::Run() {
  while (!is_stopping_ && !has_ended_) {
    if (bus_.Receive(kPollInterval) == ReceiveResult::kClosed) has_ended_ = true;
    ReportCounters();
  }
  if (!has_ended_) Drain();
}

void Receiver::Drain() {
  const auto deadline = std::chrono::steady_clock::now() + kMaxDrain;
  while (bus_.Receive(kQuiet) == ReceiveResult::kMessage &&
         std::chrono::steady_clock::now() < deadline) {
  }
  ReportCounters();
}

void Receiver::ReportCounters() {
  for (const std::int64_t seen = bus_.num_oversized(); num_oversized_ < seen; ++num_oversized_) {
    decoder_.Refuse(DecodeStatus::kTooLarge);
  }
  board_.SetInput(decoder_.counters());
}

void Receiver::OnImu(ByteView data, std::int64_t recv_utime) {
  const std::int64_t begin = clock_();
  Arrival<ImuSample> arrival{{}, recv_utime, 0};
  if (!decoder_.Imu(data, arrival.data)) return;
  arrival.decode_ns = clock_() - begin;
  ReportCounters();  // first, so that no message is in the inbox before it is counted
  inbox_.Put(std::move(arrival));
}

void Receiver::OnScan(ByteView data, std::int64_t recv_utime) {
  const std::int64_t begin = clock_();
  Arrival<ScanChunk> arrival{{}, recv_utime, 0};
  if (!decoder_.Chunk(data, arrival.data)) return;
  arrival.decode_ns = clock_() - begin;
  ReportCounters();
  inbox_.Put(std::move(arrival));
}

void Receiver::OnCommand(ByteView data) {
  Command command;
  const DecodeStatus status = DecodeCommand(data, command);
  if (status == DecodeStatus::kOk) {
    if (!inbox_.Put(Request{command})) refuse_(command, "too many commands wait already");
  } else if (status == DecodeStatus::kBadFormat) {
    const std::string why = WhyUnusable(command);
    refuse_(command, why.empty() ? "the command is malformed" : why);
  } else {
    board_.CountRefusedCommand();  // nobody knows whom to answer
  }
}

}  // namespace lio
