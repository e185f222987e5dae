// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/run_series.hpp"

#include <stdexcept>

#include "lio/base/counters_fields.hpp"
#include "lio/io/run_folder.hpp"

namespace lio {

RunStats Between(const RunStats& begin, const RunStats& end) {
  RunStats span = end;
  for (const CounterField& field : kCounterFields) {
    span.counters.*field.count -= begin.counters.*field.count;
  }
  for (std::size_t i = 0; i < span.input.num_refused.size(); ++i) {
    span.input.num_refused[i] -= begin.input.num_refused[i];
    span.input.num_imu_refused[i] -= begin.input.num_imu_refused[i];
    span.input.num_chunks_refused[i] -= begin.input.num_chunks_refused[i];
  }
  span.account.ledgers -= begin.account.ledgers;
  span.account.imu -= begin.account.imu;
  span.account.chunks -= begin.account.chunks;
  span.input.num_imu_received -= begin.input.num_imu_received;
  span.input.num_imu_taken -= begin.input.num_imu_taken;
  span.input.num_chunks_received -= begin.input.num_chunks_received;
  span.input.num_chunks_taken -= begin.input.num_chunks_taken;
  span.input.num_imu_missing -= begin.input.num_imu_missing;
  for (std::size_t i = 0; i < span.extra.size() && i < begin.extra.size(); ++i) {
    span.extra[i].second -= begin.extra[i].second;
  }
  span.log_duration_s -= begin.log_duration_s;
  span.wall_s -= begin.wall_s;
  return span;
}

RunSeries::RunSeries(const Folders& folders, const Options& options, StartIn start_in)
    : folders_(folders), options_(options), start_in_(start_in), folder_(folders.first) {
  writer_.emplace(folder_, options_, start_in_);
}

template <typename Action>
void RunSeries::Try(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    if (!failure_) failure_ = error.what();
  }
}

void RunSeries::Finish(const RunStats& stats) {
  if (!writer_) return;
  Try([&] { writer_->Finish(Between(at_begin_, stats)); });
}

void RunSeries::Renew(const RunStats& stats) {
  Finish(stats);
  writer_.reset();
  at_begin_ = stats;
  Try([&] {
    folder_ = MakeFreeFolder(folders_.wanted);
    writer_.emplace(folder_, options_, start_in_);
  });
}

}  // namespace lio
