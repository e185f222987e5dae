// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/event_log.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::uint32_t kSync = 0xEDA1DA01;
constexpr std::size_t kHeaderBytes = 4 + 8 + 8 + 4 + 4;
constexpr std::uint32_t kMaxChannelBytes = 255;    // LCM sends at most 63
constexpr std::uint32_t kMaxDataBytes = 1u << 28;  // the most that LCM itself accepts
constexpr std::size_t kBufferBytes = 1u << 20;

std::string Why() {
  return std::strerror(errno);
}

template <typename T>
T ReadBigEndian(const std::uint8_t* bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) bits = bits << 8 | bytes[i];
  return static_cast<T>(bits);
}

template <typename T>
std::uint8_t* PutBigEndian(T value, std::uint8_t* to) {
  for (std::size_t i = sizeof(T); i-- > 0;) {
    *to++ = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
  }
  return to;
}

}  // namespace

struct EventLogWriter::Impl {
  std::string name;
  std::FILE* file = nullptr;
  std::int64_t next_number = 0;

  void Put(const void* bytes, std::size_t size) const {
    if (size > 0 && std::fwrite(bytes, 1, size, file) != size) {
      throw WriteError("cannot write " + name + " in full: " + Why());
    }
  }
};

EventLogWriter::EventLogWriter(const std::filesystem::path& path, OutputFile::Links links)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = path.string();
  const int fd = OpenToWrite(path, links);
  if (fd >= 0) impl_->file = ::fdopen(fd, "wb");
  if (impl_->file != nullptr) return;
  const std::string why = Why();
  if (fd >= 0) ::close(fd);
  throw OutputError("cannot create " + impl_->name + ": " + why);
}

EventLogWriter::~EventLogWriter() {
  if (impl_->file != nullptr) std::fclose(impl_->file);
}

void EventLogWriter::Write(std::int64_t utime, std::string_view channel,
                           std::span<const std::uint8_t> data) {
  if (impl_->file == nullptr) throw std::logic_error(impl_->name + " is closed already");
  if (channel.empty() || channel.size() > kMaxChannelBytes || data.size() > kMaxDataBytes) {
    throw std::invalid_argument("an event of " + std::to_string(data.size()) +
                                " bytes on channel '" + std::string(channel) + "' fits no log");
  }
  std::uint8_t header[kHeaderBytes];
  std::uint8_t* next = PutBigEndian(kSync, header);
  next = PutBigEndian(impl_->next_number++, next);
  next = PutBigEndian(utime, next);
  next = PutBigEndian(static_cast<std::uint32_t>(channel.size()), next);
  PutBigEndian(static_cast<std::uint32_t>(data.size()), next);
  impl_->Put(header, sizeof(header));
  impl_->Put(channel.data(), channel.size());
  impl_->Put(data.data(), data.size());
}

void EventLogWriter::Close() {
  if (impl_->file == nullptr) return;
  const int result = std::fclose(impl_->file);
  impl_->file = nullptr;
  if (result != 0) throw WriteError("cannot write " + impl_->name + " in full: " + Why());
}

struct EventLogReader::Impl {
  struct Header {
    std::int64_t number = 0;
    std::int64_t utime = 0;
    std::int64_t channel_bytes = 0;
    std::int64_t data_bytes = 0;
    std::int64_t begin = 0;  // offset of the header in the file
    std::int64_t end = 0;    // offset behind the data
  };

  int fd = -1;
  std::int64_t size = 0;
  std::int64_t position = 0;
  std::int64_t skipped = 0;
  std::int64_t known_good = -1;  // a plausible event that another follows, found while scanning
  std::vector<std::uint8_t> window;
  std::int64_t window_begin = 0;

  bool Load(std::int64_t at, std::uint8_t* to, std::size_t count) const;
  const std::uint8_t* At(std::int64_t at, std::size_t count);
  bool ReadHeader(std::int64_t at, Header& header);
  bool IsFollowed(const Header& header);
  bool HoldsAnotherEvent(const Header& header);
  std::int64_t FindSync(std::int64_t from, std::int64_t end);
  bool ReadEvent(const Header& header, LogEvent& event);
};

