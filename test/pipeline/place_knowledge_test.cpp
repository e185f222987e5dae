// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/place_knowledge.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

MatchJob JobWith(MapAction action) {
  MatchJob job;
  job.map_action = action;
  return job;
}

TEST(PlaceKnowledge, WithoutAnInitialMapJobsStayAsTheyAre) {
  PlaceKnowledge place(false, true);
  for (const MapAction action : {MapAction::kClear, MapAction::kKeep}) {
    MatchJob job = JobWith(action);
    place.Prepare(true, job);
    EXPECT_EQ(job.map_action, action);
    EXPECT_FALSE(job.seeks_place);
  }
  EXPECT_FALSE(place.is_seeking());
  EXPECT_FALSE(place.is_map_locked());
}

TEST(PlaceKnowledge, SeeksWhileTheFilterTracksThenEntersOnce) {
  PlaceKnowledge place(true, false);
  EXPECT_TRUE(place.is_seeking());
  EXPECT_FALSE(place.was_inside());
  MatchJob job = JobWith(MapAction::kKeep);
  place.Prepare(false, job);
  EXPECT_FALSE(job.seeks_place);
  place.Prepare(true, job);
  EXPECT_TRUE(job.seeks_place);
  place.SetFound();
  EXPECT_TRUE(place.is_inside());
  job = JobWith(MapAction::kKeep);
  place.Prepare(true, job);
  EXPECT_EQ(job.map_action, MapAction::kEnter);
  EXPECT_FALSE(job.seeks_place);
  job = JobWith(MapAction::kKeep);
  place.Prepare(true, job);
  EXPECT_EQ(job.map_action, MapAction::kKeep);
  EXPECT_FALSE(place.is_map_locked());
}

TEST(PlaceKnowledge, NewMapIsSoughtInTheInitialOneAgain) {
  PlaceKnowledge place(true, true);
  place.SetFound();
  EXPECT_TRUE(place.is_map_locked());
  MatchJob job = JobWith(MapAction::kClear);
  place.Prepare(true, job);
  EXPECT_EQ(job.map_action, MapAction::kClear);
  EXPECT_TRUE(place.is_seeking());
  EXPECT_FALSE(place.is_map_locked()) << "the new map is no longer the initial one";
  EXPECT_TRUE(place.was_inside());
}

TEST(PlaceKnowledge, ARunThatEndsWhileThePlaceIsSoughtIsInDoubt) {
  PlaceKnowledge place(true, false);
  EXPECT_FALSE(place.Doubt());  // nothing was sought yet: the cause is another one
  MatchJob job = JobWith(MapAction::kKeep);
  place.Prepare(true, job);
  ASSERT_TRUE(place.Doubt());
  EXPECT_EQ(place.Doubt()->kind, CauseKind::kPlaceUnknown);
  EXPECT_EQ(place.Doubt()->leaves, Trust::kNo);
  place.SetFound();
  EXPECT_FALSE(place.Doubt());
  job = JobWith(MapAction::kClear);
  place.Prepare(true, job);
  ASSERT_TRUE(place.Doubt());
  EXPECT_EQ(place.Doubt()->leaves, Trust::kDoubtful);
}

TEST(PlaceKnowledge, ARunWithoutAnInitialMapIsInNoDoubt) {
  PlaceKnowledge place(false, false);
  MatchJob job = JobWith(MapAction::kKeep);
  place.Prepare(true, job);
  EXPECT_FALSE(place.Doubt());
}

}  // namespace
}  // namespace lio
