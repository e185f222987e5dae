// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds closed sweeps until the inertial stream has passed their end, so that they can be deskewed
// and fused at their own time. Sweeps leave in order of time; what comes late, or waits in vain, is
// dropped and counted.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "lio/base/counters.hpp"
#include "lio/scan/sweep.hpp"

namespace lio {

class ScanGate {
 public:
  // Counts into `counters`, which outlives this.
  explicit ScanGate(Counters& counters) : counters_(&counters) {}

  // The sweep is dropped, and counted, when it is empty or ends before one that came already. One
  // whose stamp is far ahead is held until the next one bears it out.
  void Add(Sweep sweep);

  // The oldest sweep if the inertial stream, whose newest stamp is given, has passed its end, which
  // is to be moved by `correction`. Absent: nothing is ready. Call it after every message.
  std::shared_ptr<Sweep> Open(std::optional<Timestamp> newest_imu, Duration correction = {});
  // Has the inertial stream not moved for too long while the lidar went on?
  [[nodiscard]] bool IsImuSilent() const;
  [[nodiscard]] std::size_t num_held() const { return waiting_.size() + (suspect_ ? 1 : 0); }
  // The oldest sweep whatever the inertial stream says.
  std::shared_ptr<Sweep> Force();
  // No more sweeps come: lets in the one that is held.
  void Flush();
  // The inertial stream begins anew at `first`: forgets sweeps that were let in as later than that.
  void StartSegment(Timestamp first);

  bool empty() const { return waiting_.empty(); }
  const Sweep& oldest() const { return *waiting_.front(); }
  // Returns the time between the ends of the oldest and the newest waiting sweep.
  double waiting_span_s() const;

 private:
  void Accept(Sweep sweep);
  bool DropLate();
  void DropWaiting();
  bool Quarantine(Sweep& sweep);

  Counters* counters_;
  std::deque<std::shared_ptr<Sweep>> waiting_;
  std::optional<Timestamp> last_end_;  // the end of the newest sweep that was let in
  int num_late_in_a_row_ = 0;
  std::optional<Sweep> suspect_;            // far ahead of all others
  std::optional<Timestamp> last_imu_;       // newest inertial stamp, and where the lidar ...
  std::optional<Timestamp> imu_silent_at_;  // ... was when it came
};

}  // namespace lio
