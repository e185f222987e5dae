// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/match_worker.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "lio/io/beam_table.hpp"

namespace lio {

MatchWorker::MatchWorker(const Options& options, ClockNs clock, bool collects_map,
                         const InitialMapPtr& initial_map,
                         std::function<void(MatchOutcome)> deliver, OnFault on_fault)
    : options_(options),
      clock_(clock),
      initial_map_(initial_map),
      collects_map_(collects_map),
      deliver_(std::move(deliver)),
      thread_("match", std::move(on_fault), Urgency::kSoon) {
  thread_.Start([this] {
    Begin();  // here, since threads that it starts for matching inherit this one's priority
    Run();
  });
}

void MatchWorker::Begin() {
  worker_.emplace(options_, clock_, BeamElevations(options_.rig.lidar.model), initial_map_);
  map_cloud_ = MapCloud();
  if (collects_map_ && initial_map_) map_cloud_.AddSaved(initial_map_->points);
}

MatchWorker::~MatchWorker() {
  Finish();
}

void MatchWorker::Finish() {
  {
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
    told_.notify_one();
  }
  thread_.Join();
}

void MatchWorker::Tell(MatchJob job) {
  const std::lock_guard lock(mutex_);
  work_.emplace_back(std::move(job));
  told_.notify_one();
}

void MatchWorker::Tell(InsertTask insert) {
  const std::lock_guard lock(mutex_);
  work_.emplace_back(std::move(insert));
  told_.notify_one();
}

void MatchWorker::Tell(TakeMap take) {
  const std::lock_guard lock(mutex_);
  work_.emplace_back(std::move(take));
  told_.notify_one();
}

void MatchWorker::Forget() {
  const std::lock_guard lock(mutex_);
  work_.emplace_back(Forgetting{});
  told_.notify_one();
}

void MatchWorker::Run() {
  for (;;) {
    std::unique_lock lock(mutex_);
    told_.wait(lock, [this] { return !work_.empty() || is_finishing_; });
    if (work_.empty()) return;
    const Work work = std::move(work_.front());
    work_.pop_front();
    lock.unlock();
    std::visit([this](const auto& task) { Do(task); }, work);
  }
}

void MatchWorker::Do(const MatchJob& job) {
  if (job.map_action == MapAction::kClear && !initial_map_) map_cloud_.Clear();
  deliver_(worker_->Run(job));
}

void MatchWorker::Do(const InsertTask& insert) {
  worker_->Insert(insert);
  const bool grows_map = insert.T_map_imu && worker_->is_in_map();
  if (collects_map_ && grows_map) {
    const double voxel_m = map_cloud_.voxel_m();
    map_cloud_.Add(insert.points_imu, *insert.T_map_imu);
    if (map_cloud_.voxel_m() > voxel_m) spdlog::warn("{}", map_cloud_.thinned());
  }
  map_bytes_ = worker_->matcher().map_size().memory_bytes;
}

}  // namespace lio
