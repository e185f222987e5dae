// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is it known where in the initial map the body is? Until then no pose is published, since its
// frame would not be that of the map. It is about the map and not about the motion, so it outlives
// the modes: whenever the estimator must begin a new map, the place is sought again.
//
//   no initial map      nothing is asked, all poses count
//   seeking             scans make a new map, and its place in the initial one is sought
//   found               the next scan is matched in the initial map
//   inside              scans are matched in the initial map, and extend it unless it is locked
#pragma once

#include <cstdint>
#include <optional>

#include "lio/pipeline/match_job.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

class PlaceKnowledge {
 public:
  PlaceKnowledge(bool has_initial_map, bool is_map_locked)
      : state_(has_initial_map ? State::kSeeking : State::kNoInitialMap),
        is_map_locked_(is_map_locked) {}

  [[nodiscard]] bool is_seeking() const { return state_ == State::kSeeking; }
  [[nodiscard]] bool is_inside() const {
    return state_ == State::kFound || state_ == State::kInside;
  }
  // Scans must not grow the map.
  [[nodiscard]] bool is_map_locked() const { return is_inside() && is_map_locked_; }
  // The place was known before it was lost.
  [[nodiscard]] bool was_inside() const { return was_inside_; }

  // Completes a job of the mode. `may_find` is true when the filter tracks.
  void Prepare(bool may_find, MatchJob& job) {
    if (job.map_action == MapAction::kClear) {
      if (is_inside()) state_ = State::kSeeking;
    } else if (state_ == State::kFound) {
      state_ = State::kInside;
      job.map_action = MapAction::kEnter;
    } else if (state_ == State::kSeeking) {
      job.seeks_place = may_find;
      has_sought_ |= may_find;
    }
  }
  void SetFound() {
    state_ = State::kFound;
    was_inside_ = true;
  }

  // Returns why the result is not to be trusted, where the run ends while the place is sought.
  [[nodiscard]] std::optional<Cause> Doubt() const {
    if (!is_seeking() || !has_sought_) return std::nullopt;
    if (was_inside_) {
      return Cause{CauseKind::kPlaceUnknown, Trust::kDoubtful, 0.0,
                   "the place in the initial map was lost, and not found again", ""};
    }
    return Cause{CauseKind::kPlaceUnknown, Trust::kNo, 0.0,
                 "the place in the initial map was not found, so there is no pose: is the map of "
                 "this place, with z up, and did the body move? --initial-pose says where to seek",
                 ""};
  }

 private:
  enum class State : std::int8_t { kNoInitialMap, kSeeking, kFound, kInside };

  State state_;
  bool is_map_locked_;
  bool was_inside_ = false;
  bool has_sought_ = false;
};

}  // namespace lio
