// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-view: a page that shows live, or from a recording, what liod sends.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

#include "lio/io/bus.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/program.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/view/live_feed.hpp"
#include "lio/view/log_player.hpp"
#include "lio/view/serve.hpp"
#include "lio/view/view_server.hpp"

namespace lio {
namespace {

constexpr const char* kProgram = "lio-view";

constexpr const char* kAbout =
    "Serves a page that shows what liod sends: scan, growing map, path, pose with its ellipsoid "
    "of\n"
    "three sigma, status, verdict, rates, latencies, and plots of velocity, biases and NIS. It "
    "hears\n"
    "them on LCM, or plays a recording of them with a timeline.\n\n"
    "Examples:\n"
    "  lio-view\n"
    "  lio-view --lcm-url 'udpm://239.255.76.67:7667?ttl=1' --port 8081\n"
    "  lio-view --log recorded.lcm\n"
    "  lio-view --bind 0.0.0.0 --token \"$(openssl rand -hex 16)\"\n\n"
    "It listens on this machine alone unless --bind says otherwise. Then whoever asks must name a\n"
    "token: that of --token or of the environment's LIO_VIEW_TOKEN, else one that is made and "
    "told.\n"
    "Nothing is encrypted; over an open network take ssh -L 8080:localhost:8080 instead.\n\n"
    "Exit codes: 0 ended by SIGINT or SIGTERM, 2 usage, 4 no transport, 5 damaged, missing or\n"
    "unusable log, 70 an internal fault of what brings the data.";

struct Arguments {
  std::string lcm_url;
  std::string log;
  std::string address = "127.0.0.1";
  std::string token;
  std::string channel_prefix = kDefaultChannelPrefix;
  std::uint16_t port = 8080;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  auto* url = app.add_option("--lcm-url", arguments.lcm_url,
                             "LCM URL (default: LCM_DEFAULT_URL, else multicast)")
                  ->type_name("URL");
  app.add_option("--log", arguments.log, "play this LCM log instead")
      ->type_name("FILE")
      ->excludes(url);
  app.add_option("--port", arguments.port, "port of the page; 0: any that is free")
      ->type_name("PORT")
      ->capture_default_str();
  app.add_option("--bind", arguments.address, "address to listen on, 0.0.0.0 or :: for all")
      ->type_name("ADDRESS")
      ->capture_default_str();
  app.add_option("--token", arguments.token,
                 "whoever asks must name it: 16 to 128 letters and digits")
      ->type_name("TEXT")
      ->envname("LIO_VIEW_TOKEN");
  app.add_option("--channel-prefix", arguments.channel_prefix, "prefix of liod's channels")
      ->type_name("TEXT")
      ->capture_default_str()
      ->check(NameUpTo(40));
}

ServerOptions OptionsOf(const Arguments& arguments) {
  ServerOptions options;
  options.address = arguments.address;
  options.port = arguments.port;
  options.token = arguments.token;
  options.version = LIO_VERSION;
  options.source = arguments.log.empty() ? EffectiveUrl(arguments.lcm_url) : arguments.log;
  if (options.token.empty() && !IsLoopbackAddress(options.address)) options.token = MakeToken();
  if (const std::string why = WhyNotServed(options); !why.empty()) throw UsageError(why);
  return options;
}

std::unique_ptr<LogPlayer> OpenLog(const Arguments& arguments, ViewHub& hub) {
  RefuseIrregular(arguments.log);
  if (const std::string why = WhyNoLog(arguments.log); !why.empty()) throw InputError(why);
  std::unique_ptr<ProgressBar> bar;
  return std::make_unique<LogPlayer>(arguments.log, arguments.channel_prefix, hub,
                                     [&](std::int64_t at, std::int64_t size) {
                                       if (bar == nullptr)
                                         bar = std::make_unique<ProgressBar>(kProgram, size);
                                       bar->Update(at);
                                     });
}

void PlayUntilStopped(LogPlayer& player, const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kStep(10);
  auto last = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(kStep);
    const auto now = std::chrono::steady_clock::now();
    player.Advance(std::chrono::duration<double>(now - last).count());
    last = now;
  }
}

ExitCode Serve(const std::function<void(const std::stop_token&)>& feed, ViewServer& server) {
  fmt::print(stderr, "{}: open {}\n", kProgram, server.Url());
  const std::optional<std::string> fault = ServeWhile(feed, server);
  const ServerCounts& counts = server.counts();
  fmt::print(stderr,
             "{}: {} pages had {} frames, {:.1f} MB; {} poses and {} scans were left out for slow "
             "ones; {} requests were turned away\n",
             kProgram, counts.num_clients, counts.num_frames,
             1e-6 * static_cast<double>(counts.num_bytes), counts.num_poses_left_out,
             counts.num_scans_left_out, counts.num_turned_away);
  if (!fault) return kExitDone;
  fmt::print(stderr, "{}: {}; the page ends here, please report this fault\n", kProgram, *fault);
  return kExitInternalFault;
}

int Main(int argc, char** argv) {
  CLI::App app(kAbout, kProgram);
  Arguments arguments;
  AddArguments(app, arguments);
  if (const auto code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *code;
  const ServerOptions options = OptionsOf(arguments);
  ViewHub hub;
  if (!arguments.log.empty()) {
    const std::unique_ptr<LogPlayer> player = OpenLog(arguments, hub);
    ViewServer server(options, hub, player.get());
    return Serve([&](const std::stop_token& stop) { PlayUntilStopped(*player, stop); }, server);
  }
  try {
    LiveFeed feed(arguments.lcm_url, arguments.channel_prefix, hub);
    ViewServer server(options, hub, nullptr);
    return Serve([&](const std::stop_token& stop) { feed.Run(stop); }, server);
  } catch (const TransportError& error) {
    fmt::print(stderr, "{}: {}\n", kProgram, error.what());
    return kExitNoTransport;
  }
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  return lio::RunProgram(lio::kProgram, [&] { return lio::Main(argc, argv); });
}
