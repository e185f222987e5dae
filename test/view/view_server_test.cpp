// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Talks to a server over real sockets of this machine, as browsers and as strangers do.
#include "lio/view/view_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <thread>

#include "lio/io/input_error.hpp"
#include "view/frame_reader.hpp"
#include "view/view_fixture.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using ::testing::HasSubstr;

const std::string kServerToken = "0123456789abcdef0123";

class ViewServerTest : public ::testing::Test {
 protected:
  void Start(const std::string& token = "") {
    ServerOptions options;
    options.port = 0;
    options.token = token;
    options.source = "a test";
    server_ = std::make_unique<ViewServer>(options, hub_, nullptr);
    host_ = "localhost:" + std::to_string(server_->port());
    thread_ = std::jthread([this] { server_->Run(); });
  }
  void Stop() {
    server_->Stop();
    thread_.join();
  }
  void TearDown() override {
    if (thread_.joinable()) Stop();
  }

  tcp::socket Connect() {
    tcp::socket socket(io_);
    socket.connect({asio::ip::make_address("127.0.0.1"), server_->port()});
    return socket;
  }
  // Gives what the server says to these bytes until it closes or has said an answer.
  std::string Say(const std::string& bytes) {
    tcp::socket socket = Connect();
    boost::system::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
    socket.shutdown(tcp::socket::shutdown_send, error);
    std::string answer;
    asio::read(socket, asio::dynamic_buffer(answer), error);
    return answer;
  }
  std::string Get(const std::string& target, const std::string& headers = "",
                  const std::string& method = "GET") {
    return Say(method + " " + target + " HTTP/1.1\r\nHost: " + host_ + "\r\nConnection: close\r\n" +
               headers + "\r\n");
  }

  using Page = beast::websocket::stream<tcp::socket>;
  std::unique_ptr<Page> Open(const std::string& target = "/data") {
    auto page = std::make_unique<Page>(Connect());
    page->handshake(host_, target);
    return page;
  }
  static Bytes ReadFrame(Page& page) {
    beast::flat_buffer buffer;
    page.read(buffer);
    const auto* data = static_cast<const std::uint8_t*>(buffer.cdata().data());
    return {data, data + buffer.size()};
  }

  asio::io_context io_;
  ViewHub hub_;
  std::string host_;
  std::unique_ptr<ViewServer> server_;
  std::jthread thread_;
};

TEST_F(ViewServerTest, ServesThePageWithItsRules) {
  Start();
  const std::string answer = Get("/");
  EXPECT_THAT(answer, HasSubstr("200 OK"));
  EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none'"));
  EXPECT_THAT(answer, HasSubstr("<title>lio-view</title>"));
  EXPECT_THAT(Get("/main.js"), HasSubstr("text/javascript"));
  EXPECT_THAT(Get("/nothing"), HasSubstr("404"));
  EXPECT_THAT(Get("/", "", "POST"), HasSubstr("405"));
  const std::string head = Get("/", "", "HEAD");
  EXPECT_THAT(head, HasSubstr("200 OK"));
  EXPECT_THAT(head, ::testing::Not(HasSubstr("<title>")));
}

TEST_F(ViewServerTest, APageGetsAGreetingAndThenWhatChanges) {
  Start();
  const auto page = Open();
  Bytes frame = ReadFrame(*page);
  EXPECT_THAT(test::Sections(frame).at(Section::kHello).Text(), HasSubstr("\"a test\""));
  hub_.Change([](ViewState& view) { view.OnCloud(test::CloudOf(1, 10), 0, false); });
  page->write(asio::buffer(std::string(R"({"ack":1})")));
  frame = ReadFrame(*page);
  while (test::Sections(frame).at(Section::kMap).is_at_end()) frame = ReadFrame(*page);
  page->close(beast::websocket::close_code::normal);
  Stop();
  EXPECT_EQ(server_->counts().num_clients, 1);
  EXPECT_GE(server_->counts().num_frames, 2);
}

