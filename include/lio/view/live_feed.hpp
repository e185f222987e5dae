// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Hears liod's messages on an LCM bus and hands them to the viewer.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "lio/io/bus.hpp"
#include "lio/view/view_hub.hpp"

namespace lio {

class LiveFeed {
 public:
  // Throws TransportError when LCM cannot open the URL.
  LiveFeed(std::string url, std::string channel_prefix, ViewHub& hub);
  // Takes any bus instead, which cannot be opened again.
  LiveFeed(std::unique_ptr<Bus> bus, std::string channel_prefix, ViewHub& hub);

  // Until it is asked to stop. A server of tcpq:// that went away is called again each second; a
  // file:// that has ended stays as it is.
  void Run(const std::stop_token& stop);

 private:
  void Subscribe();
  void OpenAgain();

  std::string url_;
  std::string channel_prefix_;
  ViewHub& hub_;
  std::unique_ptr<Bus> bus_;
};

}  // namespace lio
