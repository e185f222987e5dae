// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "stderr_capture.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace lio {
namespace {

std::string LastError(const char* call) {
  return fmt::format("{}: {}", call, std::generic_category().message(errno));
}

bool Redirect(int from, int to) {
  int result = -1;
  do {
    result = ::dup2(from, to);
  } while (result < 0 && (errno == EINTR || errno == EBUSY));
  return result >= 0;
}

std::string Contents(int file) {
  const off_t size = std::max<off_t>(::lseek(file, 0, SEEK_END), 0);
  std::string text(static_cast<std::size_t>(size), ' ');
  const ssize_t num_read = ::pread(file, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(num_read, 0)));
  return text;
}

void CloseIfOpen(int& file) {
  if (file >= 0) ::close(file);
  file = -1;
}

}  // namespace

// stderr is duplicated first: were it closed, the file in memory would get its descriptor.
StderrCapture::StderrCapture() {
  std::fflush(stderr);
  saved_ = ::dup(STDERR_FILENO);
  if (saved_ < 0) {
    fault_ = LastError("dup");
    return;
  }
  memory_ = ::memfd_create("stderr", MFD_CLOEXEC);
  if (memory_ < 0) {
    fault_ = LastError("memfd_create");
  } else if (!Redirect(memory_, STDERR_FILENO)) {
    fault_ = LastError("dup2");
  } else {
    return;
  }
  CloseIfOpen(memory_);
  CloseIfOpen(saved_);
}

StderrCapture::~StderrCapture() {
  // Without stderr there is nowhere to report the fault to.
  if (saved_ >= 0) static_cast<void>(Restore());
  CloseIfOpen(memory_);
}

std::string StderrCapture::Restore() {
  std::fflush(stderr);
  const std::string fault = Redirect(saved_, STDERR_FILENO) ? "" : LastError("dup2");
  CloseIfOpen(saved_);
  return fault;
}

std::string StderrCapture::Finish() {
  if (saved_ < 0) return "";
  const std::string fault = Restore();
  const std::string text = Contents(memory_);
  CloseIfOpen(memory_);
  if (!fault.empty()) throw std::runtime_error("cannot restore stderr (" + fault + ")");
  return text;
}

}  // namespace lio
