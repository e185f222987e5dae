// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/udp_capture.hpp"

#include <gmock/gmock.h>

#include <random>

#include "lio/io/input_error.hpp"
#include "support/capture_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::CaptureWriter;

constexpr Timestamp kCaptureBegin{1'700'000'000'123'456'000};

class UdpCaptureTest : public testing::Test {
 protected:
  std::vector<std::string> ReadAll(const std::string& bytes) {
    UdpCapture capture(dir_.Write("drive.pcap", bytes));
    std::vector<std::string> payloads;
    UdpDatagram datagram;
    while (capture.Next(datagram)) {
      payloads.emplace_back(datagram.payload.begin(), datagram.payload.end());
      last_ = datagram;
    }
    counts_ = capture.counts();
    return payloads;
  }

  test::TempDir dir_;
  UdpDatagram last_;
  CaptureCounts counts_;
};

TEST_F(UdpCaptureTest, ADatagramHasItsSenderPortTimeAndContent) {
  CaptureWriter writer;
  writer.Udp(kCaptureBegin, "hello", 2368);
  EXPECT_THAT(ReadAll(writer.bytes()), testing::ElementsAre("hello"));
  EXPECT_EQ(last_.received, kCaptureBegin);
  EXPECT_EQ(last_.port, 2368);
  EXPECT_EQ(AddressText(last_.source), "192.168.1.201");
  EXPECT_FALSE(counts_.Any());
}

TEST_F(UdpCaptureTest, FragmentsArePutTogetherAndLostOnesCounted) {
  std::string large(12'608, 'a');
  large[5'000] = 'b';
  CaptureWriter writer;
  writer.Udp(kCaptureBegin, large, 7502);
  writer.Udp(kCaptureBegin, large, 7502);
  EXPECT_THAT(ReadAll(writer.bytes()), testing::ElementsAre(large, large));
  constexpr std::size_t kFrame = 16 + 14 + 20 + 1480;  // one of the nine of a datagram
  std::string without = writer.bytes();
  without.erase(24 + 3 * kFrame, kFrame);
  EXPECT_THAT(ReadAll(without), testing::ElementsAre(large));
  EXPECT_EQ(counts_.num_fragments_lost, 8);
}

TEST_F(UdpCaptureTest, OtherFramesAreCountedAndPassedOver) {
  CaptureWriter writer;
  writer.Frame(kCaptureBegin, std::string(12, '\x02') + "\x08\x06" + std::string(28, '\0'));  // ARP
  writer.Frame(kCaptureBegin, "short");
  writer.Udp(kCaptureBegin, "hello", 2368);
  writer.Frame(kCaptureBegin, std::string(1248, 'x'), 60);
  EXPECT_THAT(ReadAll(writer.bytes()), testing::ElementsAre("hello"));
  EXPECT_EQ(counts_.num_other, 3);
}

TEST_F(UdpCaptureTest, AVlanTagIsPassedOver) {
  CaptureWriter plain;
  plain.Udp(kCaptureBegin, "hello", 2368);
  std::string frame = plain.bytes().substr(24 + 16);
  frame.insert(12, std::string("\x81\x00\x00\x05", 4));
  CaptureWriter tagged;
  tagged.Frame(kCaptureBegin, frame);
  EXPECT_THAT(ReadAll(tagged.bytes()), testing::ElementsAre("hello"));
  CaptureWriter cut;
  cut.Frame(kCaptureBegin, frame, frame.size() - 2);
  EXPECT_TRUE(ReadAll(cut.bytes()).empty());
  EXPECT_EQ(counts_.num_cut, 1);
}

TEST_F(UdpCaptureTest, ACutFileIsReadUpToTheCut) {
  CaptureWriter writer;
  for (int k = 0; k < 10; ++k) writer.Udp(kCaptureBegin, "hello", 2368);
  EXPECT_EQ(ReadAll(writer.bytes().substr(0, writer.bytes().size() - 3)).size(), 9u);
  EXPECT_THAT(counts_.fault, testing::HasSubstr("truncated"));
}

TEST_F(UdpCaptureTest, DamageNeverEndsInACrash) {
  CaptureWriter writer;
  for (int k = 0; k < 5; ++k) writer.Udp(kCaptureBegin, std::string(3'000, 'x'), 2368);
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    std::string bytes = writer.bytes();
    for (int n = 0; n < 20; ++n) {
      bytes[24 + random() % (bytes.size() - 24)] = static_cast<char>(random());
    }
    bytes.resize(24 + random() % (bytes.size() - 24));
    EXPECT_LE(ReadAll(bytes).size(), 5u * 3u);
  }
}

TEST_F(UdpCaptureTest, WhatIsNoCaptureIsRefusedByName) {
  const auto why = [this](const std::string& bytes) -> std::string {
    try {
      (void)ReadAll(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(why("no capture at all, but some text"), testing::HasSubstr("no network capture"));
  EXPECT_THAT(why(""), testing::HasSubstr("no network capture"));
  EXPECT_THAT(why(CaptureWriter(105).bytes()), testing::HasSubstr("IEEE802_11"));
}

}  // namespace
}  // namespace lio
