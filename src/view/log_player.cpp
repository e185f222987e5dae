// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/log_player.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "lio/io/event_log.hpp"
#include "lio/io/input_error.hpp"
#include "view/message_feed.hpp"
#include "view/view_state.hpp"

namespace lio {
namespace {

constexpr int kMaxMessagesAtOnce = 2000;
constexpr std::int64_t kMaxUtime = std::int64_t{1} << 52;  // in the year 2112

double Seconds(std::int64_t t_us) {
  return 1e-6 * static_cast<double>(t_us);
}

// Adds up the steps between stamps that may be anything.
class TrustedTime {
 public:
  std::int64_t Next(std::int64_t utime) {
    const std::int64_t sane = std::clamp<std::int64_t>(utime, 0, kMaxUtime);
    if (last_ < 0) first_ = last_ = sane;
    constexpr auto kMaxStep_us = static_cast<std::int64_t>(LogPlayer::kMaxSilence_s * 1e6);
    t_us_ += std::clamp<std::int64_t>(sane - last_, 0, kMaxStep_us);
    last_ = sane;
    return t_us_;
  }
  [[nodiscard]] std::int64_t first_utime() const { return first_; }

 private:
  std::int64_t first_ = 0;
  std::int64_t last_ = -1;
  std::int64_t t_us_ = 0;
};

}  // namespace

struct LogPlayer::Impl {
  struct Entry {
    std::int64_t t_us = 0;  // after the first
    std::int64_t position_bytes = 0;
  };

  Impl(const std::filesystem::path& log, const std::string& prefix, ViewHub& to)
      : reader(log), feed(Channels(prefix), to), hub(to) {}

  void Index(const std::function<void(std::int64_t, std::int64_t)>& progress);
  bool ShowDue();
  void Tell(bool is_seeking);

  EventLogReader reader;
  MessageFeed feed;
  ViewHub& hub;
  std::vector<Entry> entries;
  std::int64_t first_utime = 0;
  double duration_s = 0.0;
  LogEvent event;
  std::size_t next = 0;  // entry

  std::mutex mutex;  // guards what follows
  double t_s = 0.0;
  double speed = 1.0;
  bool is_playing = true;
  bool must_restart = false;
};

void LogPlayer::Impl::Index(const std::function<void(std::int64_t, std::int64_t)>& progress) {
  TrustedTime time;
  while (true) {
    const std::int64_t position = reader.position_bytes();
    if (!reader.Next(event)) break;
    if (progress) progress(position, reader.size_bytes());
    const std::int64_t t_us = time.Next(event.utime);
    if (feed.Takes(event.channel)) entries.push_back({t_us, position});
  }
  first_utime = time.first_utime();
  if (!entries.empty()) duration_s = Seconds(entries.back().t_us);
}

// Shows the messages up to t_s, or as many as may be at once; true when none is left.
bool LogPlayer::Impl::ShowDue() {
  double until_s = 0.0;
  bool begins_anew = false;
  {
    const std::lock_guard lock(mutex);
    until_s = t_s;
    begins_anew = std::exchange(must_restart, false);
  }
  if (begins_anew) {
    next = 0;
    hub.Change([](ViewState& view) { view.Clear(); });
  }
  for (int i = 0; i < kMaxMessagesAtOnce; ++i, ++next) {
    if (next >= entries.size() || Seconds(entries[next].t_us) > until_s) return true;
    reader.SeekTo(entries[next].position_bytes);
    if (!reader.Next(event)) continue;  // the file has become shorter meanwhile
    feed.Take(event.channel, event.data, first_utime + entries[next].t_us);
  }
  return false;
}

void LogPlayer::Impl::Tell(bool is_seeking) {
  Timeline timeline;
  {
    const std::lock_guard lock(mutex);
    timeline = {t_s,        duration_s, speed,
                is_playing, is_seeking, first_utime + static_cast<std::int64_t>(t_s * 1e6)};
  }
  hub.Change([&](ViewState& view) {
    const Timeline& told = view.timeline().value;
    const bool is_news = view.timeline().number == 0 || told.t_s != timeline.t_s ||
                         told.speed != timeline.speed || told.is_playing != timeline.is_playing ||
                         told.is_seeking != timeline.is_seeking;
    if (is_news) view.SetTimeline(timeline);
  });
}

LogPlayer::LogPlayer(const std::filesystem::path& log, const std::string& channel_prefix,
                     ViewHub& hub, const std::function<void(std::int64_t, std::int64_t)>& progress)
    : impl_(std::make_unique<Impl>(log, channel_prefix, hub)) {
  impl_->Index(progress);
  if (impl_->entries.empty()) {
    throw InputError(log.string() + ": has no message that liod sends (" + channel_prefix +
                     "ODOM, " + channel_prefix +
                     "CLOUD and so on); play it to liod with lcm-logplayer while lio-view runs, or "
                     "show a recording of liod's own messages");
  }
  impl_->Tell(false);
}

LogPlayer::~LogPlayer() = default;

void LogPlayer::Play() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->t_s >= impl_->duration_s) {
    impl_->t_s = 0.0;
    impl_->must_restart = true;
  }
  impl_->is_playing = true;
}

void LogPlayer::Pause() {
  const std::lock_guard lock(impl_->mutex);
  impl_->is_playing = false;
}

void LogPlayer::Seek(double t_s) {
  const std::lock_guard lock(impl_->mutex);
  const double wanted_s = std::isfinite(t_s) ? std::clamp(t_s, 0.0, impl_->duration_s) : 0.0;
  impl_->must_restart = impl_->must_restart || wanted_s < impl_->t_s;
  impl_->t_s = wanted_s;
}

void LogPlayer::SetSpeed(double speed) {
  const std::lock_guard lock(impl_->mutex);
  impl_->speed = std::isnan(speed) ? 1.0 : std::clamp(speed, kMinSpeed, kMaxSpeed);
}

void LogPlayer::Advance(double elapsed_s) {
  const bool is_there = impl_->ShowDue();
  if (is_there) {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->is_playing) impl_->t_s += elapsed_s * impl_->speed;
    if (impl_->t_s >= impl_->duration_s) {
      impl_->t_s = impl_->duration_s;
      impl_->is_playing = false;
    }
  }
  // Messages due by now are shown at once when they are few, so that a pause shows its place.
  impl_->Tell(!(is_there && impl_->ShowDue()));
}

double LogPlayer::duration_s() const {
  return impl_->duration_s;
}

std::size_t LogPlayer::num_messages() const {
  return impl_->entries.size();
}

}  // namespace lio
