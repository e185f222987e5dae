// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/filter_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/io/cpu_clock.hpp"

namespace lio {
namespace {

constexpr double kCloudInterval_s = 0.5;  // between two LIO_CLOUD, in sensor time
constexpr std::size_t kFirstOther = 2;  // index in InboxItem: those before are messages of sensors

// Returns every n-th point in the map's frame, with n such that at most `max_points` are left.
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

FilterLoop::FilterLoop(const Options& options, StartIn start_in, bool publishes_full_cloud,
                       const Neighbours& neighbours)
    : to_(neighbours),
      odometry_(options, ThreadCpuNs, start_in),
      lidar_check_(options),
      publishes_features_(options.pipeline.publish_features),
      publishes_full_cloud_(publishes_full_cloud) {}

Verdict FilterLoop::Judge() const {
  Verdict verdict = odometry_.Judge();
  lidar_check_.AddTo(verdict);
  return verdict;
}

double FilterLoop::input_duration_s() const {
  return static_cast<double>(last_utime_ - first_utime_) * 1e-6;
}

void FilterLoop::Run() {
  while (const std::unique_ptr<InboxItem> item = to_.inbox.Take()) {
    const bool is_message = item->index() < kFirstOther;
    if (is_cut_short_ && is_message) {
      const bool is_chunk = std::holds_alternative<Arrival<ScanChunk>>(*item);
      ++(is_chunk ? given_up_.num_chunks : given_up_.num_imu);
      continue;
    }
    std::visit([this](auto& content) { Handle(content); }, *item);
    GoOn();
  }
  odometry_.Flush();
  GoOn();
  while (has_job_out_) {
    std::optional<MatchOutcome> outcome = to_.inbox.TakeOutcome();
    if (!outcome) break;
    Handle(*outcome);
    GoOn();
  }
}

// Gives what there is first, because subscribers wait for it. A job brings no outputs of its own.
void FilterLoop::GoOn() {
  Emit();
  HandOutJob();
}

void FilterLoop::NoteArrival(std::int64_t recv_utime, Timestamp stamp) {
  if (first_utime_ == 0) first_utime_ = recv_utime;
  last_utime_ = recv_utime;
  newest_stamp_ = std::max(newest_stamp_, stamp);
}

void FilterLoop::Handle(Arrival<ImuSample>& arrival) {
  // The time of decoding inertial samples counts for the scan they come with.
  decode_ns_ += arrival.decode_ns;
  NoteArrival(arrival.recv_utime, arrival.data.stamp);
  odometry_.AddImu(arrival.data);
}

void FilterLoop::Handle(Arrival<ScanChunk>& arrival) {
  NoteArrival(arrival.recv_utime, arrival.data.stamp);
  timings_.Of(arrival.data.scan_seq).arrived_utime = arrival.recv_utime;
  lidar_check_.Add(arrival.data);
  odometry_.AddChunk(std::move(arrival.data), std::exchange(decode_ns_, 0) + arrival.decode_ns);
  odometry_.ShedLoad();
}

void FilterLoop::Reset(const std::optional<GivenPose>& at, const std::string& why) {
  Emit();
  odometry_.Reset(at, newest_stamp_);
  to_.board.ForgetClockOffset();
  to_.match_worker.Forget();
  clouds_ = {};
  const Notice notice{newest_stamp_, Notice::Severity::kWarning, why};
  to_.board.SetNote(notice.text);
  notices_.Write(notice);
  to_.output_worker.PutRow(notice);
}

void FilterLoop::Handle(MatchOutcome& outcome) {
  has_job_out_ = false;
  clouds_.T_map_points = outcome.match.T_map_imu;
  if (publishes_features_ && outcome.features) {
    to_.output_worker.Put(FeatureCloudTask{outcome.sweep, outcome.features});
  }
  InsertTask insert = odometry_.FinishJob(std::move(outcome));
  if (insert.T_map_imu) clouds_.T_map_points = *insert.T_map_imu;
  clouds_.points_imu = insert.points_imu;
  to_.match_worker.Tell(std::move(insert));
  ++num_matches_done_;
}

void FilterLoop::HandOutJob() {
  if (has_job_out_ || is_cut_short_) return;
  std::optional<MatchJob> job = odometry_.NextJob();
  if (!job) return;
  has_job_out_ = true;
  timings_.Of(job->sweep->scan_seq).started_utime = HostUtime();
  clouds_.full = {};
  if (publishes_full_cloud_) clouds_.full = {job->sweep, job->T_any_imu, *job->T_imu_lidar, {}};
  to_.match_worker.Tell(std::move(*job));
}

void FilterLoop::Emit() {
  for (Output& output : odometry_.TakeOutputs()) {
    to_.publisher.Publish(output);
    if (const auto* scan = std::get_if<ScanOutput>(&output)) Emit(*scan);
    if (const auto* notice = std::get_if<Notice>(&output)) {
      to_.board.SetNote(notice->text);
      notices_.Write(*notice);
    }
    to_.output_worker.PutRow(std::move(output));
  }
  Counters counters = odometry_.counters();
  counters.ledgers = odometry_.ledgers();
  to_.board.SetEstimator(counters, odometry_.status(), newest_stamp_);
  if (odometry_.status() != announced_) {
    announced_ = odometry_.status();
    to_.output_worker.AnnounceStatus();
  }
}

void FilterLoop::Emit(const ScanOutput& output) {
  const ScanTiming& timing = timings_.Of(static_cast<std::int32_t>(output.scan.scan_seq));
  if (timing.is_complete()) {
    const auto ms = [](std::int64_t us) { return static_cast<double>(us) * 1e-3; };
    to_.board.AddLatency(ms(timing.started_utime - timing.arrived_utime),
                         ms(HostUtime() - timing.started_utime));
  }
  if (!output.filter) return;
  to_.board.SetImuNoise(output.filter->imu_noise);
  to_.board.SetClockOffset({output.filter->clock_offset_s, output.filter->clock_offset_std_s});
  to_.board.SetTrust(output.trust);
  EmitClouds(output);
}

void FilterLoop::EmitClouds(const ScanOutput& output) {
  const auto scan_seq = static_cast<std::int32_t>(output.scan.scan_seq);
  const Timestamp stamp = output.filter->nav.stamp;
  if (clouds_.full.sweep && clouds_.full.sweep->scan_seq == scan_seq) {
    clouds_.full.T_map_imu = clouds_.T_map_points;
    to_.output_worker.Put(std::exchange(clouds_.full, {}));
  }
  const auto& last = clouds_.last_sent;
  if (last && std::abs(SecondsBetween(*last, stamp)) < kCloudInterval_s) return;
  clouds_.last_sent = stamp;
  to_.output_worker.Put(RegisteredCloud{
      stamp, scan_seq,
      Decimate(clouds_.points_imu, clouds_.T_map_points, Publisher::kMaxCloudPoints)});
}

}  // namespace lio
