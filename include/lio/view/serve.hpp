// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Serves the page while a feed, on a thread of its own, brings what it shows.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "lio/view/view_server.hpp"

namespace lio {

// Returns as ViewServer::Run does, after the feed was asked to stop and has ended. An exception
// that leaves the feed ends the serving, because nothing new would be shown: then one line says
// what the feed was ended by.
[[nodiscard]] std::optional<std::string> ServeWhile(
    const std::function<void(const std::stop_token&)>& feed, ViewServer& server);

}  // namespace lio
