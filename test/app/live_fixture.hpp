// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The tests of the running daemon share this: its threads over a bus in memory, fed from a log that
// lio-sim made for the tests.
#pragma once

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/live_runner.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/options_yaml.hpp"
#include "support/build_paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {

inline const std::filesystem::path kScene = test::SceneDir();

inline Options SceneOptions() {
  LoadResult loaded = LoadOptions({kScene / "config.yaml"}, {"pipeline.max_queued_scans=50"});
  EXPECT_TRUE(loaded.faults.empty());
  return loaded.options;
}

// Gives out nothing while it is held, so that messages pile up however slowly they are published.
class HoldableBus final : public Bus {
 public:
  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    bus_->Subscribe(channel, queue_capacity, std::move(handler));
  }
  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    if (!is_held_) return bus_->Receive(timeout);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ReceiveResult::kTimeout;
  }
  bool Publish(const std::string& channel, ByteView data) override {
    return bus_->Publish(channel, data);
  }
  std::int64_t num_oversized() const override { return bus_->num_oversized(); }
  std::int64_t num_handler_faults() const override { return bus_->num_handler_faults(); }
  void Hold(bool hold) { is_held_ = hold; }

 private:
  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
  std::atomic<bool> is_held_ = false;
};

class LiveRunnerTest : public ::testing::Test {
 protected:
  LiveRunnerTest() {
    // Made before there are threads, as liod does: TSan does not see into libspdlog.
    (void)spdlog::default_logger();
    HearEnd();
  }

  // For a second runner: subscriptions of the first one would outlive it.
  void RenewBus() {
    bus_ = std::make_unique<HoldableBus>();
    HearEnd();
  }
  void HearEnd() {
    bus_->Subscribe(kEndMark, 10, [this](ByteView, std::int64_t) { has_delivered_all_ = true; });
  }

  // However busy the machine is: only what never happens fails, after a minute.
  template <typename Condition>
  static void WaitUntil(Condition&& condition, const char* what) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "waited in vain until " << what;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }

  // Publishes the log up to `max_events`, as fast as that goes without overrunning anything: the
  // inertial samples run ahead of the matches by up to two scans. `may_go_on`, told how many scans
  // have begun, may hold it up. Returns when the runner has been given everything.
  void Play(
      const LiveRunner& runner, std::int64_t max_events = INT64_MAX,
      const std::function<bool(std::int32_t)>& may_go_on = [](std::int32_t) { return true; }) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    std::int32_t num_scans = 0;
    for (std::int64_t i = 0; i < max_events && reader.Next(event); ++i) {
      ScanChunk chunk;
      if (event.channel == "LIO_SCAN" && DecodeChunk(event.data, chunk) == DecodeStatus::kOk) {
        num_scans = chunk.scan_seq;
      }
      WaitUntil([&] { return runner.num_matches_done() + kMaxAhead >= num_scans; },
                "scans are matched");
      WaitUntil([&] { return may_go_on(num_scans); }, "what came out allows the next scan");
      if (HasFatalFailure()) return;
      EXPECT_TRUE(bus_->Publish(event.channel, event.data));
    }
    EXPECT_TRUE(bus_->Publish(kEndMark, Bytes{0}));
    WaitUntil([this] { return has_delivered_all_.load(); }, "all messages are delivered");
  }

  // Publishes the log from its event number `first` on, at once.
  void PublishRest(int first) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    for (int i = 0; reader.Next(event); ++i) {
      if (i < first) continue;
      EXPECT_TRUE(bus_->Publish(event.channel, event.data));
    }
    has_delivered_all_ = false;
    EXPECT_TRUE(bus_->Publish(kEndMark, Bytes{0}));
  }

  LiveOptions WithFiles(bool writes_map = false) const {
    LiveOptions live;
    live.out = out_;
    live.writes_map = writes_map;
    live.max_finish = std::chrono::minutes(1);  // however busy the machine is
    return live;
  }
  nlohmann::json Stats() { return nlohmann::json::parse(test::ReadText(out_ / "stats.json")); }
  // Every message that was received has a fate in stats.json.
  void ExpectAccountCloses() {
    const nlohmann::json stats = Stats();
    for (const auto& [kind, fates] : stats["account"].items()) {
      EXPECT_EQ(fates["unaccounted"], 0) << kind << ": " << fates;
      EXPECT_GT(fates["received"], 0) << kind;
    }
  }
  std::string Live(const std::string& name) { return test::ReadText(out_ / name); }
  std::ptrdiff_t NumLines(const std::string& name) {
    const std::string text = Live(name);
    EXPECT_TRUE(text.empty() || text.back() == '\n');
    return std::count(text.begin(), text.end(), '\n');
  }

  // Two scans are closed, one grows, one is not covered yet.
  static constexpr std::int64_t kMaxAhead = 4;
  static constexpr const char* kEndMark = "TEST_END";

  std::atomic<bool> has_delivered_all_ = false;
  test::TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "live";
  std::unique_ptr<HoldableBus> bus_ = std::make_unique<HoldableBus>();
};

}  // namespace lio
