// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The match thread: runs one job at a time and grows the map, in the order it is told. After a
// fault it does nothing any more: no outcome comes, and what it is told is left undone.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

#include "lio/io/map_cloud.hpp"
#include "lio/io/worker_thread.hpp"
#include "lio/pipeline/initial_map.hpp"
#include "lio/pipeline/registration_worker.hpp"

namespace lio {

class MatchWorker {
 public:
  // `deliver` is called on the match thread with each job's outcome, `on_fault` when a job, an
  // insertion or `deliver` has thrown.
  // `initial_map` may be null.
  MatchWorker(const Options& options, ClockNs clock, bool collects_map,
              const InitialMapPtr& initial_map, std::function<void(MatchOutcome)> deliver,
              OnFault on_fault);
  ~MatchWorker();  // as Finish
  MatchWorker(const MatchWorker&) = delete;
  MatchWorker& operator=(const MatchWorker&) = delete;

  // At most one job and the insertion before it are waiting: so Odometry hands them out.
  void Tell(MatchJob job);
  void Tell(InsertTask insert);
  // Copies the points of the map, as they are after what was told before; `take` is called on the
  // match thread.
  using TakeMap = std::function<void(std::vector<Eigen::Vector3f>)>;
  void Tell(TakeMap take);
  // Forgets the map and all that was learned with it, after what was told before.
  void Forget();
  // Does what it was told, then ends the thread.
  void Finish();

  [[nodiscard]] std::size_t map_bytes() const { return map_bytes_; }
  // Returns the points of map.pcd; only after Finish.
  [[nodiscard]] const MapCloud& map_cloud() const { return map_cloud_; }
  // Returns what was found of the lidar's beams; only after Finish.
  [[nodiscard]] std::optional<LidarBeams> FoundBeams() const {
    return worker_ ? worker_->FoundBeams() : std::nullopt;
  }

 private:
  struct Forgetting {};
  using Work = std::variant<MatchJob, InsertTask, TakeMap, Forgetting>;

  void Run();
  void Do(const MatchJob& job);
  void Do(const InsertTask& insert);
  void Do(const TakeMap& take) { take(map_cloud_.points_map()); }

  void Do(Forgetting) { Begin(); }
  void Begin();

  const Options options_;
  const ClockNs clock_;
  const InitialMapPtr initial_map_;  // null: none
  std::optional<RegistrationWorker> worker_;
  MapCloud map_cloud_;
  bool collects_map_;
  std::function<void(MatchOutcome)> deliver_;
  std::atomic<std::size_t> map_bytes_ = 0;

  std::mutex mutex_;  // guards work_ and is_finishing_
  std::condition_variable told_;
  std::deque<Work> work_;
  bool is_finishing_ = false;
  WorkerThread thread_;
};

}  // namespace lio
