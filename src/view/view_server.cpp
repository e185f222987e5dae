// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/view_server.hpp"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>

#include "lio/io/input_error.hpp"
#include "view/access.hpp"
#include "view/serving.hpp"

namespace lio {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr std::chrono::milliseconds kAcceptRetryInterval(100);  // when no file descriptor is left

}  // namespace

bool IsLoopbackAddress(const std::string& address) {
  boost::system::error_code error;
  const auto parsed = asio::ip::make_address(address, error);
  return !error && parsed.is_loopback();
}

std::string MakeToken() {
  return RandomToken();
}

std::string WhyNotServed(const ServerOptions& options) {
  boost::system::error_code error;
  (void)asio::ip::make_address(options.address, error);
  if (error) return options.address + " is no address of this machine's, such as 0.0.0.0 or ::";
  if (!options.token.empty()) return WhyNoToken(options.token);
  if (IsLoopbackAddress(options.address)) return {};
  return "listening on " + options.address + " needs a token";
}

struct ViewServer::Impl {
  Impl(const ServerOptions& options, const ViewHub& hub, LogPlayer* player)
      : serving(std::make_shared<Serving>(Serving{options, hub, player, {}, 0, 0})) {}

  void Listen();
  void Accept();

  asio::io_context io{1};  // one thread
  tcp::acceptor acceptor{io};
  asio::signal_set signals{io};
  asio::steady_timer retry{io};
  std::shared_ptr<Serving> serving;
};

void ViewServer::Impl::Listen() {
  const ServerOptions& options = serving->options;
  if (const std::string why = WhyNotServed(options); !why.empty()) throw UsageError(why);
  const tcp::endpoint endpoint(asio::ip::make_address(options.address), options.port);
  try {
    acceptor.open(endpoint.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    throw UsageError(fmt::format("cannot listen on {} port {}: {}", options.address, options.port,
                                 error.code().message()));
  }
}

void ViewServer::Impl::Accept() {
  acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      ServeHttp(std::move(socket), serving);
      Accept();
      return;
    }
    retry.expires_after(kAcceptRetryInterval);
    retry.async_wait([this](boost::system::error_code stopped) {
      if (!stopped) Accept();
    });
  });
}

ViewServer::ViewServer(const ServerOptions& options, const ViewHub& hub, LogPlayer* player)
    : impl_(std::make_unique<Impl>(options, hub, player)) {
  impl_->Listen();
}

ViewServer::~ViewServer() = default;

std::uint16_t ViewServer::port() const {
  return impl_->acceptor.local_endpoint().port();
}

std::string ViewServer::Url() const {
  const ServerOptions& options = impl_->serving->options;
  const auto address = asio::ip::make_address(options.address);
  std::string host = address.is_v6() ? "[" + options.address + "]" : options.address;
  if (address.is_loopback()) host = address.is_v6() ? "[::1]" : "localhost";
  if (address.is_unspecified()) host = asio::ip::host_name();
  const std::string token = options.token.empty() ? "" : "?token=" + options.token;
  return fmt::format("http://{}:{}/{}", host, port(), token);
}

void ViewServer::Run() {
  for (const int signal : {SIGINT, SIGTERM}) impl_->signals.add(signal);
  impl_->signals.async_wait([this](boost::system::error_code error, int) {
    if (!error) impl_->io.stop();
  });
  impl_->Accept();
  impl_->io.run();
}

void ViewServer::Stop() {
  impl_->io.stop();
}

ServerCounts ViewServer::counts() const {
  return impl_->serving->counts;
}

}  // namespace lio
