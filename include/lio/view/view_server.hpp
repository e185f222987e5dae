// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Serves the page of lio-view over HTTP and its data over a WebSocket, on one thread. Clients share
// the state of the hub; each has a few numbers of its own, and one frame on its way. The number of
// connections and the size and time of every request are bounded.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "lio/view/log_player.hpp"
#include "lio/view/view_hub.hpp"

namespace lio {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  // 0: any that is free
  std::string token;          // empty: none, which needs a loopback address
  std::string source;         // is named on the page
  std::string version;
};

// Why the server may not listen so; empty when it may.
[[nodiscard]] std::string WhyNotServed(const ServerOptions& options);
[[nodiscard]] bool IsLoopbackAddress(const std::string& address);  // false for what is no address
// 128 random bits as text.
[[nodiscard]] std::string MakeToken();

struct ServerCounts {
  std::int64_t num_clients = 0;  // clients since the start
  std::int64_t num_frames = 0;
  std::int64_t num_bytes = 0;
  std::int64_t num_poses_left_out = 0;  // for slow clients
  std::int64_t num_scans_left_out = 0;
  std::int64_t num_turned_away = 0;  // without a right, or because there were too many
};

class ViewServer {
 public:
  // Listens. `player` is null when the data are live; hub and player outlive the server. Throws
  // UsageError when the address cannot be listened on.
  ViewServer(const ServerOptions& options, const ViewHub& hub, LogPlayer* player);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::string Url() const;  // to open, with the token

  // Serves until Stop, or until a signal asks the program to end (SIGINT, SIGTERM).
  void Run();
  void Stop();  // from any thread

  [[nodiscard]] ServerCounts counts() const;  // after Run

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