bool EventLogReader::Impl::Load(std::int64_t at, std::uint8_t* to, std::size_t count) const {
  while (count > 0) {
    const ssize_t got = ::pread(fd, to, count, at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

// Gives `count` (at most kBufferBytes) bytes of the file from `at` on, or null beyond its end.
const std::uint8_t* EventLogReader::Impl::At(std::int64_t at, std::size_t count) {
  if (at + static_cast<std::int64_t>(count) > size) return nullptr;
  const auto window_size = static_cast<std::int64_t>(window.size());
  if (at < window_begin || at + static_cast<std::int64_t>(count) > window_begin + window_size) {
    window.resize(
        static_cast<std::size_t>(std::min(static_cast<std::int64_t>(kBufferBytes), size - at)));
    window_begin = at;
    if (!Load(at, window.data(), window.size())) {
      window.clear();
      return nullptr;
    }
  }
  return window.data() + (at - window_begin);
}

// Returns true when a plausible event starts at `at`: sync word, lengths that fit the file, a
// printable channel name.
bool EventLogReader::Impl::ReadHeader(std::int64_t at, Header& header) {
  const std::uint8_t* bytes = At(at, kHeaderBytes);
  if (bytes == nullptr || ReadBigEndian<std::uint32_t>(bytes) != kSync) return false;
  header.number = ReadBigEndian<std::int64_t>(bytes + 4);
  header.utime = ReadBigEndian<std::int64_t>(bytes + 12);
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(bytes + 20);
  const auto data_bytes = ReadBigEndian<std::uint32_t>(bytes + 24);
  if (channel_bytes == 0 || channel_bytes > kMaxChannelBytes || data_bytes > kMaxDataBytes) {
    return false;
  }
  header.channel_bytes = channel_bytes;
  header.data_bytes = data_bytes;
  header.begin = at;
  header.end = at + static_cast<std::int64_t>(kHeaderBytes) + channel_bytes + data_bytes;
  if (header.end > size) return false;
  const std::uint8_t* channel = At(at + static_cast<std::int64_t>(kHeaderBytes), channel_bytes);
  return channel != nullptr && std::all_of(channel, channel + channel_bytes,
                                           [](std::uint8_t c) { return c >= 0x20 && c != 0x7f; });
}

// True when an event, or the end of the file, comes right after this event.
bool EventLogReader::Impl::IsFollowed(const Header& header) {
  if (header.end == size) return true;
  std::uint8_t sync[4];
  if (header.end + 4 > size) return false;
  if (header.end >= window_begin &&
      header.end + 4 <= window_begin + static_cast<std::int64_t>(window.size())) {
    return ReadBigEndian<std::uint32_t>(window.data() + (header.end - window_begin)) == kSync;
  }
  return Load(header.end, sync, sizeof(sync)) && ReadBigEndian<std::uint32_t>(sync) == kSync;
}

// A header with a damaged length claims the bytes of the events behind it: look for one of those.
bool EventLogReader::Impl::HoldsAnotherEvent(const Header& header) {
  if (known_good > header.begin) return known_good < header.end;
  for (std::int64_t at = header.begin + 1;; ++at) {
    at = FindSync(at, header.end);
    if (at < 0) return false;
    Header inner;
    if (ReadHeader(at, inner) && IsFollowed(inner)) {
      known_good = at;
      return true;
    }
  }
}

// Finds the first sync word that starts in [from, end); -1 when there is none. It searches the
// bytes in the window before it loads more, so that many false sync words do not make it slow.
std::int64_t EventLogReader::Impl::FindSync(std::int64_t from, std::int64_t end) {
  end = std::min(end, size - 3);
  while (from < end) {
    const std::int64_t in_window = window_begin + std::ssize(window) - from;
    const bool is_loaded = from >= window_begin && in_window >= 4;
    const std::int64_t count = std::min<std::int64_t>(
        end - from + 3, is_loaded ? in_window : static_cast<std::int64_t>(kBufferBytes));
    const std::uint8_t* bytes = At(from, static_cast<std::size_t>(count));
    if (bytes == nullptr) return -1;
    const std::uint8_t* last = bytes + count - 3;
    for (const std::uint8_t* at = bytes; at < last; ++at) {
      at = static_cast<const std::uint8_t*>(
          std::memchr(at, kSync >> 24, static_cast<std::size_t>(last - at)));
      if (at == nullptr) break;
      if (ReadBigEndian<std::uint32_t>(at) == kSync) return from + (at - bytes);
    }
    from += count - 3;
  }
  return -1;
}

bool EventLogReader::Impl::ReadEvent(const Header& header, LogEvent& event) {
  event.number = header.number;
  event.utime = header.utime;
  const auto channel_at = header.begin + static_cast<std::int64_t>(kHeaderBytes);
  const auto channel_bytes = static_cast<std::size_t>(header.channel_bytes);
  const std::uint8_t* channel = At(channel_at, channel_bytes);
  if (channel == nullptr) return false;
  event.channel.assign(channel, channel + channel_bytes);
  event.data.resize(static_cast<std::size_t>(header.data_bytes));
  const std::int64_t data_at = channel_at + header.channel_bytes;
  if (event.data.size() > kBufferBytes / 2)
    return Load(data_at, event.data.data(), event.data.size());
  const std::uint8_t* data = At(data_at, event.data.size());
  if (data == nullptr) return false;
  std::copy_n(data, event.data.size(), event.data.begin());
  return true;
}

EventLogReader::EventLogReader(const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>()) {
  impl_->fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // waits for no FIFO
  if (impl_->fd < 0) throw std::runtime_error("cannot open " + path.string() + ": " + Why());
  struct stat info {};
  if (::fstat(impl_->fd, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(impl_->fd);
    throw std::runtime_error("cannot read " + path.string() + ": not a regular file");
  }
  impl_->size = info.st_size;
}

EventLogReader::~EventLogReader() {
  ::close(impl_->fd);
}

bool EventLogReader::Next(LogEvent& event) {
  Impl& log = *impl_;
  while (log.position < log.size) {
    Impl::Header header;
    const bool is_plausible = log.ReadHeader(log.position, header);
    if (is_plausible && (log.IsFollowed(header) || !log.HoldsAnotherEvent(header)) &&
        log.ReadEvent(header, event)) {
      log.position = header.end;
      return true;
    }
    const std::int64_t next = log.FindSync(log.position + 1, log.size);
    log.skipped += (next < 0 ? log.size : next) - log.position;
    log.position = next < 0 ? log.size : next;
  }
  return false;
}

std::int64_t EventLogReader::skipped_bytes() const {
  return impl_->skipped;
}

std::int64_t EventLogReader::position_bytes() const {
  return impl_->position;
}

std::int64_t EventLogReader::size_bytes() const {
  return impl_->size;
}

void EventLogReader::SeekTo(std::int64_t position_bytes) {
  impl_->position = std::clamp<std::int64_t>(position_bytes, 0, impl_->size);
  impl_->known_good = -1;
}

}  // namespace lio
