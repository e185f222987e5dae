// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/http_request.hpp"

#include <boost/beast/websocket/rfc6455.hpp>

#include "view/access.hpp"

namespace lio {
namespace {

namespace http = boost::beast::http;

std::string_view View(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

HttpOutcome OutcomeOf(const HttpRequest& request, const Target& target,
                      std::string_view server_token) {
  if (target.path == "/data" || target.path == "/allowed") {
    const Requester requester{View(request[http::field::host]), View(request[http::field::origin]),
                              target.token};
    if (!MaySee(requester, server_token)) return HttpOutcome::kNoRight;
    if (target.path == "/allowed") return HttpOutcome::kAllowed;
    return boost::beast::websocket::is_upgrade(request) ? HttpOutcome::kWebSocket
                                                        : HttpOutcome::kNoUpgrade;
  }
  const bool is_read = request.method() == http::verb::get || request.method() == http::verb::head;
  return is_read ? HttpOutcome::kFile : HttpOutcome::kWrongMethod;
}

}  // namespace

void LimitRequest(HttpParser& parser) {
  parser.header_limit(kMaxHeaderBytes);
  parser.body_limit(kMaxBodyBytes);
}

HttpDecision DecideOn(const HttpRequest& request, std::string_view server_token) {
  const Target target = ParseTarget(View(request.target()));
  return {OutcomeOf(request, target, server_token), target.path};
}

}  // namespace lio
