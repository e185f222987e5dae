// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/serve.hpp"

#include "lio/io/worker_thread.hpp"

namespace lio {
namespace {

// Asks to stop when it goes out of scope, whatever ends that.
class StopAtEnd {
 public:
  explicit StopAtEnd(std::stop_source& source) : source_(source) {}
  ~StopAtEnd() { source_.request_stop(); }
  StopAtEnd(const StopAtEnd&) = delete;
  StopAtEnd& operator=(const StopAtEnd&) = delete;

 private:
  std::stop_source& source_;
};

}  // namespace

std::optional<std::string> ServeWhile(const std::function<void(const std::stop_token&)>& feed,
                                      ViewServer& server) {
  FaultLatch faults;
  std::stop_source stop;
  {
    WorkerThread thread("feed", [&](const std::string& fault) {
      faults.Set(fault);
      server.Stop();
    });
    const StopAtEnd stop_at_end(stop);  // before the thread is joined
    thread.Start([&] { feed(stop.get_token()); });
    server.Run();
  }
  return faults.first();
}

}  // namespace lio
