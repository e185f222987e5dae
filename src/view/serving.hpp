// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The connections of the server share these; all of them run on its one thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>

#include "lio/view/view_server.hpp"
#include "view/http_request.hpp"

namespace lio {

struct Serving {
  ServerOptions options;
  const ViewHub& hub;
  LogPlayer* player = nullptr;
  ServerCounts counts;
  int num_connections = 0;  // all kinds together
  int num_pages = 0;        // WebSockets
};

inline constexpr int kMaxConnections = 64;
inline constexpr int kMaxPages = 16;

// Reads one request after another of a connection, and hands it on when it asks for a WebSocket.
void ServeHttp(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Serving>& serving);

// Takes over a connection whose request asks for a WebSocket, and has the right to.
void ServePage(boost::beast::tcp_stream stream, const HttpRequest& request,
               const std::shared_ptr<Serving>& serving);

}  // namespace lio
