// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// For tests: sends one command over LCM and prints the reply.
//   lio_ask ACTION ID [NAME]
#include <fmt/format.h>

#include <cstdlib>

#include "lio/io/bus.hpp"
#include "lio/io/command.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/reply_t.hpp"

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const lio::Channels channels;
  lio::Command command;
  command.action = static_cast<lio::CommandAction>(std::atoi(argv[1]));
  command.request_id = std::atoll(argv[2]);
  if (argc > 3) command.name = argv[3];
  const auto bus = lio::OpenLcmBus("");
  bool is_answered = false;
  bus->Subscribe(channels.reply, 10, [&](lio::ByteView data, std::int64_t) {
    lio::reply_t reply;
    if (reply.decode(data.data(), 0, static_cast<int>(data.size())) < 0) return;
    if (reply.request_id != command.request_id) return;
    is_answered = true;
    fmt::print("{} {} {}\n", reply.request_id, reply.result == 0 ? "done" : "refused", reply.text);
  });
  if (!bus->Publish(channels.command, lio::EncodeCommand(command))) return 4;
  constexpr int kMaxWaits = 600;  // a minute, however busy the machine is
  for (int i = 0; i < kMaxWaits && !is_answered; ++i) {
    (void)bus->Receive(std::chrono::milliseconds(100));
  }
  return is_answered ? 0 : 1;
}
