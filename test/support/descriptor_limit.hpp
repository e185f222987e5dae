// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// No further file descriptor can be opened while one of these lives.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <system_error>

namespace lio::test {

class NoFreeDescriptors {
 public:
  NoFreeDescriptors() {
    // UBSan opens a pipe for its check of the first virtual call on a class, and ends the program
    // if it cannot; it remembers the class.
    static_cast<void>(std::generic_category().message(0));
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int lowest_free = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(lowest_free);
    rlimit limited = before_;
    limited.rlim_cur = static_cast<rlim_t>(lowest_free);
    ::setrlimit(RLIMIT_NOFILE, &limited);
  }
  ~NoFreeDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoFreeDescriptors(const NoFreeDescriptors&) = delete;
  NoFreeDescriptors& operator=(const NoFreeDescriptors&) = delete;

 private:
  rlimit before_{};
};

}  // namespace lio::test
