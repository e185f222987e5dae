// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The output thread: it writes the files and sends the clouds and the status, because these may
// wait for a disk or a socket and the filter must not. At most kMaxRows rows wait, in order; when
// more come, the newest are dropped and counted. Only the newest cloud of each kind waits. After a
// fault the rows are kept for WriteRowsLeft.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <variant>

#include "app/feature_clouds.hpp"
#include "app/full_cloud.hpp"
#include "app/publisher.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/io/worker_thread.hpp"

namespace lio {

class OutputWorker {
 public:
  static constexpr std::size_t kMaxRows = 20'000;  // 20 MB, some ten seconds of 1 kHz

  // `publisher` and `writer` are borrowed; `writer` is null without files. `compose` gives the
  // status, on the output thread. `on_fault` is called when any of them has thrown, and
  // `on_write_failure` once, on the output thread, when a file cannot be written, e.g. on a full
  // disk: a status follows at once, and the rows from there on are dropped and counted.
  OutputWorker(
      Publisher& publisher, RunWriter* writer, std::string version,
      std::function<StatusReport()> compose, OnFault on_fault,
      OnFault on_write_failure = [](const std::string&) {});
  ~OutputWorker();  // as Finish
  OutputWorker(const OutputWorker&) = delete;
  OutputWorker& operator=(const OutputWorker&) = delete;

  // Does work on the files between the rows before and after it. It is given the writer, which is
  // null where there are no files, and returns the one of the rows that follow. It must not throw.
  using FileTask = std::function<RunWriter*(RunWriter*)>;

  void PutRow(Output row);
  void Put(FileTask task);
  void Put(RegisteredCloud cloud);
  void Put(FullCloudTask cloud);
  void Put(FeatureCloudTask features);
  void AnnounceStatus();  // sends the status now, not at the next second
  // Writes and sends what is there, and a last status; then ends.
  void Finish();
  // After Finish: writes the rows that a fault of the thread has left.
  void WriteRowsLeft();

  [[nodiscard]] std::int64_t num_rows_dropped() const { return num_rows_dropped_; }

 private:
  struct Tasks {
    std::deque<std::variant<Output, FileTask>> rows;
    std::optional<RegisteredCloud> cloud;
    std::optional<FullCloudTask> full_cloud;
    std::optional<FeatureCloudTask> features;
    bool status = false;

    [[nodiscard]] bool empty() const {
      return rows.empty() && !cloud && !full_cloud && !features && !status;
    }
  };

  void Run();
  void Do(Tasks& tasks);
  void WriteRows(Tasks& tasks);
  void Write(std::variant<Output, FileTask>& row);
  void TellFailure(Tasks& tasks);
  void PublishFull(const FullCloudTask& task);
  void PublishFeatures(const FeatureCloudTask& task);

  Publisher& publisher_;
  const bool keeps_rows_;  // there are files
  RunWriter* writer_;      // used by the output thread only
  std::string version_;
  std::function<StatusReport()> compose_;
  OnFault on_write_failure_;
  bool has_told_failure_ = false;  // used by the output thread only
  std::atomic<std::int64_t> num_rows_dropped_ = 0;

  std::mutex mutex_;  // guards tasks_ and is_finishing_
  std::condition_variable put_;
  Tasks tasks_;
  bool is_finishing_ = false;
  WorkerThread thread_;
};

}  // namespace lio
