// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes numbered messages that tests write into bags, and what they find when they read them back.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "lio/convert/bag_reader.hpp"

namespace lio::test {

inline constexpr int kNumNumbered = 200;

inline Timestamp ReceivedAt(int i) {
  return Timestamp{1'600'000'000'000'000'000 + i * 10'000'000};
}

// Message `i` holds 200 + i bytes that no compression makes smaller, on one of two topics.
inline std::vector<std::uint8_t> NumberedPayload(int i) {
  std::minstd_rand random(static_cast<unsigned>(i + 1));
  std::vector<std::uint8_t> payload(static_cast<std::size_t>(200 + i));
  for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random() >> 8);
  return payload;
}

struct ReadBack {
  int num = 0;
  bool all_right = true;
  BagDamage damage;
};

}  // namespace lio::test
