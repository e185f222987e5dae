// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the stream's events and the outcomes of matching to the mode that the estimator is in, and
// changes the mode where the mode asks for it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "pipeline/mode.hpp"

namespace lio {

class ModeDriver {
 public:
  // Begins with an initialization, which takes the handover. All that `context` refers to outlives
  // this, and `place` is the context's own.
  ModeDriver(const ModeContext& context, PlaceKnowledge& place, const Handover& handover = {});

  void Consume(const StreamEvent& event);

  // The sweep is that of next_sweep() in the context's queue.
  [[nodiscard]] MatchJob MakeJob(const SweepPtr& sweep);
  // Takes the outcome of the last job. The result has the pose for the map where the scan grows it.
  [[nodiscard]] InsertTask FinishJob(const MatchOutcome& outcome);

  ModeKind kind() const { return KindOf(*mode_); }
  std::size_t next_sweep() const { return NextSweepOf(*mode_); }
  TrackingStatus status() const;

 private:
  using Next = std::optional<Transition>;

  void GoOn(Next transition);
  void TakePlace(const MatchOutcome& outcome);

  // These handle one kind of event each.
  Next Take(const ImuReady& event);
  Next Take(const SweepReady& event);
  Next Take(const SegmentStarts& event);
  Next Take(const AmbiguousClockStep& event);
  Next Take(const ImuAbsent& event);
  Next Take(const ImuAppeared& event);
  Next Take(const StreamEnded& event);
  Next Take(const Notice& notice);

  // Returns null where another mode runs.
  template <class M>
  M* As() {
    return std::get_if<M>(mode_.get());
  }

  ModeContext context_;
  PlaceKnowledge& place_;
  std::unique_ptr<Mode> mode_;
};

}  // namespace lio
