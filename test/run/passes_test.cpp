// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Whole passes over a log are tested in test/integration/passes_test.py.
#include "lio/run/passes.hpp"

#include <gmock/gmock.h>

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

PassesResult Whole(Trust trust, double coverage = 1.0) {
  PassesResult result;
  result.verdict.trust = trust;
  result.verdict.coverage = coverage;
  return result;
}

TEST(Passes, TheSecondIsTakenWhereItIsTrustedAsMuch) {
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kYes), Whole(Trust::kYes)), IsEmpty());
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kNo), Whole(Trust::kYes)), IsEmpty());
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kYes, 0.98), Whole(Trust::kYes, 0.975)), IsEmpty());
}

TEST(Passes, TheFirstIsKeptWhereTheSecondIsWorse) {
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kYes), Whole(Trust::kDoubtful)), HasSubstr("less"));
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kYes), Whole(Trust::kYes, 0.9)), HasSubstr("fewer"));
  PassesResult refused = Whole(Trust::kNo);
  refused.refusal = "the units are others";
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kNo), refused), HasSubstr("the units are others"));
  PassesResult torn = Whole(Trust::kYes);
  torn.failure = "the disk is full";
  EXPECT_THAT(WhyFirstIsKept(Whole(Trust::kYes), torn), HasSubstr("the disk is full"));
}

}  // namespace
}  // namespace lio
