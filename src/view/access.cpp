// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/access.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace lio {
namespace {

constexpr std::size_t kMaxTokenLength = 128;

bool IsTokenCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~").find(c) != std::string_view::npos;
}

// Turns "localhost:8080" into "localhost", "[::1]:8080" into "[::1]".
std::string_view WithoutPort(std::string_view authority) {
  const std::size_t colon = authority.rfind(':');
  const std::size_t bracket = authority.rfind(']');
  const bool has_port =
      colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  return has_port ? authority.substr(0, colon) : authority;
}

bool IsLoopbackName(std::string_view name) {
  if (name == "localhost" || name == "[::1]") return true;
  return name.starts_with("127.") &&
         name.find_first_not_of("0123456789.") == std::string_view::npos;
}

// A browser sends Origin with each WebSocket; other programs need not.
bool IsOwnOrigin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  const std::size_t scheme = origin.find("://");
  return scheme != std::string_view::npos && origin.substr(scheme + 3) == host;
}

}  // namespace

bool IsToken(std::string_view expected, std::string_view given) {
  unsigned difference = expected.size() == given.size() && !expected.empty() ? 0U : 1U;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char wanted = expected.empty() ? '\0' : expected[i % expected.size()];
    difference |= static_cast<unsigned>(static_cast<unsigned char>(wanted ^ given[i]));
  }
  return difference == 0;
}

std::string WhyNoToken(std::string_view token) {
  if (token.size() < kMinTokenLength || token.size() > kMaxTokenLength) {
    return "a token has 16 to 128 characters";
  }
  if (!std::all_of(token.begin(), token.end(), IsTokenCharacter)) {
    return "a token has letters, digits and -._~ alone";
  }
  return {};
}

std::string RandomToken() {
  std::random_device random;  // the kernel's generator, in Debian's library
  std::uniform_int_distribution<int> digit(0, 15);
  constexpr int kNumDigits = 32;
  std::string token;
  for (int i = 0; i < kNumDigits; ++i) {
    token += "0123456789abcdef"[static_cast<std::size_t>(digit(random))];
  }
  return token;
}

Target ParseTarget(std::string_view target) {
  const std::size_t question = target.find('?');
  if (question == std::string_view::npos) return {target, {}};
  Target parsed{target.substr(0, question), {}};
  std::string_view query = target.substr(question + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    constexpr std::string_view kName = "token=";
    if (pair.starts_with(kName)) parsed.token = pair.substr(kName.size());
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
  }
  return parsed;
}

bool MaySee(const Requester& requester, std::string_view server_token) {
  if (!IsOwnOrigin(requester.origin, requester.host)) return false;
  if (!server_token.empty()) return IsToken(server_token, requester.token);
  return IsLoopbackName(WithoutPort(requester.host));
}

}  // namespace lio
