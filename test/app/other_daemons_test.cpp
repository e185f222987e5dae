// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/other_daemons.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "app/captured_log.hpp"
#include "app/live_fixture.hpp"
#include "lio/io/status_report.hpp"
#include "lio/status_t.hpp"

namespace lio {
namespace {

constexpr std::int64_t kOwn = 1'700'000'000'000'000;
constexpr std::int64_t kOther = kOwn + 3'000'000;

Bytes StatusOf(std::int64_t start_utime) {
  StatusReport report;
  report.start_utime = start_utime;
  return EncodeStatus(report, "1.2.3");
}

TEST(OtherDaemons, OneIsHeardFromItsSecondMessageOn) {
  OtherDaemons others(kOwn);
  others.Hear(StatusOf(kOther));
  EXPECT_EQ(others.heard().num, 0) << "one message may be false";
  others.Hear(StatusOf(kOther));
  others.Hear(StatusOf(kOther));
  EXPECT_EQ(others.heard().num, 2);
  EXPECT_EQ(others.heard().start_utime, kOther);
}

TEST(OtherDaemons, TheOwnStatusIsNoOther) {
  OtherDaemons others(kOwn);
  for (int i = 0; i < 10; ++i) others.Hear(StatusOf(kOwn));
  EXPECT_EQ(others.heard().num, 0);
}

TEST(OtherDaemons, SeveralThatTakeTurnsAreHeard) {
  OtherDaemons others(kOwn);
  for (int i = 0; i < 10; ++i) {
    for (std::int64_t k = 1; k <= 3; ++k) others.Hear(StatusOf(kOwn + k));
  }
  EXPECT_EQ(others.heard().num, 27);
}

TEST(OtherDaemons, StartsThatNeverComeAgainAreNoDaemons) {
  OtherDaemons others(kOwn);
  for (std::int64_t k = 1; k <= 1000; ++k) others.Hear(StatusOf(kOwn + k));
  EXPECT_EQ(others.heard().num, 0);
}

TEST(OtherDaemons, WhatIsNoStatusIsPassedOver) {
  OtherDaemons others(kOwn);
  const Bytes sound = StatusOf(kOther);
  for (std::size_t size = 0; size < sound.size() / 2; ++size) {
    for (int i = 0; i < 2; ++i) others.Hear({sound.data(), size});
  }
  for (int i = 0; i < 2; ++i) {
    others.Hear(Bytes(sound.size(), 0xff));
    others.Hear(EncodeImu({}, 1));
    others.Hear({});
  }
  EXPECT_EQ(others.heard().num, 0);
}

// One end of a wire between two daemons: what either publishes reaches both, as over LCM.
class WireEnd final : public Bus {
 public:
  using Inboxes = std::array<std::unique_ptr<Bus>, 2>;
  WireEnd(Inboxes& inboxes, std::size_t own) : inboxes_(inboxes), own_(*inboxes.at(own)) {}

  void Subscribe(const std::string& channel, int queue_capacity, Handler handler) override {
    own_.Subscribe(channel, queue_capacity, std::move(handler));
  }
  ReceiveResult Receive(std::chrono::milliseconds timeout) override {
    return own_.Receive(timeout);
  }
  bool Publish(const std::string& channel, ByteView data) override {
    return inboxes_[0]->Publish(channel, data) && inboxes_[1]->Publish(channel, data);
  }
  std::int64_t num_oversized() const override { return own_.num_oversized(); }
  std::int64_t num_handler_faults() const override { return own_.num_handler_faults(); }

 private:
  Inboxes& inboxes_;
  Bus& own_;
};

class TwoDaemons : public LiveRunnerTest {
 protected:
  // The first daemon is heard through its own end.
  TwoDaemons() {
    ends_[0].Subscribe("LIO_STATUS", 100, [this](ByteView data, std::int64_t) {
      status_t status;
      ASSERT_GT(status.decode(data.data(), 0, static_cast<int>(data.size())), 0);
      const std::lock_guard lock(mutex_);
      notes_[status.start_utime] = status.note;
    });
  }
  static bool SaysSo(const std::string& note) {
    return note.find("another liod publishes on LIO_STATUS") != note.npos;
  }
  bool DoBothSaySo() {
    const std::lock_guard lock(mutex_);
    return notes_.size() == 2 && SaysSo(notes_.begin()->second) && SaysSo(notes_.rbegin()->second);
  }
  bool DoesFirstSaySo() {
    const std::lock_guard lock(mutex_);
    return SaysSo(notes_.begin()->second);
  }

  WireEnd::Inboxes inboxes_ = {OpenMemoryBus(), OpenMemoryBus()};
  std::array<WireEnd, 2> ends_ = {WireEnd(inboxes_, 0), WireEnd(inboxes_, 1)};
  std::mutex mutex_;                           // guards notes_
  std::map<std::int64_t, std::string> notes_;  // the last ones, by the start of the daemon
};

TEST_F(TwoDaemons, EachNoticesTheOtherAndTakesItBackWhenThatIsGone) {
  const test::CapturedLog log;
  LiveRunner first(ends_[0], SceneOptions(), LiveOptions());
  {
    LiveRunner second(ends_[1], SceneOptions(), LiveOptions());
    WaitUntil([this] { return DoBothSaySo(); }, "both have said so");
    second.Stop();
  }
  EXPECT_TRUE(DoesFirstSaySo());
  WaitUntil([this] { return !DoesFirstSaySo(); }, "it is taken back");
  first.Stop();
  EXPECT_NE(log.text().find("info no longer so: another liod publishes"), std::string::npos);
}

}  // namespace
}  // namespace lio
