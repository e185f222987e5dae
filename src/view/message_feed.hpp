// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes liod's messages, from a bus or a recording, to the state that is shown. Messages that
// cannot be decoded are counted, and change nothing.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lio/io/input_decoder.hpp"
#include "lio/view/view_hub.hpp"

namespace lio {

class MessageFeed {
 public:
  MessageFeed(const Channels& channels, ViewHub& hub) : channels_(channels), hub_(hub) {}

  // Returns the channels that are looked at.
  [[nodiscard]] std::vector<std::string> Names() const;
  [[nodiscard]] bool Takes(std::string_view channel) const;
  void Take(std::string_view channel, ByteView bytes, std::int64_t recv_utime);

 private:
  Channels channels_;
  ViewHub& hub_;
};

}  // namespace lio
