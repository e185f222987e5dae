// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads a request to lio-view and decides what it gets, without a socket.
#pragma once

#include <boost/beast/http.hpp>
#include <string_view>

namespace lio {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpParser = boost::beast::http::request_parser<boost::beast::http::string_body>;

inline constexpr std::uint32_t kMaxHeaderBytes = 8192;
inline constexpr std::uint64_t kMaxBodyBytes = 1024;

// Makes a parser refuse what is larger.
void LimitRequest(HttpParser& parser);

enum class HttpOutcome {
  kFile,        // the file at `path`, if there is one
  kWebSocket,   // the data
  kNoUpgrade,   // the data, but by no WebSocket
  kAllowed,     // it asked whether it has the right to the data
  kNoRight,     // it asked for the data or for the right, and has none
  kWrongMethod  // neither GET nor HEAD
};

struct HttpDecision {
  HttpOutcome outcome = HttpOutcome::kFile;
  std::string_view path;  // a view of the request
};

// Without a token for the server (empty), it listens on a loopback address.
[[nodiscard]] HttpDecision DecideOn(const HttpRequest& request, std::string_view server_token);

}  // namespace lio
