// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Who may see the page's data. On a loopback address everybody of this machine may, but no page of
// another site that a browser of this machine shows: neither by its own requests (Origin) nor by a
// name that it lets point here (Host). On any other address the token decides.
#pragma once

#include <string>
#include <string_view>

namespace lio {

inline constexpr std::size_t kMinTokenLength = 16;

// Compares in a time that depends on the length of `given` alone.
[[nodiscard]] bool IsToken(std::string_view expected, std::string_view given);

// Why a token cannot be used; empty when it can: letters, digits and "-._~", 16 to 128 of them, so
// that it stands in a URL as it is.
[[nodiscard]] std::string WhyNoToken(std::string_view token);

// 128 random bits as text.
[[nodiscard]] std::string RandomToken();

struct Target {
  std::string_view path;
  std::string_view token;  // of ?token=; empty: none
};
[[nodiscard]] Target ParseTarget(std::string_view target);

// The headers are empty where the request has none.
struct Requester {
  std::string_view host;
  std::string_view origin;
  std::string_view token;
};
// Without a token for the server (empty), it listens on a loopback address.
[[nodiscard]] bool MaySee(const Requester& requester, std::string_view server_token);

}  // namespace lio
