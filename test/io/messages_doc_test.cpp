// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests that docs/messages.md names every type with the fingerprint and size of the generated type.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/base/counters_fields.hpp"
#include "lio/command_t.hpp"
#include "lio/filter_state_t.hpp"
#include "lio/imu_t.hpp"
#include "lio/odometry_t.hpp"
#include "lio/registration_t.hpp"
#include "lio/reply_t.hpp"
#include "lio/scan_t.hpp"
#include "lio/status_t.hpp"
#include "support/build_paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

template <typename Message>
std::string Row(const std::string& name) {
  return fmt::format("| `{}` | `{:016x}` | {}", name,
                     static_cast<std::uint64_t>(Message::getHash()), Message{}.getEncodedSize());
}

TEST(MessagesDoc, FingerprintsAndSizesAreThoseOfTheTypes) {
  const std::filesystem::path source = test::SourceDir();
  const std::string doc = test::ReadText(source / "docs" / "messages.md");
  for (const std::string& row :
       {Row<imu_t>("imu_t"), Row<scan_t>("scan_t"), Row<odometry_t>("odometry_t"),
        Row<filter_state_t>("filter_state_t"), Row<registration_t>("registration_t"),
        Row<status_t>("status_t"), Row<command_t>("command_t"), Row<reply_t>("reply_t")}) {
    EXPECT_THAT(doc, ::testing::HasSubstr(row));
  }
}

TEST(MessagesDoc, EveryTypeIsListed) {
  const std::filesystem::path source = test::SourceDir();
  const std::string doc = test::ReadText(source / "docs" / "messages.md");
  for (const auto& entry : std::filesystem::directory_iterator(source / "lcmtypes")) {
    const std::string stem = entry.path().stem().string();  // lio_imu_t
    EXPECT_THAT(doc, ::testing::HasSubstr("| `" + stem.substr(4) + "` |")) << stem;
  }
}

TEST(MessagesDoc, EveryCounterIsListedWithItsMeaning) {
  const std::filesystem::path source = test::SourceDir();
  const std::string doc = test::ReadText(source / "docs" / "messages.md");
  for (const CounterField& field : kCounterFields) {
    EXPECT_THAT(doc, ::testing::HasSubstr(fmt::format("| `{}` | {} |", field.name, field.meaning)));
  }
}

}  // namespace
}  // namespace lio
