// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/synchronous_odometry.hpp"

#include <algorithm>
#include <utility>

#include "lio/pipeline/registration_worker.hpp"

namespace lio {
namespace {

bool IsEarlier(const LidarPoint& a, const LidarPoint& b) {
  return a.t_offset_ns < b.t_offset_ns;
}

// Brings a sweep into the form that drivers and converters send: points by time, the stamp that of
// the first one.
void Normalize(LidarSweep& sweep) {
  if (sweep.points.empty()) return;
  if (!std::is_sorted(sweep.points.begin(), sweep.points.end(), IsEarlier)) {
    std::stable_sort(sweep.points.begin(), sweep.points.end(), IsEarlier);
  }
  const std::uint32_t first = sweep.points.front().t_offset_ns;
  if (first == 0) return;
  sweep.stamp = sweep.stamp + Duration{first};
  for (LidarPoint& point : sweep.points) point.t_offset_ns -= first;
}

}  // namespace

class SynchronousOdometry::Impl {
 public:
  Impl(const Options& options, const std::vector<double>& beam_elevations_rad, ClockNs clock)
      : odometry_(options, clock), worker_(options, clock, beam_elevations_rad) {}

  void AddSweep(LidarSweep sweep) {
    Normalize(sweep);
    ScanChunk chunk;
    chunk.stamp = sweep.stamp;
    chunk.scan_seq = next_scan_seq_;
    chunk.points = std::move(sweep.points);
    // The numbers start anew instead of overflowing; sweeps far apart in time may share one.
    next_scan_seq_ = next_scan_seq_ == kLastScanSeq ? 0 : next_scan_seq_ + 1;
    odometry_.AddChunk(std::move(chunk));
    Match();
  }

  void Match() {
    while (const std::optional<MatchJob> job = odometry_.NextJob()) {
      InsertTask insert = odometry_.FinishJob(worker_.Run(*job));
      worker_.Insert(insert);
      if (keeps_clouds_ && insert.T_map_imu) Keep(insert);
    }
  }

  Odometry odometry_;
  RegistrationWorker worker_;
  bool keeps_clouds_ = false;
  std::vector<std::vector<Eigen::Vector3f>> clouds_map_;

 private:
  static constexpr std::int32_t kLastScanSeq = 2'000'000'000;  // chosen: below 2^31

  void Keep(const InsertTask& insert) {
    const Eigen::Matrix3f rotation = insert.T_map_imu->rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f translation = insert.T_map_imu->translation.cast<float>();
    std::vector<Eigen::Vector3f>& cloud = clouds_map_.emplace_back(insert.points_imu);
    for (Eigen::Vector3f& point : cloud) point = rotation * point + translation;
  }

  std::int32_t next_scan_seq_ = 0;
};

SynchronousOdometry::SynchronousOdometry(const Options& options,
                                         const std::vector<double>& beam_elevations_rad,
                                         ClockNs clock)
    : impl_(std::make_unique<Impl>(options, beam_elevations_rad, clock)) {}
SynchronousOdometry::~SynchronousOdometry() = default;
SynchronousOdometry::SynchronousOdometry(SynchronousOdometry&&) noexcept = default;
SynchronousOdometry& SynchronousOdometry::operator=(SynchronousOdometry&&) noexcept = default;

void SynchronousOdometry::AddImu(const ImuSample& sample) {
  impl_->odometry_.AddImu(sample);
  impl_->Match();
}

void SynchronousOdometry::AddSweep(LidarSweep sweep) {
  impl_->AddSweep(std::move(sweep));
}

void SynchronousOdometry::AddChunk(ScanChunk chunk) {
  impl_->odometry_.AddChunk(std::move(chunk));
  impl_->Match();
}

void SynchronousOdometry::Flush() {
  impl_->odometry_.Flush();
  impl_->Match();
}

std::vector<Output> SynchronousOdometry::TakeOutputs() {
  return impl_->odometry_.TakeOutputs();
}

void SynchronousOdometry::KeepMapClouds(bool keeps) {
  impl_->keeps_clouds_ = keeps;
}

std::vector<std::vector<Eigen::Vector3f>> SynchronousOdometry::TakeMapClouds() {
  return std::exchange(impl_->clouds_map_, {});
}

const Counters& SynchronousOdometry::counters() const {
  return impl_->odometry_.counters();
}

TrackingStatus SynchronousOdometry::status() const {
  return impl_->odometry_.status();
}

}  // namespace lio
