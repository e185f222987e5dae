// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Checks properties on many random cases by rapidcheck, which shrinks failing cases. The seed is
// fixed unless RC_PARAMS is set in the environment.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <utility>

namespace lio::test {

// `property` takes its random inputs as arguments, or draws them with operator*.
template <class Property>
void CheckProperty(Property&& property) {
  setenv("RC_PARAMS", "seed=20261121 max_success=60", /*overwrite=*/0);
  EXPECT_TRUE(rc::check(std::forward<Property>(property)));
}

}  // namespace lio::test
