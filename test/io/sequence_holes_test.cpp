// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/sequence_holes.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace lio {
namespace {

constexpr std::int32_t kLast = std::numeric_limits<std::int32_t>::max();

std::int64_t MissingAfter(std::initializer_list<std::int32_t> numbers) {
  SequenceHoles holes;
  for (const std::int32_t number : numbers) holes.Add(number);
  return holes.num_missing();
}

// Adds the numbers from `first` up to `last`.
void AddAll(SequenceHoles& holes, std::int32_t first, std::int32_t last) {
  for (std::int32_t number = first; number <= last; ++number) holes.Add(number);
}

TEST(SequenceHoles, NumbersThatNeverComeAreMissing) {
  EXPECT_EQ(MissingAfter({}), 0);
  EXPECT_EQ(MissingAfter({7}), 0);
  EXPECT_EQ(MissingAfter({5, 6, 9, 10}), 2);
  EXPECT_EQ(MissingAfter({5, 68, 69}), 62);
  EXPECT_EQ(MissingAfter({5, 705, 706}), 699) << "an outage";
}

TEST(SequenceHoles, NumbersOutOfOrderAndTwiceAreNone) {
  EXPECT_EQ(MissingAfter({5, 7, 6, 8}), 0);
  EXPECT_EQ(MissingAfter({5, 8, 7, 7, 6, 5, 9}), 0);
  EXPECT_EQ(MissingAfter({5, 8, 7, 8, 9}), 1);
  EXPECT_EQ(MissingAfter({5, 4, 3, 6}), 0) << "before the first one nothing is missed";
}

TEST(SequenceHoles, OneFalseNumberAddsNothing) {
  for (const std::int32_t wrong : {-7, 0, 40, 1100, 9999, 10'999, 500'000, kLast}) {
    SequenceHoles holes;
    AddAll(holes, 100, 1000);
    holes.Add(wrong);
    AddAll(holes, 1001, 1100);
    EXPECT_EQ(holes.num_missing(), 0) << wrong;
  }
}

TEST(SequenceHoles, AFalseNumberThatIsNearIsNoLossOnceTheOthersHaveCome) {
  for (const std::int32_t wrong : {1003, 1030, 1063}) {
    SequenceHoles holes;
    AddAll(holes, 900, 1000);
    holes.Add(wrong);
    AddAll(holes, 1001, wrong + 5);
    EXPECT_EQ(holes.num_missing(), 0) << wrong;
  }
}

TEST(SequenceHoles, AnotherSenderAmongThemAddsNothing) {
  SequenceHoles holes;
  for (std::int32_t i = 0; i < 500; ++i) {
    holes.Add(1000 + i);
    holes.Add(5 + i);
  }
  EXPECT_EQ(holes.num_missing(), 0);
}

TEST(SequenceHoles, ARestartAndAWrapAreNoHoles) {
  EXPECT_EQ(MissingAfter({1000, 1001, 0, 1, 2, 4}), 1);
  EXPECT_EQ(MissingAfter({100, 900'000, 900'001}), 0) << "another sender";
  EXPECT_EQ(MissingAfter({kLast - 1, kLast, -kLast - 1, -kLast, -kLast + 2}), 1);
}

}  // namespace
}  // namespace lio
