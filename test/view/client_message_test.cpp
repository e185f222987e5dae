// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/client_message.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lio {
namespace {

TEST(ClientMessage, WhatThePageSendsIsUnderstood) {
  EXPECT_EQ(ParseClientMessage(R"({"ack":7})")->ack, 7U);
  EXPECT_EQ(ParseClientMessage(R"({"play":false})")->play, false);
  EXPECT_EQ(ParseClientMessage(R"({"seek_s":12.5})")->seek_s, 12.5);
  const auto both = ParseClientMessage(R"({"speed":2,"play":true})");
  EXPECT_EQ(both->speed, 2.0);
  EXPECT_EQ(both->play, true);
  EXPECT_FALSE(both->ack.has_value());
}

TEST(ClientMessage, AnythingElseIsNone) {
  for (const std::string& text :
       {std::string(), std::string("7"), std::string("[]"), std::string("{"),
        std::string(R"({"ack":-1})"), std::string(R"({"ack":"1"})"), std::string(R"({"play":1})"),
        std::string(R"({"shutdown":true})"), std::string("\xff\xfe"), std::string(300, '['),
        "{\"ack\":1" + std::string(300, ' ') + "}"}) {
    EXPECT_FALSE(ParseClientMessage(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace lio
