// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/service_notifier.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

class ServiceNotifierTest : public ::testing::Test {
 protected:
  ~ServiceNotifierTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }
};

TEST_F(ServiceNotifierTest, WhatIsToldComesToTheSocket) {
  const test::TempDir folder;
  const std::string path = (folder.path() / "notify").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  ServiceNotifier().Tell("READY=1\nSTATUS=x");
  std::array<char, 100> buffer{};
  const auto size = ::recv(fd, buffer.data(), buffer.size(), MSG_DONTWAIT);
  ::close(fd);
  ASSERT_GT(size, 0);
  EXPECT_EQ(std::string(buffer.data(), static_cast<std::size_t>(size)), "READY=1\nSTATUS=x");
}

TEST_F(ServiceNotifierTest, WithoutASocketNothingHappens) {
  ServiceNotifier().Tell("READY=1");
  ::setenv("NOTIFY_SOCKET", "nonsense", 1);
  ServiceNotifier().Tell("READY=1");
  ::setenv("NOTIFY_SOCKET", std::string(200, '/').c_str(), 1);
  ServiceNotifier().Tell("READY=1");
}

TEST_F(ServiceNotifierTest, TheWatchdogIsThatOfThisProcess) {
  EXPECT_FALSE(ServiceNotifier().watchdog());
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  EXPECT_EQ(ServiceNotifier().watchdog(), std::chrono::seconds(2));
  ::setenv("WATCHDOG_PID", "1", 1);
  EXPECT_FALSE(ServiceNotifier().watchdog());
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  EXPECT_TRUE(ServiceNotifier().watchdog());
  ::setenv("WATCHDOG_USEC", "soon", 1);
  EXPECT_FALSE(ServiceNotifier().watchdog());
}

}  // namespace
}  // namespace lio
