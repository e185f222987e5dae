// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/http_request.hpp"

#include <gtest/gtest.h>

#include <boost/asio/buffer.hpp>
#include <string>

namespace lio {
namespace {

namespace http = boost::beast::http;

const std::string kRequestToken = "0123456789abcdef";

HttpRequest Get(const std::string& target) {
  HttpRequest request{http::verb::get, target, 11};
  request.set(http::field::host, "localhost:8080");
  return request;
}

HttpOutcome Outcome(const HttpRequest& request, const std::string& token = "") {
  return DecideOn(request, token).outcome;
}

TEST(HttpRequest, FilesAreOnlyRead) {
  HttpRequest request = Get("/main.js?token=x");
  EXPECT_EQ(Outcome(request), HttpOutcome::kFile);
  EXPECT_EQ(DecideOn(request, "").path, "/main.js");
  request.method(http::verb::head);
  EXPECT_EQ(Outcome(request), HttpOutcome::kFile);
  request.method(http::verb::post);
  EXPECT_EQ(Outcome(request), HttpOutcome::kWrongMethod);
}

TEST(HttpRequest, DataNeedARightAndAWebSocket) {
  const std::string target = "/data?token=" + kRequestToken;
  HttpRequest request = Get(target);
  EXPECT_EQ(Outcome(request, kRequestToken), HttpOutcome::kNoUpgrade);
  request.set(http::field::connection, "upgrade");
  request.set(http::field::upgrade, "websocket");
  request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
  request.set(http::field::sec_websocket_version, "13");
  EXPECT_EQ(Outcome(request, kRequestToken), HttpOutcome::kWebSocket);
  EXPECT_EQ(Outcome(request, kRequestToken + "0"), HttpOutcome::kNoRight);
  request.set(http::field::origin, "http://evil.example");
  EXPECT_EQ(Outcome(request, kRequestToken), HttpOutcome::kNoRight);
}

TEST(HttpRequest, APageAsksWhetherItHasTheRight) {
  HttpRequest request = Get("/allowed");
  EXPECT_EQ(Outcome(request), HttpOutcome::kAllowed);
  EXPECT_EQ(Outcome(request, kRequestToken), HttpOutcome::kNoRight);
  request.set(http::field::host, "evil.example");
  EXPECT_EQ(Outcome(request), HttpOutcome::kNoRight);
}

TEST(HttpRequest, WhatIsTooLargeIsRefused) {
  const auto error_of = [](const std::string& bytes) {
    HttpParser parser;
    parser.eager(true);
    LimitRequest(parser);
    boost::beast::error_code error;
    parser.put(boost::asio::buffer(bytes), error);
    return error;
  };
  EXPECT_FALSE(error_of("GET / HTTP/1.1\r\nHost: a\r\n\r\n"));
  EXPECT_EQ(error_of("GET / HTTP/1.1\r\nX: " + std::string(kMaxHeaderBytes, 'x') + "\r\n\r\n"),
            http::error::header_limit);
  EXPECT_EQ(error_of("POST / HTTP/1.1\r\nContent-Length: 1025\r\n\r\n"), http::error::body_limit);
}

}  // namespace
}  // namespace lio
