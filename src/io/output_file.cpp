// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>

namespace lio {
namespace {

constexpr std::size_t kMaxKeptBytes = 1 << 20;
constexpr std::uint64_t kPageBytes = 4096;
constexpr mode_t kMode = 0666;  // less the umask

// Cuts what was written of a row that did not fit; devices and pipes have nothing to cut.
void CutToWholeRows(std::FILE* file, std::string_view written) {
  const std::size_t end = written.rfind('\n');
  const std::size_t num_over = end == written.npos ? written.size() : written.size() - end - 1;
  const off_t size = ::lseek(::fileno(file), 0, SEEK_CUR);
  if (num_over == 0 || size < static_cast<off_t>(num_over)) return;
  const int failed = ::ftruncate(::fileno(file), size - static_cast<off_t>(num_over));
  if (failed != 0) return;  // the readers take a last row that is cut
  ::lseek(::fileno(file), 0, SEEK_END);
}

}  // namespace

std::string_view RowsWithinPage(std::string_view rows, std::uint64_t at) {
  const std::size_t left = static_cast<std::size_t>(kPageBytes - at % kPageBytes);
  if (rows.size() <= left) return rows;
  const std::size_t last_end = rows.substr(0, left).rfind('\n');
  if (last_end != rows.npos) return rows.substr(0, last_end + 1);
  const std::size_t end = rows.find('\n');
  return end == rows.npos ? rows : rows.substr(0, end + 1);
}

// Without O_NONBLOCK a FIFO that nobody reads would be waited for; a pipe that is full is waited
// for all the same.
int OpenToWrite(const std::filesystem::path& path, OutputFile::Links links) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK;
  const int no_follow = links == OutputFile::Links::kReplaced ? O_NOFOLLOW : 0;
  int fd = ::open(path.c_str(), kFlags | no_follow, kMode);
  if (fd < 0 && errno == ELOOP && no_follow != 0 && ::unlink(path.c_str()) == 0) {
    fd = ::open(path.c_str(), kFlags | no_follow, kMode);
  }
  if (fd >= 0) ::fcntl(fd, F_SETFL, O_WRONLY);
  return fd;
}

OutputFile::OutputFile(const std::filesystem::path& path, Links links) : path_(path) {
  if (path == "-") {
    throw UsageError("- is no name for a file: name one, or /dev/stdout for the standard output");
  }
  const int fd = OpenToWrite(path, links);
  if (fd < 0) throw OutputError("cannot write " + path.string() + ": " + std::strerror(errno));
  file_.reset(::fdopen(fd, "wb"));
  if (!file_) {
    ::close(fd);
    throw OutputError("cannot write " + path.string());
  }
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

OutputFile::~OutputFile() {
  if (!file_) return;
  try {
    Flush();
  } catch (const WriteError&) {
    // Who wants to know calls Close.
  }
}

void OutputFile::Write(std::string_view rows) {
  kept_ += rows;
  if (kept_.size() > kMaxKeptBytes) Flush();
}

void OutputFile::Flush() {
  std::string_view left = kept_;
  while (!left.empty()) {
    const std::string_view piece = RowsWithinPage(left, size_);
    const ssize_t num = ::write(::fileno(file_.get()), piece.data(), piece.size());
    if (num < 0 && errno == EINTR) continue;
    if (num < 0) {
      const int reason = errno;
      CutToWholeRows(file_.get(), std::string_view(kept_).substr(0, kept_.size() - left.size()));
      kept_.clear();
      throw WriteError("cannot write " + path_.string() + " in full: " + std::strerror(reason));
    }
    left.remove_prefix(static_cast<std::size_t>(num));
    size_ += static_cast<std::uint64_t>(num);
  }
  kept_.clear();
}

void OutputFile::Close() {
  Flush();
  if (file_ && std::fclose(file_.release()) != 0) {
    throw WriteError("cannot write " + path_.string() + " in full: " + std::strerror(errno));
  }
}

void CloseAll(std::span<OutputFile* const> files) {
  std::exception_ptr first;
  for (OutputFile* file : files) {
    try {
      file->Close();
    } catch (const WriteError&) {
      if (!first) first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
}

void WriteText(const std::filesystem::path& path, std::string_view text, OutputFile::Links links) {
  OutputFile file(path, links);
  file.Write(text);
  file.Close();
}

}  // namespace lio
