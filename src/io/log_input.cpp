// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/log_input.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace lio {
namespace {

constexpr std::size_t kMaxAhead = 64;  // messages; 85 MB when each is a whole sweep

// It is floating point, because a damaged log may hold any number.
double SecondsBetweenUtimes(std::int64_t from, std::int64_t to) {
  return (static_cast<double>(to) - static_cast<double>(from)) * 1e-6;
}

}  // namespace

class LogInput::Impl {
 public:
  Impl(const std::filesystem::path& path, const LogInputOptions& options)
      : options_(options), reader_(path) {
    if (options.reads_ahead) thread_ = std::jthread([this] { ReadAhead(); });
  }
  ~Impl() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    room_.notify_all();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::optional<InputItem> Next() {
    if (!options_.reads_ahead) return Read();
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return !ahead_.empty(); });
    if (!ahead_.front()) {  // the end stays there for further calls
      if (fault_) std::rethrow_exception(fault_);
      return std::nullopt;
    }
    std::optional<InputItem> item = std::move(ahead_.front());
    ahead_.pop_front();
    room_.notify_one();
    return item;
  }

  const EventLogReader& reader() const { return reader_; }
  const InputCounters& counters() const { return decoder_.counters(); }
  double duration_s() const {
    return begin_utime_ ? SecondsBetweenUtimes(*begin_utime_, last_utime_) : 0.0;
  }

 private:
  std::int64_t Now() const { return options_.clock == nullptr ? 0 : options_.clock(); }
  std::optional<InputItem> Read();
  bool Decode(InputItem& item);
  // Returns false after the end and when the input is to be destroyed.
  bool PutAhead(std::optional<InputItem> item);
  void ReadAhead();

  LogInputOptions options_;
  EventLogReader reader_;
  InputDecoder decoder_;
  LogEvent event_;
  std::optional<std::int64_t> log_utime_;    // when the log's first event was received
  std::optional<std::int64_t> begin_utime_;  // the same of the first item handed out
  std::int64_t last_utime_ = 0;              // the same of the last item handed out

  std::mutex mutex_;  // guards everything below
  std::condition_variable filled_;
  std::condition_variable room_;
  std::deque<std::optional<InputItem>> ahead_;
  bool is_stopped_ = false;
  std::exception_ptr fault_;  // ended the reading ahead; Next throws it on its caller's thread
  std::jthread thread_;       // last: it ends before the rest does
};

bool LogInput::Impl::Decode(InputItem& item) {
  if (event_.channel == options_.channels.imu) {
    return decoder_.Imu(event_.data, item.data.emplace<ImuSample>());
  }
  return event_.channel == options_.channels.scan &&
         decoder_.Chunk(event_.data, item.data.emplace<ScanChunk>());
}

std::optional<InputItem> LogInput::Impl::Read() {
  InputItem item;
  while (reader_.Next(event_)) {
    if (!log_utime_) log_utime_ = event_.utime;
    const double since_s = SecondsBetweenUtimes(*log_utime_, event_.utime);
    // A start of 0 takes events received before the first one, too: a clock was set.
    if (options_.start_s > 0 && since_s < options_.start_s) continue;
    if (since_s >= options_.start_s + options_.duration_s) continue;
    const std::int64_t begin_ns = Now();
    if (!Decode(item)) continue;
    item.decode_ns = Now() - begin_ns;
    item.utime = event_.utime;
    item.position_bytes = reader_.position_bytes();
    if (!begin_utime_) begin_utime_ = event_.utime;
    last_utime_ = event_.utime;
    return item;
  }
  return std::nullopt;
}

bool LogInput::Impl::PutAhead(std::optional<InputItem> item) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return ahead_.size() < kMaxAhead || is_stopped_; });
  if (is_stopped_) return false;
  ahead_.push_back(std::move(item));
  filled_.notify_one();
  return ahead_.back().has_value();
}

void LogInput::Impl::ReadAhead() {
  try {
    while (PutAhead(Read())) continue;
  } catch (...) {
    const std::lock_guard lock(mutex_);
    fault_ = std::current_exception();
    ahead_.emplace_back(std::nullopt);
    filled_.notify_one();
  }
}

LogInput::LogInput(const std::filesystem::path& path, const LogInputOptions& options)
    : impl_(std::make_unique<Impl>(path, options)) {}
LogInput::~LogInput() = default;

std::optional<InputItem> LogInput::Next() {
  return impl_->Next();
}
std::int64_t LogInput::size_bytes() const {
  return impl_->reader().size_bytes();
}
const InputCounters& LogInput::counters() const {
  return impl_->counters();
}
std::int64_t LogInput::num_skipped_bytes() const {
  return impl_->reader().skipped_bytes();
}
double LogInput::duration_s() const {
  return impl_->duration_s();
}

}  // namespace lio
