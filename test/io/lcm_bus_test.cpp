// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests what is particular to LCM's bus; bus_test.cpp tests what all buses do, and test/programs
// the daemon's multicast.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>

#include "lio/io/bus.hpp"
#include "lio/io/event_log.hpp"
#include "support/descriptor_limit.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string WordsOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(LcmBus, AnUnusableUrlSaysWhatAUrlIs) {
  EXPECT_THAT(WordsOf([] { static_cast<void>(OpenLcmBus("nonsense://somewhere")); }),
              AllOf(HasSubstr("nonsense://somewhere"), HasSubstr("give a URL of udpm://"),
                    Not(HasSubstr("\n"))));
}

TEST(LcmBus, AMissingServerIsNamed) {
  // Nobody listens there.
  EXPECT_THAT(WordsOf([] { static_cast<void>(OpenLcmBus("tcpq://127.0.0.1:1")); }),
              HasSubstr("TCPService"));
}

TEST(LcmBus, AMissingLogIsAskedFor) {
  const test::TempDir dir;
  const std::string url = "file://" + (dir.path() / "missing.lcm").string();
  EXPECT_THAT(WordsOf([&] { static_cast<void>(OpenLcmBus(url)); }),
              AllOf(HasSubstr(url), HasSubstr("name an existing log")));
  EXPECT_THROW(static_cast<void>(OpenLcmBus(url)), TransportError);
}

// liblcm's message about an address goes into the error, not to stderr as well.
TEST(LcmBus, FaultsAreSaidOnce) {
  testing::internal::CaptureStderr();
  const std::string words = WordsOf([] { static_cast<void>(OpenLcmBus("udpm://nonsense")); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(words, HasSubstr("LCM cannot open udpm://nonsense ("));
}

TEST(LcmBus, WithoutAFreeDescriptorTheErrorSaysWhereTheReasonIs) {
  const auto open = [] { static_cast<void>(OpenLcmBus("nonsense://somewhere")); };
  std::string words = WordsOf(open);  // UBSan shall know the error's class (descriptor_limit.hpp)
  testing::internal::CaptureStderr();
  {
    const test::NoFreeDescriptors none;
    words = WordsOf(open);
  }
  EXPECT_THAT(words, AllOf(HasSubstr("LCM cannot open nonsense://somewhere (its reason went to "
                                     "stderr, dup: Too many open files)"),
                           HasSubstr("give a URL of udpm://"), Not(HasSubstr("\n"))));
  EXPECT_NE(testing::internal::GetCapturedStderr(), "") << "liblcm's own words";
}

TEST(LcmBus, ALogIsPlayedToItsEndAndThenClosed) {
  const test::TempDir dir;
  const auto path = dir.path() / "drive.lcm";
  {
    EventLogWriter log(path);
    for (std::uint8_t i = 1; i <= 3; ++i) log.Write(1000 * i, "LIO_IMU", Bytes{i});
  }
  const auto bus = OpenLcmBus("file://" + path.string() + "?speed=0");
  std::vector<int> heads;
  bus->Subscribe("LIO_IMU", 10, [&](ByteView data, std::int64_t) { heads.push_back(data[0]); });
  ReceiveResult result = ReceiveResult::kMessage;
  for (int i = 0; i < 100 && result != ReceiveResult::kClosed; ++i) {
    result = bus->Receive(milliseconds(50));
  }
  EXPECT_EQ(result, ReceiveResult::kClosed);
  EXPECT_THAT(heads, ElementsAre(1, 2, 3));
}

TEST(LcmBus, ChannelNamesHaveAtMost63Characters) {
  const auto bus = OpenLcmBus("memq://");
  const auto ignore = [](ByteView, std::int64_t) {};
  EXPECT_NO_THROW(bus->Subscribe(std::string(63, 'a'), 1, ignore));
  EXPECT_THROW(bus->Subscribe(std::string(64, 'a'), 1, ignore), std::invalid_argument);
  EXPECT_THAT(WordsOf([&] { bus->Subscribe("", 1, ignore); }), HasSubstr("1 to 63 characters"));
}

TEST(LcmBus, EveryCharacterOfANameIsMeantLiterally) {
  const auto bus = OpenLcmBus("memq://");
  const std::string name = "a.b*c+d?e[f](g){h}|i^j$k\\";
  int num_calls = 0;
  bus->Subscribe(name, 10, [&](ByteView, std::int64_t) { ++num_calls; });
  EXPECT_TRUE(bus->Publish(name, Bytes{1}));
  EXPECT_EQ(bus->Receive(milliseconds(50)), ReceiveResult::kMessage);
  EXPECT_EQ(num_calls, 1);
}

TEST(LcmBus, PortComesFromTheUrlOrTheEnvironmentOrTheDefault) {
  EXPECT_EQ(UdpPort("udpm://239.255.76.67:7700?ttl=1"), 7700);
  EXPECT_EQ(UdpPort("udpm://239.255.76.67"), 7667);
  EXPECT_EQ(UdpPort("udpm://239.255.76.67:?ttl=1"), 7667);
  EXPECT_EQ(UdpPort("udpm://"), 7667);
  EXPECT_EQ(UdpPort("memq://"), 0);
  ::setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7701", 1);
  EXPECT_EQ(UdpPort(""), 7701);
  ::setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(UdpPort(""), 7667);
  ::unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(UdpPort(""), 7667);
}

}  // namespace
}  // namespace lio
