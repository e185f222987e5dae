// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/live_runner.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/socket_buffer.hpp"

namespace lio {
namespace {

// Messages come meanwhile: those that the estimator has not seen wait.
Account AccountSoFar(const Ledgers& ledgers, const InputCounters& input,
                     const FilterInbox::Losses& losses) {
  const auto in_transit = [](std::int64_t taken, std::int64_t dropped, std::int64_t seen) {
    return TransitCounters{.num_dropped = dropped, .num_waiting = taken - dropped - seen};
  };
  return {ledgers, in_transit(input.num_imu_taken, losses.num_imu, ledgers.samples.num_received),
          in_transit(input.num_chunks_taken, losses.num_chunks, ledgers.chunks.num_received)};
}

}  // namespace

LiveRunner::LiveRunner(Bus& bus, const Options& options, const LiveOptions& live)
    : live_(live),
      bus_(bus),
      start_utime_(HostUtime()),
      publisher_(bus, live_.channels),
      board_(PrintOptions(options), live.receive_buffer_bytes, options.rig.lidar.clock_offset_s),
      others_(board_.start_utime()),
      watch_({live_.channels.imu, live_.channels.scan, live_.channels.status,
              EffectiveUrl(live.lcm_url), options.pipeline.use_imu},
             InputWatch::Clock::now()),
      match_worker_(
          options, live.match_clock, live.writes_map, live.initial_map,
          [this](MatchOutcome outcome) { inbox_.Put(std::move(outcome)); },
          [this](const std::string& fault) {
            OnFault(fault);
            inbox_.EndOutcomes();
          }),
      output_worker_(
          publisher_, OpenFiles(options), live.version, [this] { return ComposeStatus(); },
          [this](const std::string& fault) { OnFault(fault); },
          [this](const std::string& failure) { OnWriteFailure(failure); }),
      filter_(options, live.start_in(), live.publishes_full_cloud,
              {inbox_, publisher_, board_, match_worker_, output_worker_,
               [this](const Request& request) { desk_.Obey(request); }, live_.answer_ping}),
      desk_(
          {publisher_, board_, match_worker_, output_worker_, filter_},
          {files_ ? &*files_ : nullptr, live_.writes_map, live_.initial_map != nullptr,
           live_.inputs},
          [this] { return JudgedStats(); },
          [this](const std::string& failure) { OnWriteFailure(failure); }),
      receiver_(
          bus, live_.channels, ThreadCpuNs, inbox_, board_, others_,
          [this](const Command& command, const std::string& why) { desk_.Refuse(command, why); }),
      filter_thread_("filter", [this](const std::string& fault) { OnFault(fault); }),
      receive_thread_("receive", [this](const std::string& fault) { OnFault(fault); }) {
  filter_thread_.Start([this] { filter_.Run(); });
  try {
    receive_thread_.Start([this] { receiver_.Run(); });
  } catch (const std::exception&) {
    EndThreads();  // the destructor will not run
    throw;
  }
}

LiveRunner::~LiveRunner() {
  EndThreads();
}

RunWriter* LiveRunner::OpenFiles(const Options& options) {
  if (!live_.out) return nullptr;
  const auto& wanted = live_.next_out.empty() ? *live_.out : live_.next_out;
  return files_.emplace(RunSeries::Folders{*live_.out, wanted}, options, live_.start_in()).writer();
}

void LiveRunner::OnFault(const std::string& fault) {
  faults_.Set(fault);
  board_.SetNote(fault);
}

void LiveRunner::OnWriteFailure(const std::string& failure) {
  spdlog::error("{}; the files end here, the messages go on", failure);
  board_.SetAlarm(failure);
}

void LiveRunner::EndThreads() {
  receiver_.Stop();
  receive_thread_.Join();
  inbox_.Close();
  if (!filter_thread_.EndsWithin(live_.max_finish)) filter_.CutShort();
  filter_thread_.Join();
  has_account_ended_ = true;
  match_worker_.Finish();
  output_worker_.Finish();
}

void LiveRunner::Stop() {
  EndThreads();
  const Counters& counters = filter_.counters();
  if (counters.num_imu + counters.num_chunks > 0) verdict_ = filter_.Judge();
  if (!files_) return;
  // This is after a fault of the output thread; otherwise none are left.
  if (const auto fault =
          RunCatching("writing the last rows", [this] { output_worker_.WriteRowsLeft(); })) {
    OnFault(*fault);
  }
  if (live_.writes_map && files_->writer() != nullptr) {
    files_->writer()->WriteMap(match_worker_.map_cloud().points_map());
  }
  RunStats stats = Stats();
  stats.beams = match_worker_.FoundBeams();
  if (const std::string why = WhyOpen(stats.account, stats.input); !why.empty()) {
    spdlog::warn("{}; please report this", why);
  }
  files_->Finish(stats);
  if (files_->failure()) throw WriteError(*files_->failure());
}

void LiveRunner::RenewFiles() {
  const Request request{.command = {.action = CommandAction::kNewFiles}, .is_answered = false};
  if (!inbox_.Put(request)) spdlog::warn("signal: refused, too many commands wait already");
}

Account LiveRunner::AccountAtEnd() const {
  const FilterInbox::Losses losses = inbox_.losses();
  const FilterInbox::Losses waiting = inbox_.waiting();
  const FilterInbox::Losses& given_up = filter_.given_up();
  return {filter_.ledgers(),
          {losses.num_imu, given_up.num_imu, waiting.num_imu},
          {losses.num_chunks, given_up.num_chunks, waiting.num_chunks}};
}

StatusReport LiveRunner::ComposeStatus() {
  // This comes first, so that no message counts as dropped before it counts as taken.
  const FilterInbox::Losses losses = inbox_.losses();
  StatusReport report = board_.Compose();
  report.account =
      AccountPages(has_account_ended_ ? AccountAtEnd()
                                      : AccountSoFar(report.counters.ledgers, report.input, losses),
                   report.input);
  report.num_imu_queue_dropped = losses.num_imu;
  report.num_chunk_queue_dropped = losses.num_chunks;
  if (live_.socket) report.num_kernel_dropped = KernelDrops(*live_.socket).value_or(-1);
  report.num_publish_failed = publisher_.num_failed();
  report.num_outputs_dropped = output_worker_.num_rows_dropped();
  report.num_handler_faults = bus_.num_handler_faults();
  report.map_mb = static_cast<float>(match_worker_.map_bytes()) * 1e-6F;
  WatchInput(report);
  return report;
}

void LiveRunner::WatchInput(StatusReport& report) {
  for (const InputRemark& remark : watch_.Look(report, others_.heard(), InputWatch::Clock::now())) {
    spdlog::log(remark.is_fault ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
  }
  const std::string standing = watch_.standing();
  if (standing.empty()) return;
  report.note = report.note.empty() ? standing : standing + " | " + report.note;
}

RunStats LiveRunner::JudgedStats() const {
  const FilterInbox::Losses losses = inbox_.losses();
  RunStats stats = Stats();
  stats.account = AccountSoFar(stats.account.ledgers, stats.input, losses);
  if (stats.counters.num_imu + stats.counters.num_chunks > 0) stats.verdict = filter_.Judge();
  return stats;
}

RunStats LiveRunner::Stats() const {
  const FilterInbox::Losses losses = inbox_.losses();
  RunStats stats;
  if (verdict_) stats.verdict = *verdict_;
  stats.counters = filter_.counters();
  stats.account = AccountAtEnd();
  stats.input = board_.input();
  stats.extra = {{"num_imu_queue_dropped", losses.num_imu},
                 {"num_chunks_queue_dropped", losses.num_chunks},
                 {"num_kernel_dropped",
                  live_.socket ? KernelDrops(*live_.socket).value_or(-1) : std::int64_t{-1}},
                 {"num_publish_failed", publisher_.num_failed()},
                 {"num_outputs_dropped", output_worker_.num_rows_dropped()},
                 {"num_handler_faults", bus_.num_handler_faults()},
                 {"num_shutdowns_cut_short", filter_.is_cut_short() ? 1 : 0}};
  stats.log_duration_s = filter_.input_duration_s();
  stats.wall_s = static_cast<double>(HostUtime() - start_utime_) * 1e-6;
  return stats;
}

}  // namespace lio
