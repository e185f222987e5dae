// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds an event for people, e.g. why the initialization still waits, with the fix where there is
// one.
#pragma once

#include <cstdint>
#include <string>

#include "lio/base/time.hpp"

namespace lio {

struct Notice {
  // kError: the configuration contradicts the data, and all that follows is ignored.
  enum class Severity : std::int8_t { kInfo, kWarning, kError };
  Timestamp stamp;
  Severity severity = Severity::kInfo;
  std::string text;
};

}  // namespace lio
