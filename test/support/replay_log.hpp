// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator over a log, step by step, into files, with which live runs are compared.
#pragma once

#include <filesystem>

#include "lio/io/cpu_clock.hpp"
#include "lio/io/log_input.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/pipeline/registration_worker.hpp"

namespace lio::test {

struct Replayed {
  Counters counters;
  std::int64_t num_matches = 0;  // until the log's end; later matches are not counted
};

inline Replayed ReplayLog(const std::filesystem::path& log, const Options& options,
                          const std::filesystem::path& out) {
  LogInput input(log, LogInputOptions());
  RunWriter writer(out, options);
  Odometry odometry(options, ThreadCpuNs);
  RegistrationWorker worker(options, ThreadCpuNs);
  std::int64_t num_matches = 0;
  const auto match = [&] {
    for (; const auto job = odometry.NextJob(); ++num_matches) {
      worker.Insert(odometry.FinishJob(worker.Run(*job)));
    }
    for (const Output& output : odometry.TakeOutputs()) writer.Write(output);
  };
  while (auto item = input.Next()) {
    if (const auto* sample = std::get_if<ImuSample>(&item->data)) {
      odometry.AddImu(*sample);
    } else {
      odometry.AddChunk(std::get<ScanChunk>(std::move(item->data)));
    }
    match();
  }
  const std::int64_t num_before_end = num_matches;
  odometry.Flush();
  match();
  writer.Finish({});
  return {odometry.counters(), num_before_end};
}

}  // namespace lio::test
