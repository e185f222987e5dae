// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Feeds lio-view with what a browser, or whoever pretends to be one, sends.
#include <boost/asio/buffer.hpp>
#include <cstdlib>

#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "view/access.hpp"
#include "view/client_message.hpp"
#include "view/http_request.hpp"

namespace lio::fuzz {
namespace {

constexpr std::string_view kToken = "0123456789abcdef";

bool GivesData(HttpOutcome outcome) {
  return outcome == HttpOutcome::kAllowed || outcome == HttpOutcome::kWebSocket;
}

// Without the token nobody gets the data of a server that has one.
void Decide(const HttpRequest& request) {
  (void)DecideOn(request, "");
  const HttpDecision decision = DecideOn(request, kToken);
  const std::string_view target(request.target().data(), request.target().size());
  if (GivesData(decision.outcome) && target.find(kToken) == std::string_view::npos) std::abort();
}

}  // namespace

// One request after another, as on a connection that is kept.
void HttpRequests(ByteView bytes) {
  while (!bytes.empty()) {
    HttpParser parser;
    parser.eager(true);
    LimitRequest(parser);
    boost::beast::error_code error;
    const std::size_t size = parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    if (error || !parser.is_done()) return;
    Decide(parser.get());
    bytes = bytes.subspan(size);
  }
}

void ClientMessages(ByteView bytes) {
  const auto message = ParseClientMessage(TextOf(bytes));
  if (message && bytes.size() > kMaxClientBytes) std::abort();
}

}  // namespace lio::fuzz
