// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A match tells which share of the map the last scan before has brought, along each direction.
#include <gtest/gtest.h>

#include "filter/tumbling_filter.hpp"
#include "lio/filter/filter_history.hpp"

namespace lio {
namespace {

using test::AddImuUpTo;
using test::PoseAt;
using test::StampAt;
using test::StartedHistory;

PoseEvent GrowingPoseAt(double t_s) {
  PoseEvent event = PoseAt(t_s, Vector6::Constant(0.01));
  event.measurement.new_content_share = 0.1;
  event.measurement.blend_cov = 1e-4 * Matrix6::Identity();
  return event;
}

Matrix6 HalfOfEach() {
  return 0.5 * Matrix6::Identity();
}

// Adds a pose that adds nothing to the map, and the samples up to there.
void AddPoseThatTells(FilterHistory& history, double t_s, const std::optional<Matrix6>& share) {
  AddImuUpTo(history, t_s);
  EXPECT_EQ(history.AddPose(StampAt(t_s), PoseAt(t_s), nullptr, share), EventOutcome::kApplied);
}

TEST(FilterHistoryShare, AShareThatIsToldLaterCountsAsIfItHadBeenKnown) {
  FilterHistory told = StartedHistory();
  FilterHistory known = StartedHistory();
  FilterHistory untold = StartedHistory();
  PoseEvent event = GrowingPoseAt(0.5);
  for (FilterHistory* history : {&told, &untold, &known}) {
    AddImuUpTo(*history, 0.5);
    if (history == &known) {
      event.measurement.knows_directions = true;
      event.measurement.share_by_direction = HalfOfEach();
    }
    EXPECT_EQ(history->AddPose(StampAt(0.5), event), EventOutcome::kApplied);
    AddPoseThatTells(*history, 0.6, history == &told ? std::optional(HalfOfEach()) : std::nullopt);
  }
  EXPECT_GT((untold.head().cov - known.head().cov).norm(), 1e-6);
  EXPECT_EQ(told.head().cov, known.head().cov);
  AddPoseThatTells(told, 0.7, 0.9 * HalfOfEach());
  AddPoseThatTells(known, 0.7, std::nullopt);
  EXPECT_EQ(told.head().cov, known.head().cov) << "once for each scan";
}

// Samples that came after the match's own time are propagated anew, too.
TEST(FilterHistoryShare, AShareCountsUpToTheNewestSample) {
  FilterHistory late = StartedHistory();
  FilterHistory in_order = StartedHistory();
  for (FilterHistory* history : {&late, &in_order}) {
    AddImuUpTo(*history, 0.5);
    EXPECT_EQ(history->AddPose(StampAt(0.5), GrowingPoseAt(0.5)), EventOutcome::kApplied);
    AddImuUpTo(*history, history == &late ? 1.0 : 0.6);
    EXPECT_EQ(history->AddPose(StampAt(0.6), PoseAt(0.6), nullptr, HalfOfEach()),
              EventOutcome::kApplied);
    AddImuUpTo(*history, 1.0);
  }
  EXPECT_LT((late.head().cov - in_order.head().cov).norm(), 1e-9);
}

TEST(FilterHistoryShare, AShareIsThatOfAScanBeforeWhichGrewTheMap) {
  FilterHistory telling = StartedHistory();
  FilterHistory silent = StartedHistory();
  for (FilterHistory* history : {&telling, &silent}) {
    const auto share = history == &telling ? std::optional(HalfOfEach()) : std::nullopt;
    EXPECT_EQ(history->AddPose(StampAt(-0.5), PoseAt(-0.5), nullptr, share),
              EventOutcome::kBeforeStart);
    AddPoseThatTells(*history, 0.5, share);  // there is no scan before
    AddPoseThatTells(*history, 0.9, share);  // the scan before added nothing
    AddImuUpTo(*history, 1.0);
    EXPECT_EQ(history->AddPose(StampAt(1.0), GrowingPoseAt(1.0), nullptr, share),
              EventOutcome::kApplied)
        << "its own match tells of the one before";
    AddImuUpTo(*history, 1.5);
    EXPECT_EQ(history->AddRebase(StampAt(1.2)), EventOutcome::kApplied);
    AddPoseThatTells(*history, 1.6, share);  // the map has begun anew since
  }
  EXPECT_EQ(telling.head().cov, silent.head().cov);
}

}  // namespace
}  // namespace lio
