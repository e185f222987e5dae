// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fails the test that a worker tells its fault to, where none may happen.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace lio::test {

inline void ExpectNoFault(const std::string& fault) {
  ADD_FAILURE() << fault;
}

}  // namespace lio::test
