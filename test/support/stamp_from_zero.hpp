// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes stamps for tests that count seconds from stamp 0.
#pragma once

#include "lio/base/time.hpp"

namespace lio::test {

constexpr Timestamp StampFromZero(double t_s) {
  return Timestamp{} + Duration::FromSeconds(t_s);
}

}  // namespace lio::test
