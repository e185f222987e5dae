// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <optional>

#include "view/http_request.hpp"
#include "view/serving.hpp"
#include "view/web_files.hpp"

namespace lio {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::chrono::seconds kPatience(10);  // for a request, and for taking the answer

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, std::shared_ptr<Serving> serving)
      : stream_(std::move(socket)), serving_(std::move(serving)) {
    ++serving_->num_connections;
  }
  ~HttpConnection() { --serving_->num_connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void Read() {
    parser_.emplace();
    LimitRequest(*parser_);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->Handle();
                     });
  }

 private:
  using Response = http::response<http::span_body<const char>>;

  void Handle() {
    const HttpDecision decision = DecideOn(parser_->get(), serving_->options.token);
    switch (decision.outcome) {
      case HttpOutcome::kFile:
        return AnswerFile(decision.path);
      case HttpOutcome::kWebSocket:
        return Upgrade();
      case HttpOutcome::kNoUpgrade:
        return Answer(http::status::upgrade_required, {"text/plain", "a WebSocket is needed\n"});
      case HttpOutcome::kAllowed:
        return Answer(http::status::no_content, {"text/plain", {}});
      case HttpOutcome::kNoRight:
        ++serving_->counts.num_turned_away;
        return Answer(http::status::unauthorized, {"text/plain", "no right to see this\n"});
      case HttpOutcome::kWrongMethod:
        return Answer(http::status::method_not_allowed, {"text/plain", "only GET and HEAD\n"});
    }
  }

  void AnswerFile(std::string_view path) {
    if (const auto file = FindWebFile(path)) {
      Answer(http::status::ok, *file);
    } else {
      Answer(http::status::not_found, {"text/plain", "there is no such file\n"});
    }
  }

  void Upgrade() {
    if (serving_->num_pages >= kMaxPages) {
      ++serving_->counts.num_turned_away;
      Answer(http::status::service_unavailable, {"text/plain", "too many pages are open\n"});
    } else {
      ServePage(std::move(stream_), parser_->get(), serving_);
    }
  }

  void Answer(http::status status, const WebFile& file) {
    const HttpRequest& request = parser_->get();
    response_ = {};
    response_.version(request.version());
    response_.result(status);
    response_.keep_alive(request.keep_alive());
    response_.set(http::field::content_type,
                  beast::string_view(file.type.data(), file.type.size()));
    response_.set(http::field::cache_control, "no-cache");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");  // the page's address may hold the token
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                  "img-src 'self' data:; base-uri 'none'; form-action 'none'; "
                  "frame-ancestors 'none'");
    response_.content_length(file.content.size());
    if (request.method() != http::verb::head) {
      response_.body() = {file.content.data(), file.content.size()};
    }
    serializer_.emplace(response_);
    serializer_->split(request.method() == http::verb::head);
    stream_.expires_after(kPatience);
    const auto then = [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      if (self->response_.keep_alive()) {
        self->Read();
      } else {
        self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
      }
    };
    if (request.method() == http::verb::head) {
      http::async_write_header(stream_, *serializer_, then);
    } else {
      http::async_write(stream_, *serializer_, then);
    }
  }

  beast::tcp_stream stream_;
  std::shared_ptr<Serving> serving_;
  beast::flat_static_buffer<kMaxHeaderBytes + kMaxBodyBytes> buffer_;
  std::optional<HttpParser> parser_;
  Response response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

}  // namespace

void ServeHttp(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Serving>& serving) {
  if (serving->num_connections >= kMaxConnections) {
    ++serving->counts.num_turned_away;
    return;
  }
  std::make_shared<HttpConnection>(std::move(socket), serving)->Read();
}

}  // namespace lio