TEST_F(ViewServerTest, APageThatDoesNotAnswerGetsNoMoreAndHoldsUpNobody) {
  Start();
  const auto silent = Open();
  for (int i = 0; i < 50; ++i) {
    hub_.Change([&](ViewState& view) { view.OnOdometry(test::NavAt(i), test::UtimeAt(i)); });
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const auto other = Open();
  (void)ReadFrame(*other);
  Bytes frame = ReadFrame(*other);
  EXPECT_EQ(test::Sections(frame).count(Section::kPose), 1U);
  Stop();
  EXPECT_LE(server_->counts().num_frames, 2 + 2);
}

TEST_F(ViewServerTest, APageThatSaysNonsenseIsClosed) {
  Start();
  const auto page = Open();
  page->write(asio::buffer(std::string("nonsense")));
  boost::system::error_code error;
  beast::flat_buffer buffer;
  while (!error) page->read(buffer, error);
  EXPECT_EQ(error, beast::websocket::error::closed);
  const auto shouting = Open();
  shouting->write(asio::buffer(std::string(100'000, 'x')), error);
  error = {};
  while (!error) shouting->read(buffer, error);
  EXPECT_THAT(Get("/"), HasSubstr("200 OK"));
}

TEST_F(ViewServerTest, OthersPagesAndOthersNamesGetNoData) {
  Start();
  EXPECT_THAT(Get("/allowed"), HasSubstr("204"));
  EXPECT_THAT(Get("/allowed", "Origin: http://evil.example\r\n"), HasSubstr("401"));
  EXPECT_THAT(Get("/data", "Origin: http://evil.example\r\n"), HasSubstr("401"));
  EXPECT_THAT(Say("GET /allowed HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
              HasSubstr("401"));
  EXPECT_THAT(Get("/data"), HasSubstr("426"));
}

TEST_F(ViewServerTest, WithATokenNobodyElseGetsData) {
  Start(kServerToken);
  EXPECT_THAT(Get("/allowed"), HasSubstr("401"));
  EXPECT_THAT(Get("/allowed?token=" + kServerToken + "0"), HasSubstr("401"));
  EXPECT_THAT(Get("/allowed?token=" + kServerToken), HasSubstr("204"));
  EXPECT_THROW(Open(), boost::system::system_error);
  const Bytes frame = ReadFrame(*Open("/data?token=" + kServerToken));
  EXPECT_EQ(test::Sections(frame).count(Section::kHello), 1U);
  EXPECT_THAT(server_->Url(), HasSubstr("?token=" + kServerToken));
}

TEST_F(ViewServerTest, HostileRequestsAreSurvived) {
  Start();
  const std::string long_line(100'000, 'a');
  for (const std::string& bytes :
       {std::string(), std::string("\0\0\0\0", 4), std::string("\r\n\r\n"), long_line,
        "GET /" + long_line + " HTTP/1.1\r\n\r\n", std::string("GET / HTTP/9.9\r\n\r\n"),
        "GET / HTTP/1.1\r\nX: " + long_line + "\r\n\r\n",
        std::string("POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nfffffffff\r\n"),
        std::string("GET /data HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                    "Connection: Upgrade\r\nSec-WebSocket-Version: 99\r\n\r\n"),
        std::string("GET \xff\xfe HTTP/1.1\r\nHost: \xff\r\n\r\n")}) {
    (void)Say(bytes);
    EXPECT_THAT(Get("/allowed"), HasSubstr("204"));
  }
}

TEST_F(ViewServerTest, ConnectionsAreBounded) {
  Start();
  std::vector<tcp::socket> idle;
  for (int i = 0; i < 100; ++i) idle.push_back(Connect());
  EXPECT_EQ(Get("/allowed"), "");  // all places are taken
  idle.clear();
  std::string answer;
  for (int i = 0; i < 100 && answer.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    answer = Get("/allowed");
  }
  EXPECT_THAT(answer, HasSubstr("204"));
  Stop();
  EXPECT_GT(server_->counts().num_turned_away, 0);
}

TEST(ViewServerOptions, AnotherAddressThanLoopbackNeedsAToken) {
  ServerOptions options;
  EXPECT_EQ(WhyNotServed(options), "");
  options.address = "::1";
  EXPECT_EQ(WhyNotServed(options), "");
  options.address = "0.0.0.0";
  EXPECT_THAT(WhyNotServed(options), HasSubstr("needs a token"));
  options.token = "short";
  EXPECT_THAT(WhyNotServed(options), HasSubstr("16 to 128"));
  options.token = MakeToken();
  EXPECT_EQ(WhyNotServed(options), "");
  options.address = "nowhere";
  EXPECT_THAT(WhyNotServed(options), HasSubstr("is no address"));
  EXPECT_TRUE(IsLoopbackAddress("127.1.2.3"));
  EXPECT_FALSE(IsLoopbackAddress("localhost"));
}

TEST(ViewServerOptions, APortThatIsTakenIsTold) {
  const ViewHub hub;
  ServerOptions options;
  options.port = 0;
  const ViewServer first(options, hub, nullptr);
  options.port = first.port();
  try {
    const ViewServer second(options, hub, nullptr);
    FAIL() << "two servers listen on one port";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot listen on 127.0.0.1 port"));
  }
}

}  // namespace
}  // namespace lio
