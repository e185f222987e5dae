// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/view_hub.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "view/view_fixture.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

TEST(ViewHub, AReaderSeesWholeChanges) {
  ViewHub hub;
  std::jthread writer([&] {
    for (int i = 1; i <= 1000; ++i) {
      hub.Change([&](ViewState& view) {
        view.OnOdometry(test::NavAt(i), test::UtimeAt(i));
        view.CountRefused();
      });
    }
  });
  for (int i = 0; i < 1000; ++i) {
    hub.Read([](const ViewState& view) {
      EXPECT_EQ(view.num_refused(), static_cast<std::int64_t>(view.path().rows().size()));
    });
  }
}

}  // namespace
}  // namespace lio
