// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/end_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cstdlib>
#include <stdexcept>

#include "app/captured_log.hpp"
#include "app/live_fixture.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;

// Throws on receiving or on publishing on a channel, once it is told to fail.
class FailingBus final : public Bus {
 public:
  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    bus_->Subscribe(channel, queue_capacity, std::move(handler));
  }
  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    if (fails_receiving) throw std::runtime_error("the wire burnt");
    return bus_->Receive(timeout);
  }
  bool Publish(const std::string& channel, ByteView data) override {
    if (fails && channel == failing_channel) throw std::runtime_error("no room on the bus");
    return bus_->Publish(channel, data);
  }
  std::int64_t num_oversized() const override { return bus_->num_oversized(); }
  std::int64_t num_handler_faults() const override { return bus_->num_handler_faults(); }

  std::atomic<bool> fails_receiving = false;
  std::atomic<bool> fails = false;
  std::string failing_channel;

 private:
  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
};

struct FailingClock {
  static std::int64_t Now() {
    if (fails) throw std::runtime_error("the clock stands still");
    return 0;
  }
  inline static std::atomic<bool> fails = false;
};

class EndRunTest : public ::testing::Test {
 protected:
  ~EndRunTest() override { FailingClock::fails = false; }

  LiveOptions WithFiles() const {
    LiveOptions live;
    live.out = out_;
    live.writes_map = true;
    live.match_clock = FailingClock::Now;
    return live;
  }

  // Feeds the log; calls `fail` in its middle and goes on until the runner has noticed.
  void PlayUntilFault(const LiveRunner& runner, const std::function<void()>& fail) {
    EventLogReader reader(kScene / "log.lcm");
    LogEvent event;
    std::int32_t num_scans = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (int i = 0; !runner.fault(); ++i) {
      if (i == 700) fail();
      const bool is_read = reader.Next(event);
      if (is_read) {
        EXPECT_TRUE(bus_.Publish(event.channel, event.data));
      }
      ScanChunk chunk;
      if (event.channel == "LIO_SCAN" && DecodeChunk(event.data, chunk) == DecodeStatus::kOk) {
        num_scans = chunk.scan_seq;
      }
      while (!runner.fault() && runner.num_matches_done() + 4 < num_scans) {
        ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "scans are matched";
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "no fault was noticed";
    }
  }

  std::ptrdiff_t NumLines(const std::string& name) {
    const std::string text = test::ReadText(out_ / name);
    EXPECT_TRUE(text.empty() || text.back() == '\n');
    return std::count(text.begin(), text.end(), '\n');
  }

  // The run ends in order: code, one line, complete files.
  void ExpectEndsWith(const std::string& fault, const std::function<void()>& fail) {
    const test::CapturedLog log;
    LiveRunner runner(bus_, SceneOptions(), WithFiles());
    PlayUntilFault(runner, fail);
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_TRUE(IsOver(runner));
    const std::string before = log.text();
    bus_.fails = false;  // so that the last status can be sent
    EXPECT_EQ(EndRun(runner, ""), kExitInternalFault);
    EXPECT_EQ(log.text().substr(before.size()),
              "error " + fault + "; the run ends here, please report this fault\n");
    EXPECT_GT(NumLines("trajectory.tum"), 5);
    EXPECT_EQ(NumLines("covariance.csv"), NumLines("trajectory.tum") + 1);
    EXPECT_GT(NumLines("trajectory_imu_rate.tum"), 50);
    EXPECT_TRUE(std::filesystem::exists(out_ / "map.pcd"));
    const auto stats = nlohmann::json::parse(test::ReadText(out_ / "stats.json"));
    EXPECT_GT(stats["num_scans"], 5);
  }

  FailingBus bus_;
  test::TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "live";
};

TEST_F(EndRunTest, AFaultOfTheReceiveThreadEndsTheRunInOrder) {
  ExpectEndsWith("the receive thread failed: the wire burnt",
                 [this] { bus_.fails_receiving = true; });
}

TEST_F(EndRunTest, AFaultOfTheFilterThreadEndsTheRunInOrder) {
  bus_.failing_channel = "LIO_ODOM";
  ExpectEndsWith("the filter thread failed: no room on the bus", [this] { bus_.fails = true; });
}

TEST_F(EndRunTest, AFaultOfTheMatchThreadEndsTheRunInOrder) {
  ExpectEndsWith("the match thread failed: the clock stands still",
                 [] { FailingClock::fails = true; });
}

TEST_F(EndRunTest, AFaultOfTheOutputThreadEndsTheRunInOrder) {
  bus_.failing_channel = "LIO_CLOUD";
  ExpectEndsWith("the output thread failed: no room on the bus", [this] { bus_.fails = true; });
}

TEST_F(EndRunTest, WithoutAFaultItEndsWithZeroAndSaysNothing) {
  const test::CapturedLog log;
  LiveRunner runner(bus_, SceneOptions(), WithFiles());
  EXPECT_FALSE(IsOver(runner));
  EXPECT_EQ(EndRun(runner, ""), kExitDone);
  EXPECT_EQ(log.text(), "");
}

TEST_F(EndRunTest, ABrokenConnectionEndsWithFourTheEndOfALogWithZero) {
  for (const auto& [url, code] : {std::pair<std::string, int>{"tcpq://127.0.0.1:7700", 4},
                                  std::pair<std::string, int>{"file:///tmp/drive.lcm", 0}}) {
    const test::CapturedLog log;
    const auto closed = OpenNullBus();
    LiveRunner runner(*closed, SceneOptions(), LiveOptions());
    while (!IsOver(runner)) std::this_thread::yield();
    EXPECT_EQ(EndRun(runner, url), code);
    EXPECT_EQ(log.text().empty(), code == 0) << log.text();
  }
}

TEST(EndRunDeathTest, TheProcessEndsWithSeventyAndOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run = [] {
    spdlog::set_default_logger(spdlog::stderr_logger_mt("liod"));
    spdlog::set_pattern("%n: %v");
    FailingBus bus;
    bus.fails_receiving = true;
    LiveRunner runner(bus, SceneOptions(), LiveOptions());
    while (!IsOver(runner)) std::this_thread::yield();
    return EndRun(runner, "");
  };
  EXPECT_EXIT(std::exit(run()), ::testing::ExitedWithCode(70),
              "^liod: the receive thread failed: the wire burnt; the run ends here, please report "
              "this fault\n$");
}

}  // namespace
}  // namespace lio
