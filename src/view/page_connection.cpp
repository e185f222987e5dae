// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "lio/io/host_clock.hpp"
#include "lio/io/json_text.hpp"
#include "view/client_frame.hpp"
#include "view/client_message.hpp"
#include "view/frame_writer.hpp"
#include "view/serving.hpp"

namespace lio {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::chrono::milliseconds kFrameInterval(33);  // 30 frames a second
constexpr std::uint32_t kMaxUnanswered = 2;  // frames on their way: more would only make it late
constexpr std::chrono::seconds kHandshakePatience(10);
constexpr std::chrono::seconds kIdlePatience(20);  // then a ping, and as long for its answer
constexpr int kSendBufferBytes = 256 * 1024;       // data in the kernel are late data

class PageConnection : public std::enable_shared_from_this<PageConnection> {
 public:
  PageConnection(beast::tcp_stream stream, std::shared_ptr<Serving> serving)
      : socket_(std::move(stream)), timer_(socket_.get_executor()), serving_(std::move(serving)) {
    ++serving_->num_pages;
    ++serving_->num_connections;
    ++serving_->counts.num_clients;
  }
  ~PageConnection() {
    --serving_->num_pages;
    --serving_->num_connections;
  }
  PageConnection(const PageConnection&) = delete;
  PageConnection& operator=(const PageConnection&) = delete;

  void Accept(const HttpRequest& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has limits of its own
    boost::system::error_code ignored;
    auto& tcp = beast::get_lowest_layer(socket_).socket();
    tcp.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    tcp.set_option(boost::asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    websocket::stream_base::timeout limits{};
    limits.handshake_timeout = kHandshakePatience;
    limits.idle_timeout = kIdlePatience;
    limits.keep_alive_pings = true;
    socket_.set_option(limits);
    socket_.read_message_max(kMaxClientBytes);
    socket_.binary(true);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->Greet();
      self->Read();
      self->Wait();
    });
  }

 private:
  void Greet() {
    const nlohmann::ordered_json hello = {{"is_live", serving_->player == nullptr},
                                          {"source", serving_->options.source},
                                          {"version", serving_->options.version}};
    FrameWriter writer;
    writer.Text(Section::kHello, TextOf(hello));
    Write(writer.Take());
  }

  void Read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) {
        self->timer_.cancel();
        return;
      }
      if (self->Handle()) {
        self->buffer_.consume(self->buffer_.size());
        self->Read();
      } else {
        self->Close();
      }
    });
  }

  // Returns false for a message that the page does not send.
  bool Handle() {
    const auto data = buffer_.cdata();
    const auto message = ParseClientMessage({static_cast<const char*>(data.data()), data.size()});
    if (!message) return false;
    if (message->ack) num_acked_ = std::min(*message->ack, num_sent_);
    LogPlayer* player = serving_->player;
    if (player == nullptr) return true;
    if (message->seek_s) player->Seek(*message->seek_s);
    if (message->speed) player->SetSpeed(*message->speed);
    if (message->play) *message->play ? player->Play() : player->Pause();
    return true;
  }

  void Wait() {
    timer_.expires_after(kFrameInterval);
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      if (error || self->is_closing_) return;
      self->Send();
      self->Wait();
    });
  }

  // A client that has not answered gets nothing; what is new meanwhile is in a later frame.
  void Send() {
    if (is_writing_ || num_sent_ - num_acked_ >= kMaxUnanswered) return;
    std::optional<Bytes> frame;
    const ClientCursor before = cursor_;
    serving_->hub.Read(
        [&](const ViewState& view) { frame = NextFrame(view, HostUtime(), cursor_); });
    ServerCounts& counts = serving_->counts;
    counts.num_poses_left_out += cursor_.num_poses_left_out - before.num_poses_left_out;
    counts.num_scans_left_out += cursor_.num_scans_left_out - before.num_scans_left_out;
    if (frame) Write(std::move(*frame));
  }

  void Write(Bytes frame) {
    frame_ = std::move(frame);
    is_writing_ = true;
    ++num_sent_;
    ++serving_->counts.num_frames;
    serving_->counts.num_bytes += static_cast<std::int64_t>(frame_.size());
    socket_.async_write(boost::asio::buffer(frame_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) self->timer_.cancel();
                        });
  }

  void Close() {
    is_closing_ = true;
    timer_.cancel();
    socket_.async_close(websocket::close_code::policy_error,
                        [self = shared_from_this()](beast::error_code) {});
  }

  websocket::stream<beast::tcp_stream> socket_;
  boost::asio::steady_timer timer_;
  std::shared_ptr<Serving> serving_;
  beast::flat_buffer buffer_;
  Bytes frame_;  // on its way
  ClientCursor cursor_;
  std::uint32_t num_sent_ = 0;
  std::uint32_t num_acked_ = 0;
  bool is_writing_ = false;
  bool is_closing_ = false;
};

}  // namespace

void ServePage(beast::tcp_stream stream, const HttpRequest& request,
               const std::shared_ptr<Serving>& serving) {
  std::make_shared<PageConnection>(std::move(stream), serving)->Accept(request);
}

}  // namespace lio
