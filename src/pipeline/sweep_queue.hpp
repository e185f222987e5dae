// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sweeps on their way from the stream to matching: those that wait, oldest first, and the one whose
// job is out. Under overload the oldest ones that wait are dropped.
//
// `next` is everywhere the index of the sweep to match next, as the mode says it: the sweeps before
// it have been matched, and the mode looks back on them.
#pragma once

#include <cstddef>
#include <deque>

#include "lio/scan/sweep.hpp"

namespace lio {

struct SweepQueueParameters {
  // So many sweeps are looked back on at most. Chosen: 4 s of a lidar of 20 Hz, more than
  // InitializingParameters::max_window_s.
  std::size_t max_looked_back_on = 80;
};

inline constexpr SweepQueueParameters kSweepQueue;

class SweepQueue {
 public:
  explicit SweepQueue(std::size_t max_waiting) : max_waiting_(max_waiting) {}

  // Modes add sweeps here, look back on them and take them out.
  std::deque<SweepPtr>& sweeps() { return sweeps_; }

  // Gives the next sweep to be matched; null while another one is out, or where none waits.
  [[nodiscard]] SweepPtr StartNext(std::size_t next);
  // The match of this sweep has ended. False: its sweep was given up meanwhile.
  [[nodiscard]] bool Finish(const SweepPtr& sweep, std::size_t next);
  // The count includes the sweep that is out.
  [[nodiscard]] std::size_t NumUnmatched(std::size_t next) const;

  // One message set so many sweeps free, as after a gap of the inertial stream. If they are several
  // they are no overload.
  void AddSetFree(std::size_t num_sweeps);
  // Drops the oldest sweeps that wait beyond the limit, and says how many. A mode that looks back
  // may match all that it looks back on anew, which is no overload either.
  [[nodiscard]] std::size_t Shed(std::size_t next, bool looks_back);

 private:
  std::size_t max_waiting_;
  std::deque<SweepPtr> sweeps_;
  SweepPtr in_flight_;                 // the sweep whose job is out
  std::size_t num_freed_at_once_ = 0;  // sweeps in the queue that came together
};

}  // namespace lio
