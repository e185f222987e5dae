// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the files of --out. They go on in a new folder when they are asked to: the run in the old
// one is completed, with its stats and verdict. It serves one thread at a time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lio/io/run_writer.hpp"

namespace lio {

class RunSeries {
 public:
  struct Folders {
    std::filesystem::path first;   // takes the first run; earlier files in it are replaced
    std::filesystem::path wanted;  // the next ones are numbered after this
  };

  // Throws std::runtime_error when files cannot be created.
  RunSeries(const Folders& folders, const Options& options, StartIn start_in);

  // Returns null when the last Renew could not make files.
  [[nodiscard]] RunWriter* writer() { return writer_ ? &*writer_ : nullptr; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // Says what was not written in full in any of the folders, first things first.
  [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }

  // Completes the files and begins the next ones. Counts and times of `stats` are since the start
  // of the daemon; what is written is for the time since the folder was begun.
  void Renew(const RunStats& stats);
  void Finish(const RunStats& stats);

 private:
  template <typename Action>
  void Try(Action&& action);

  Folders folders_;
  Options options_;
  StartIn start_in_;
  std::filesystem::path folder_;
  std::optional<RunWriter> writer_;
  RunStats at_begin_;  // when the folder was begun
  std::optional<std::string> failure_;
};

// Gives what was counted between the two; both have the same extra counts. The verdict is that of
// `end`.
[[nodiscard]] RunStats Between(const RunStats& begin, const RunStats& end);

}  // namespace lio
