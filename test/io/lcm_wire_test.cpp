// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/lcm_wire.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace lio {
namespace {

TEST(FieldReader, ReadsBigEndianFieldsOneAfterTheOther) {
  const Bytes bytes = {0x01, 0xFF, 0xFE, 0x00, 0x00, 0x00, 0x2A,         // 1, -2, 42
                       0x3F, 0xF8, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,   // 1.5
                       0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01};  // the least and 1
  FieldReader reader(bytes.data());
  EXPECT_EQ(reader.Read<std::int8_t>(), 1);
  EXPECT_EQ(reader.Read<std::int16_t>(), -2);
  EXPECT_EQ(reader.Read<std::int32_t>(), 42);
  EXPECT_EQ(reader.Read<double>(), 1.5);
  EXPECT_EQ(reader.Read<std::int64_t>(), INT64_MIN + 1);
}

TEST(FieldReader, VectorsAreXYZ) {
  Bytes bytes(24, 0);
  bytes[0] = 0x3F, bytes[1] = 0xF0;    // 1
  bytes[8] = 0x40;                     // 2
  bytes[16] = 0xC0, bytes[17] = 0x08;  // -3
  EXPECT_EQ(FieldReader(bytes.data()).ReadVector(), Vector3(1, 2, -3));
}

TEST(CheckHead, WantsTheFingerprintAndTheFixedPart) {
  const std::uint64_t fingerprint = 0x0102030405060708;
  Bytes bytes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(CheckHead(bytes, fingerprint, 10), DecodeStatus::kOk);
  EXPECT_EQ(CheckHead(bytes, fingerprint, 11), DecodeStatus::kTruncated);
  EXPECT_EQ(CheckHead(bytes, fingerprint + 1, 10), DecodeStatus::kWrongType);
  bytes.resize(7);
  EXPECT_EQ(CheckHead(bytes, fingerprint, 10), DecodeStatus::kTruncated);
  EXPECT_EQ(CheckHead({}, fingerprint, 0), DecodeStatus::kTruncated);
}

// The size is checked first: the content of a message that is too large is not read.
TEST(CheckHead, WhatIsTooLargeIsNotReadAtAll) {
  EXPECT_EQ(CheckHead(Bytes(kMaxMessageBytes + 1), 1, 8), DecodeStatus::kTooLarge);
  EXPECT_EQ(CheckHead(Bytes(kMaxMessageBytes), 1, 8), DecodeStatus::kWrongType);
}

// lcm-gen writes these functions: the number of bytes, and the number that was written.
struct Message {
  int size = 4;
  int written = 4;
  int getEncodedSize() const { return size; }
  int encode(void* buffer, int offset, int max_size) const {
    auto* bytes = static_cast<std::uint8_t*>(buffer);
    for (int i = 0; i < max_size; ++i) bytes[offset + i] = static_cast<std::uint8_t>(7 + i);
    return written;
  }
};

TEST(EncodeMessage, GivesAllThatTheMessageWrites) {
  EXPECT_EQ(EncodeMessage(Message{}), (Bytes{7, 8, 9, 10}));
}

TEST(EncodeMessage, AMessageThatDoesNotFitItsOwnSizeIsABug) {
  EXPECT_THROW((void)EncodeMessage(Message{4, 3}), std::logic_error);
  EXPECT_THROW((void)EncodeMessage(Message{4, -1}), std::logic_error);
}

}  // namespace
}  // namespace lio
