// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Puts chunks together to sweeps. A sweep is closed when its last chunk is in, when a chunk of the
// sweep after the next one begins, or when CloseUpTo() says that time has passed it; what is still
// missing then is counted, and the smaller sweep is used. Order of arrival is free among the chunks
// of two neighbouring sweeps. Only stamps and sequence numbers decide, never the clock.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/scan/sweep.hpp"

namespace lio {

// Returns when the chunk's latest point was measured, after the chunk's stamp.
[[nodiscard]] Duration LastOffset(const ScanChunk& chunk);

class ScanAssembler {
 public:
  // Counts into `counters`, which outlives the assembler.
  explicit ScanAssembler(Counters& counters) : counters_(&counters) {}

  void Add(ScanChunk chunk, std::int64_t decode_ns);
  // Closes every sweep that ends before `stamp`: by its last known point, and by how long the last
  // whole sweep was.
  void CloseUpTo(Timestamp stamp);
  void CloseAll();
  // Stamps have jumped from `end` to `next_begin`: closes what is left of the time before.
  void CloseSegment(Timestamp end, Timestamp next_begin);

  // Closed sweeps in order of time, oldest first.
  [[nodiscard]] std::optional<Sweep> Take();
  // Sweeps that are open, or closed and not taken.
  [[nodiscard]] std::size_t num_held() const { return open_.size() + closed_.size(); }

 private:
  struct SweepName {
    std::int32_t scan_seq = 0;
    std::int8_t sensor_id = 0;
    Timestamp first;  // stamps of the earliest and latest point so far
    Timestamp last;

    bool Names(const ScanChunk& chunk) const;
  };
  struct Partial {
    SweepName name;
    std::vector<ScanChunk> chunks;  // by index; empty points and count 0: not here yet
    int num_received = 0;
    std::size_t num_points = 0;
    std::int64_t decode_ns = 0;
  };

  bool IsTornOff(const ScanChunk& chunk, Timestamp last) const;  // `last`: of its latest point
  bool IsCountDoubtful(const ScanChunk& chunk);
  Partial* FindOrOpen(const ScanChunk& chunk);
  void CloseOneFor(Timestamp stamp);
  void Close(std::size_t at);
  [[nodiscard]] bool TellsWhatIsMissing(const Partial& partial) const;

  Counters* counters_;
  std::deque<Partial> open_;  // at most two, oldest first
  std::deque<Sweep> closed_;
  Duration span_;                       // duration of the last whole sweep
  int usual_count_ = 0;                 // chunks of the last sweep of which two came
  std::optional<ScanChunk> doubtful_;   // the last chunk with a doubtful count, without points
  std::deque<SweepName> closed_names_;  // names of the last sweeps, to know their stragglers by
};

}  // namespace lio
