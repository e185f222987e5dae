// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// liod estimates LiDAR-inertial odometry from LCM to LCM, until it is told to end.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>

#include "app/daemon_arguments.hpp"
#include "app/daemon_check.hpp"
#include "app/end_run.hpp"
#include "app/live_runner.hpp"
#include "app/service_notifier.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/program.hpp"
#include "lio/io/run_folder.hpp"
#include "lio/io/socket_buffer.hpp"
#include "lio/io/worker_thread.hpp"

namespace lio {
namespace {

// Blocks the signals in every thread, because threads inherit the mask: only Serve takes them.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // calls on a broken tcpq connection return errors instead
  return signals;
}

// Returns when it is to end, by a signal or because nothing comes any more. Meanwhile the filter
// thread tells the watchdog that it is alive, four times as often as it must.
void Serve(const sigset_t& signals, const ServiceNotifier& service, LiveRunner& runner) {
  const timespec interval{.tv_sec = 0, .tv_nsec = 100'000'000};
  auto next_ping = std::chrono::steady_clock::now();
  while (!IsOver(runner)) {
    const auto now = std::chrono::steady_clock::now();
    if (service.watchdog() && now >= next_ping) {
      runner.PingFilter();
      next_ping = now + *service.watchdog() / 4;
    }
    const int signal = sigtimedwait(&signals, nullptr, &interval);
    if (signal == SIGHUP) {
      runner.RenewFiles();
    } else if (signal > 0) {
      return;
    }
  }
}

void RaiseBuffer(const std::string& url, LiveOptions& live) {
  const int port = UdpPort(url);
  if (port == 0) return;
  live.socket = FindUdpSocket(port);
  if (!live.socket) return;
  live.receive_buffer_bytes = RaiseReceiveBuffer(*live.socket, kWantedReceiveBytes);
  if (live.receive_buffer_bytes >= kEnoughReceiveBytes) return;
  spdlog::warn("the kernel's receive buffer is {} kB: scans will be lost; allow more with\n{}",
               live.receive_buffer_bytes / 1024, ReceiveBufferAdvice());
}

// A restart must keep what the run before has written.
void KeepEarlierRun(LiveOptions& live) {
  const std::filesystem::path wanted = *live.out;
  live.out = MakeFreeFolder(wanted);
  std::error_code ignored;
  if (std::filesystem::equivalent(wanted, *live.out, ignored)) return;
  spdlog::warn("{} holds an earlier run: the files of this one go to {}", wanted.string(),
               live.out->string());
}

int Run(const DaemonArguments& arguments, const Options& options,
        const InitialMapPtr& initial_map) {
  const sigset_t signals = BlockSignals();
  const ServiceNotifier service;
  const std::unique_ptr<Bus> bus = OpenLcmBus(arguments.lcm_url);
  LiveOptions live = arguments.Live();
  live.version = LIO_VERSION;
  live.initial_map = initial_map;
  live.inputs = arguments.Inputs();
  if (live.out) live.next_out = *live.out;
  if (live.out && !arguments.overwrites) KeepEarlierRun(live);
  RaiseBuffer(arguments.lcm_url, live);
  live.answer_ping = [&service] { service.Tell("WATCHDOG=1"); };
  LiveRunner runner(*bus, options, live);
  service.Tell("READY=1\nSTATUS=listening on " + live.channels.imu + " and " + live.channels.scan);
  spdlog::info("listening on {} and {}", live.channels.imu, live.channels.scan);
  SetUrgency(Urgency::kSoon);  // from here on this thread waits for signals and ends the run
  Serve(signals, service, runner);
  service.Tell("STOPPING=1");
  return EndRun(runner, arguments.lcm_url);
}

int Main(int argc, char** argv) {
  DaemonArguments arguments;
  Options options;
  CLI::App app("", "liod");
  arguments.AddTo(app);
  const auto code = ParseCommandLine(app, argc, argv, LIO_VERSION, arguments.options, options);
  if (arguments.checks_only && code.value_or(kExitConfiguration) == kExitConfiguration) {
    return CheckDaemon(arguments, options, code.has_value());
  }
  if (code) return *code;
  if (const std::string why = arguments.WhyInputIsLost(); !why.empty()) throw UsageError(why);
  InitialMapPtr initial_map;
  if (const auto unusable = LoadInitialMap("liod", arguments.initial_map, options, initial_map)) {
    return *unusable;
  }
  try {
    return Run(arguments, options, initial_map);
  } catch (const TransportError& error) {
    spdlog::error("{}", error.what());
    return kExitNoTransport;
  } catch (const WriteError&) {
    throw;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return kExitUsage;
  }
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("liod"));
  spdlog::set_pattern("%n: %v");
  return lio::RunProgram("liod", [&] { return lio::Main(argc, argv); });
}
