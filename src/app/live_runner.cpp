// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/live_runner.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "lio/io/cpu_clock.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/socket_buffer.hpp"

namespace lio {
namespace {

constexpr double kCloudInterval_s = 0.5;   // of LIO_CLOUD, in sensor time
constexpr double kRepeatedNotice_s = 5.0;  // the same words are not logged again before
constexpr std::chrono::milliseconds kMaxFinish(400);

// Every n-th point, so many that at most `max_points` are left, in the map's frame.
std::vector<Eigen::Vector3f> Decimate(const std::vector<Eigen::Vector3f>& points_imu,
                                      const Pose& T_map_imu, std::size_t max_points) {
  const std::size_t step = (points_imu.size() + max_points - 1) / max_points;
  const Eigen::Matrix3f rotation = T_map_imu.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = T_map_imu.translation.cast<float>();
  std::vector<Eigen::Vector3f> points_map;
  for (std::size_t i = 0; i < points_imu.size(); i += step) {
    points_map.push_back(rotation * points_imu[i] + translation);
  }
  return points_map;
}

}  // namespace

LiveRunner::LiveRunner(Bus& bus, const Options& options, const LiveOptions& live)
    : live_(live),
      publishes_features_(options.pipeline.publish_features),
      bus_(bus),
      publisher_(bus, live_.channels),
      board_(Fnv1a(PrintOptions(options)), live.receive_buffer_bytes),
      odometry_(options, ThreadCpuNs),
      publishes_full_cloud_(live.publishes_full_cloud),
      start_utime_(HostUtime()),
      match_worker_(options, ThreadCpuNs, live.writes_map,
                    [this](MatchOutcome outcome) { inbox_.Put(std::move(outcome)); }),
      output_worker_(publisher_, live.out ? &writer_.emplace(*live.out, options) : nullptr,
                     options.rig.T_imu_lidar.value_or(Pose::Identity()), live.version,
                     [this] { return ComposeStatus(); }),
      receiver_(bus, live_.channels, ThreadCpuNs, inbox_, board_,
                [this](const Command& command) { Obey(command); }),
      filter_thread_([this] { Filter(); }),
      receive_thread_([this] { receiver_.Run(); }) {}

LiveRunner::~LiveRunner() {
  EndThreads();
}

void LiveRunner::EndThreads() {
  receiver_.Stop();
  if (receive_thread_.joinable()) receive_thread_.join();
  inbox_.Close();
  if (filter_thread_.joinable()) {
    const bool is_done =
        filter_done_.get_future().wait_for(kMaxFinish) == std::future_status::ready;
    is_hurrying_ = !is_done;
    filter_thread_.join();
  }
  match_worker_.Finish();
  output_worker_.Finish();
}

void LiveRunner::Stop() {
  EndThreads();
  if (!writer_) return;
  if (live_.writes_map) writer_->WriteMap(match_worker_.map_cloud().points_map());
  writer_->Finish(Stats());
}

void LiveRunner::Filter() {
  while (const std::unique_ptr<InboxItem> item = inbox_.Take()) {
    if (is_hurrying_ && !std::holds_alternative<MatchOutcome>(*item)) continue;
    std::visit([this](auto& content) { Handle(content); }, *item);
    Emit();
  }
  odometry_.Flush();
  HandOutJob();
  while (has_job_out_) {
    MatchOutcome outcome = inbox_.TakeOutcome();
    Handle(outcome);
    Emit();
  }
  Emit();
  filter_done_.set_value();
}

void LiveRunner::Handle(Arrival<ImuSample>& arrival) {
  // The work of decoding inertial samples belongs to the scan they come with.
  decode_ns_ += arrival.decode_ns;
  newest_stamp_ = std::max(newest_stamp_, arrival.data.stamp);
  if (first_utime_ == 0) first_utime_ = arrival.recv_utime;
  last_utime_ = arrival.recv_utime;
  odometry_.AddImu(arrival.data);
  HandOutJob();
}

void LiveRunner::Handle(Arrival<ScanChunk>& arrival) {
  if (first_utime_ == 0) first_utime_ = arrival.recv_utime;
  last_utime_ = arrival.recv_utime;
  TimingOf(arrival.data.scan_seq).arrived_utime = arrival.recv_utime;
  newest_stamp_ = std::max(newest_stamp_, arrival.data.stamp);
  odometry_.AddChunk(std::move(arrival.data), std::exchange(decode_ns_, 0) + arrival.decode_ns);
  odometry_.ShedLoad();
  HandOutJob();
}

void LiveRunner::Handle(MatchOutcome& outcome) {
  has_job_out_ = false;
  T_map_points_ = outcome.match.T_map_imu;
  if (publishes_features_ && outcome.features) {
    output_worker_.Put(FeatureCloudTask{outcome.sweep, outcome.features});
  }
  InsertTask insert = odometry_.FinishJob(std::move(outcome));
  if (insert.T_map_imu) T_map_points_ = *insert.T_map_imu;
  points_imu_ = insert.points_imu;
  match_worker_.Tell(std::move(insert));
  ++num_matches_done_;
  Emit();
  HandOutJob();
}

void LiveRunner::HandOutJob() {
  if (has_job_out_ || is_hurrying_) return;
  std::optional<MatchJob> job = odometry_.NextJob();
  if (!job) return;
  has_job_out_ = true;
  TimingOf(job->sweep->scan_seq).started_utime = HostUtime();
  full_cloud_ = {};
  if (publishes_full_cloud_) full_cloud_ = {job->sweep, job->T_any_imu, {}};
  match_worker_.Tell(std::move(*job));
}

LiveRunner::ScanTiming& LiveRunner::TimingOf(std::int32_t scan_seq) {
  ScanTiming& timing = timings_[static_cast<std::uint32_t>(scan_seq) % timings_.size()];
  if (timing.scan_seq != scan_seq) timing = {scan_seq, 0, 0};
  return timing;
}

void LiveRunner::Emit() {
  for (Output& output : odometry_.TakeOutputs()) {
    publisher_.Publish(output);
    if (const auto* scan = std::get_if<ScanOutput>(&output)) Emit(*scan);
    if (const auto* notice = std::get_if<Notice>(&output)) Emit(*notice);
    output_worker_.PutRow(std::move(output));
  }
  board_.SetEstimator(odometry_.counters(), odometry_.status(), newest_stamp_);
  if (odometry_.status() != announced_) {
    announced_ = odometry_.status();
    output_worker_.AnnounceStatus();
  }
}

void LiveRunner::Emit(const ScanOutput& output) {
  const auto scan_seq = static_cast<std::int32_t>(output.scan.scan_seq);
  const ScanTiming& timing = TimingOf(scan_seq);
  if (timing.arrived_utime != 0 && timing.started_utime != 0) {
    const auto ms = [](std::int64_t us) { return static_cast<double>(us) * 1e-3; };
    board_.AddLatency(ms(timing.started_utime - timing.arrived_utime),
                      ms(HostUtime() - timing.started_utime));
  }
  if (!output.filter) return;
  const NavOutput& nav = output.filter->nav;
  if (full_cloud_.sweep && full_cloud_.sweep->scan_seq == scan_seq) {
    full_cloud_.T_map_imu = T_map_points_;
    output_worker_.Put(std::exchange(full_cloud_, {}));
  }
  if (last_cloud_ && std::abs(SecondsBetween(*last_cloud_, nav.stamp)) < kCloudInterval_s) return;
  last_cloud_ = nav.stamp;
  output_worker_.Put(RegisteredCloud{
      nav.stamp, scan_seq, Decimate(points_imu_, T_map_points_, Publisher::kMaxCloudPoints)});
}

void LiveRunner::Emit(const Notice& notice) {
  board_.SetNote(notice.text);
  const double since_s = std::abs(SecondsBetween(last_notice_stamp_, notice.stamp));
  if (notice.text == last_notice_ && since_s < kRepeatedNotice_s) return;
  last_notice_ = notice.text;
  last_notice_stamp_ = notice.stamp;
  constexpr std::array kLevels{spdlog::level::info, spdlog::level::warn, spdlog::level::err};
  spdlog::log(kLevels[static_cast<std::size_t>(notice.severity)], "{:.3f}: {}",
              static_cast<double>(notice.stamp.ns) * 1e-9, notice.text);
}

void LiveRunner::Obey(const Command& command) {
  publishes_full_cloud_ = command.action == CommandAction::kCloudFullOn;
  spdlog::info("command {}: LIO_CLOUD_FULL {}", command.request_id,
               publishes_full_cloud_ ? "on" : "off");
}

StatusReport LiveRunner::ComposeStatus() {
  StatusReport report = board_.Compose();
  const FilterInbox::Losses losses = inbox_.losses();
  report.num_imu_queue_dropped = losses.num_imu;
  report.num_chunk_queue_dropped = losses.num_chunks;
  if (live_.socket) report.num_kernel_dropped = KernelDrops(*live_.socket).value_or(-1);
  report.num_publish_failed = publisher_.num_failed();
  report.num_outputs_dropped = output_worker_.num_rows_dropped();
  report.num_handler_faults = bus_.num_handler_faults();
  report.map_mb = static_cast<float>(match_worker_.map_bytes()) * 1e-6F;
  return report;
}

RunStats LiveRunner::Stats() const {
  const FilterInbox::Losses losses = inbox_.losses();
  RunStats stats;
  stats.counters = odometry_.counters();
  stats.input = board_.input();
  stats.extra = {{"num_imu_queue_dropped", losses.num_imu},
                 {"num_chunks_queue_dropped", losses.num_chunks},
                 {"num_kernel_dropped",
                  live_.socket ? KernelDrops(*live_.socket).value_or(-1) : std::int64_t{-1}},
                 {"num_publish_failed", publisher_.num_failed()},
                 {"num_outputs_dropped", output_worker_.num_rows_dropped()},
                 {"num_handler_faults", bus_.num_handler_faults()},
                 {"num_shutdowns_cut_short", is_hurrying_ ? 1 : 0}};
  stats.log_duration_s = static_cast<double>(last_utime_ - first_utime_) * 1e-6;
  stats.wall_s = static_cast<double>(HostUtime() - start_utime_) * 1e-6;
  return stats;
}

}  // namespace lio
