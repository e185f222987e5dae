// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/output_worker.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace lio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kStatusInterval(1);
constexpr std::size_t kRowsPerWaking = 50;  // half a second of 100 Hz
// Pauses between the chunks of a full cloud: a burst overruns receivers with stock buffers.
constexpr std::chrono::milliseconds kChunkPause(1);

}  // namespace

OutputWorker::OutputWorker(Publisher& publisher, RunWriter* writer, std::string version,
                           std::function<StatusReport()> compose, OnFault on_fault,
                           OnFault on_write_failure)
    : publisher_(publisher),
      keeps_rows_(writer != nullptr),
      writer_(writer),
      version_(std::move(version)),
      compose_(std::move(compose)),
      on_write_failure_(std::move(on_write_failure)),
      thread_("output", std::move(on_fault), Urgency::kSoon) {
  thread_.Start([this] { Run(); });
}

OutputWorker::~OutputWorker() {
  Finish();
}

void OutputWorker::Finish() {
  {
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
    put_.notify_one();
  }
  thread_.Join();
}

void OutputWorker::WriteRowsLeft() {
  for (auto& row : tasks_.rows) Write(row);
  tasks_.rows.clear();
}

void OutputWorker::PutRow(Output row) {
  if (!keeps_rows_) return;
  const std::lock_guard lock(mutex_);
  if (tasks_.rows.size() >= kMaxRows) {
    ++num_rows_dropped_;
    return;
  }
  // Rows at the IMU's rate wait for more of them, for a scan's or for the next status: each waking
  // takes time from others.
  const bool is_frequent = std::holds_alternative<NavOutput>(row);
  tasks_.rows.emplace_back(std::move(row));
  if (!is_frequent || tasks_.rows.size() % kRowsPerWaking == 0) put_.notify_one();
}

void OutputWorker::Put(FileTask task) {
  const std::lock_guard lock(mutex_);
  tasks_.rows.emplace_back(std::move(task));
  put_.notify_one();
}

void OutputWorker::Put(RegisteredCloud cloud) {
  const std::lock_guard lock(mutex_);
  tasks_.cloud = std::move(cloud);
  put_.notify_one();
}

void OutputWorker::Put(FullCloudTask cloud) {
  const std::lock_guard lock(mutex_);
  tasks_.full_cloud = std::move(cloud);
  put_.notify_one();
}

void OutputWorker::Put(FeatureCloudTask features) {
  const std::lock_guard lock(mutex_);
  tasks_.features = std::move(features);
  put_.notify_one();
}

void OutputWorker::AnnounceStatus() {
  const std::lock_guard lock(mutex_);
  tasks_.status = true;
  put_.notify_one();
}

void OutputWorker::Run() {
  auto next_status = Clock::now();
  for (bool is_last = false; !is_last;) {
    Tasks tasks;
    {
      std::unique_lock lock(mutex_);
      put_.wait_until(lock, next_status, [this] { return !tasks_.empty() || is_finishing_; });
      tasks = std::exchange(tasks_, {});
      is_last = is_finishing_;
    }
    tasks.status = tasks.status || is_last || Clock::now() >= next_status;
    if (tasks.status) next_status = Clock::now() + kStatusInterval;
    Do(tasks);
  }
}

void OutputWorker::Do(Tasks& tasks) {
  WriteRows(tasks);
  if (tasks.cloud) publisher_.Publish(*tasks.cloud);
  if (tasks.full_cloud) PublishFull(*tasks.full_cloud);
  if (tasks.features) PublishFeatures(*tasks.features);
  if (tasks.status) publisher_.Publish(compose_(), version_);
}

void OutputWorker::WriteRows(Tasks& tasks) {
  for (auto& row : tasks.rows) {
    const bool is_file_task = std::holds_alternative<FileTask>(row);
    if (is_file_task) TellFailure(tasks);
    Write(row);
    if (is_file_task) has_told_failure_ = false;
  }
  if (writer_ == nullptr) return;
  if (tasks.status) writer_->Flush();  // no row may come for a while
  TellFailure(tasks);
}

void OutputWorker::Write(std::variant<Output, FileTask>& row) {
  if (const auto* task = std::get_if<FileTask>(&row)) {
    writer_ = (*task)(writer_);
    return;
  }
  if (writer_ == nullptr || writer_->failure()) ++num_rows_dropped_;
  if (writer_ != nullptr) writer_->Write(std::get<Output>(row));
}

void OutputWorker::TellFailure(Tasks& tasks) {
  if (writer_ == nullptr || !writer_->failure() || has_told_failure_) return;
  has_told_failure_ = true;
  on_write_failure_(*writer_->failure());
  tasks.status = true;
}

void OutputWorker::PublishFull(const FullCloudTask& task) {
  for (const ScanChunk& chunk : RegisterFullCloud(task)) {
    publisher_.PublishFull(chunk);
    std::this_thread::sleep_for(kChunkPause);
  }
}

void OutputWorker::PublishFeatures(const FeatureCloudTask& task) {
  for (std::size_t i = 0; i < kNumFeatureSets; ++i) {
    const auto set = static_cast<FeatureSet>(i);
    for (const ScanChunk& chunk : FeatureCloud(task, set)) {
      publisher_.PublishFeatures(set, chunk);
      std::this_thread::sleep_for(kChunkPause);
    }
  }
}

}  // namespace lio
