// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/filter_history.hpp"

#include <algorithm>
#include <cmath>

#include "lio/filter/estimate_change.hpp"
#include "lio/filter/map_bend.hpp"

namespace lio {
namespace {

// The map begins here: its pose is right by definition, and it is level as the state is.
void RebaseMapPose(Estimate& estimate) {
  estimate.cov.middleRows<6>(kMapPose).setZero();
  estimate.cov.middleCols<6>(kMapPose).setZero();
  MarkMapStart(estimate);
}

// Returns the mean turn rate of a step, rad/s.
double MeanRate(const ImuSample& from, const ImuSample& to) {
  return 0.5 * (from.w_imu_radps + to.w_imu_radps).norm();
}

}  // namespace

FilterHistory::FilterHistory(const HistoryOptions& options, const Estimate& start,
                             const ImuSample& sample)
    : options_(options), start_stamp_(start.stamp) {
  Node node;
  node.stamp = start.stamp;
  node.imu_stamp = start.stamp;
  node.sample = sample;
  node.sample.stamp = start.stamp;
  node.noise = options.noise.shown;
  node.rate_error = options.rate_error;
  node.posterior = start;
  nodes_.push_back(std::move(node));
}

std::size_t FilterHistory::FirstAfter(Timestamp stamp) const {
  std::size_t at = nodes_.size();  // late events are seldom very late: search from the end
  while (at > 0 && nodes_[at - 1].stamp > stamp) --at;
  return at;
}

std::optional<EventOutcome> FilterHistory::Refuse(Timestamp stamp, Kind kind) const {
  if (stamp < start_stamp_) return EventOutcome::kBeforeStart;
  const Node& front = nodes_.front();  // may be a pose whose sample has left the window
  if (stamp < front.stamp || (stamp == front.stamp && kind < front.kind)) {
    return EventOutcome::kTooOld;
  }
  for (std::size_t at = FirstAfter(stamp); at > 0 && nodes_[at - 1].stamp == stamp; --at) {
    if (nodes_[at - 1].kind == kind) return EventOutcome::kDuplicate;
  }
  return std::nullopt;
}

ImuSample FilterHistory::SampleAt(Timestamp stamp, std::size_t at) const {
  const ImuSample& before = nodes_[at - 1].sample;
  for (std::size_t i = at; i < nodes_.size(); ++i) {
    if (nodes_[i].kind == Kind::kImu) return InterpolateSample(before, nodes_[i].sample, stamp);
  }
  ImuSample held = before;
  held.stamp = stamp;
  return held;
}

bool FilterHistory::IsInGap(Timestamp stamp, std::size_t at) const {
  const auto is_measured = [](const Node& node) { return node.kind == Kind::kImu; };
  const auto next =
      std::find_if(nodes_.begin() + static_cast<std::ptrdiff_t>(at), nodes_.end(), is_measured);
  const Timestamp until = next == nodes_.end() ? stamp : next->stamp;
  return until - nodes_[at - 1].imu_stamp >= options_.imu_outage.gap;
}

// A measured sample ends a gap, even where the next one begins at once.
double FilterHistory::InGap_s(Timestamp stamp, std::size_t at) const {
  if (!IsInGap(stamp, at)) return 0.0;
  const Node& before = nodes_[at - 1];
  const bool is_measured = before.kind == Kind::kImu && !before.sample.is_made_up();
  return (is_measured ? 0.0 : before.in_gap_s) + SecondsBetween(before.stamp, stamp);
}

void FilterHistory::StepTo(Estimate& estimate, const Node& before, const ImuSample& to,
                           double in_gap_s) const {
  const ImuSample& from = before.sample;
  const double dt = SecondsBetween(from.stamp, to.stamp);
  if (dt <= 0) return;
  ProcessNoise noise = options_.noise;
  noise.shown = before.noise;
  // An error of `std` that is constant for lasts_s has the variance of white noise of this density.
  const auto add = [](double& density, double std, double lasts_s) {
    density = std::hypot(density, std * std::sqrt(lasts_s));
  };
  const ImuOutageParameters& outage = options_.imu_outage;
  if (in_gap_s > 0.0) {
    // The error is constant for all of the gap: its integral's variance grows with the square of
    // the time since a pose was fused. The position gets two thirds of its true variance by it.
    const double lasts_s = 2.0 * in_gap_s - dt;
    const auto least = [](double std, float a, float b) {
      return std::max({std, static_cast<double>(a), static_cast<double>(b)});
    };
    add(noise.accel_density,
        least(outage.gap_accel_std_mps2, from.made_up_f_std_mps2, to.made_up_f_std_mps2), lasts_s);
    add(noise.gyro_density,
        least(outage.gap_gyro_std_radps, from.made_up_w_std_radps, to.made_up_w_std_radps),
        lasts_s);
  }
  if (from.is_force_saturated || to.is_force_saturated) {
    add(noise.accel_density, outage.saturated_accel_std_mps2, outage.saturated_s);
  }
  if (from.is_rate_saturated || to.is_rate_saturated) {
    add(noise.gyro_density, outage.saturated_gyro_std_radps, outage.saturated_s);
  }
  noise.shown.gyro_psd = GyroPsd(noise).array() + before.rate_error.Psd(MeanRate(from, to));
  Propagate(estimate, from, to, noise, options_.g_world);
}

// Fuses the node's pose and learns the gyro's error in proportion to its rate, unless the pose says
// nothing of the turn since the last one.
void FilterHistory::FuseIn(Node& node, const HistoryOptions& options) {
  if (node.pose.motion == PredictedMotion::kKept) {
    const PoseMeasurement& measurement = node.pose.measurement;
    const Estimate& predicted = node.posterior;
    const Quaternion residual =
        predicted.state.T_map_imu.rotation.conjugate() * measurement.T_map_imu.rotation;
    node.rate_error.AddPose(LogSo3(residual),
                            predicted.cov.block<3, 3>(kMapPose + 3, kMapPose + 3) +
                                measurement.cov.bottomRightCorner<3, 3>());
  }
  node.update = FusePoseEvent(node.pose, options.nis_limit, options.max_inflation, node.inflation,
                              node.posterior);
  if (!node.update.fused) return;
  node.rate_error.BeginTurn();
  node.in_gap_s = 0.0;
}

void FilterHistory::Step(std::size_t at) {
  Node& node = nodes_[at];
  const bool is_measured = node.kind == Kind::kImu;
  if (!is_measured) node.sample = SampleAt(node.stamp, at);
  node.imu_stamp = is_measured ? node.stamp : nodes_[at - 1].imu_stamp;
  node.posterior = nodes_[at - 1].posterior;
  node.inflation = nodes_[at - 1].inflation;
  node.noise = nodes_[at - 1].noise;
  node.rate_error = nodes_[at - 1].rate_error;
  node.rate_error.Turn(MeanRate(nodes_[at - 1].sample, node.sample),
                       SecondsBetween(nodes_[at - 1].stamp, node.stamp));
  node.in_gap_s = InGap_s(node.stamp, at);
  StepTo(node.posterior, nodes_[at - 1], node.sample, node.in_gap_s);
  node.posterior.stamp = node.stamp;
  switch (node.kind) {
    case Kind::kImu:
      break;
    case Kind::kPose:
      FuseIn(node, options_);
      break;
    case Kind::kZeroVelocity:
      node.update =
          FuseZeroVelocity(node.posterior, node.velocity_var, options_.zero_velocity_nis_limit);
      break;
    case Kind::kVelocity:
      SetVelocity(node.v_imu_mps, node.velocity_var * Matrix3::Identity(), node.posterior);
      break;
    case Kind::kRebase:
      RebaseMapPose(node.posterior);
      break;
    case Kind::kNoise:
      node.noise = node.new_noise;
      break;
  }
}

void FilterHistory::Replay(std::size_t from) {
  for (std::size_t at = from; at < nodes_.size(); ++at) Step(at);
}

std::size_t FilterHistory::Insert(Node node, std::size_t from) {
  std::size_t at = FirstAfter(node.stamp);
  while (at > 1 && nodes_[at - 1].stamp == node.stamp && nodes_[at - 1].kind > node.kind) --at;
  from = std::min(from, at);
  // Events just before a new sample used the sample before them, held; now they can interpolate.
  if (node.kind == Kind::kImu) {
    while (from > 1 && nodes_[from - 1].kind != Kind::kImu) --from;
  }
  nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(at), std::move(node));
  Replay(from);
  return at;
}

EventOutcome FilterHistory::AddImu(const ImuSample& sample) {
  if (const auto refused = Refuse(sample.stamp, Kind::kImu)) return *refused;
  Node node;
  node.stamp = sample.stamp;
  node.sample = sample;
  Insert(std::move(node));
  Trim();
  return EventOutcome::kApplied;
}

std::optional<std::size_t> FilterHistory::LastGrowingScan(Timestamp stamp) const {
  for (std::size_t at = FirstAfter(stamp); at > 1; --at) {
    const Node& node = nodes_[at - 1];
    if (node.kind == Kind::kRebase) return std::nullopt;
    const PoseMeasurement& measurement = node.pose.measurement;
    const bool has_grown_map = node.kind == Kind::kPose && node.stamp < stamp &&
                               node.update.fused && measurement.new_content_share > 0.0;
    if (has_grown_map) return at - 1;
  }
  return std::nullopt;
}

EventOutcome FilterHistory::AddPose(Timestamp stamp, const PoseEvent& event, UpdateResult* result,
                                    const std::optional<Matrix6>& share_of_last_scan) {
  if (const auto refused = Refuse(stamp, Kind::kPose)) return *refused;
  Node node;
  node.stamp = stamp;
  node.kind = Kind::kPose;
  node.pose = event;
  std::size_t from = nodes_.size();
  if (const auto last = share_of_last_scan ? LastGrowingScan(stamp) : std::nullopt) {
    PoseMeasurement& measurement = nodes_[*last].pose.measurement;
    if (!measurement.knows_directions) {
      measurement.knows_directions = true;
      measurement.share_by_direction = *share_of_last_scan;
      from = *last;
    }
  }
  const UpdateResult update = nodes_[Insert(std::move(node), from)].update;
  if (result != nullptr) *result = update;
  return update.fused ? EventOutcome::kApplied : EventOutcome::kGated;
}

EventOutcome FilterHistory::AddZeroVelocity(Timestamp stamp, double variance) {
  if (const auto refused = Refuse(stamp, Kind::kZeroVelocity)) return *refused;
  Node node;
  node.stamp = stamp;
  node.kind = Kind::kZeroVelocity;
  node.velocity_var = variance;
  const bool is_fused = nodes_[Insert(std::move(node))].update.fused;
  return is_fused ? EventOutcome::kApplied : EventOutcome::kGated;
}

EventOutcome FilterHistory::AddVelocity(Timestamp stamp, const Vector3& v_imu_mps,
                                        double variance) {
  if (const auto refused = Refuse(stamp, Kind::kVelocity)) return *refused;
  Node node;
  node.stamp = stamp;
  node.kind = Kind::kVelocity;
  node.v_imu_mps = v_imu_mps;
  node.velocity_var = variance;
  Insert(std::move(node));
  return EventOutcome::kApplied;
}

EventOutcome FilterHistory::AddRebase(Timestamp stamp) {
  if (const auto refused = Refuse(stamp, Kind::kRebase)) return *refused;
  Node node;
  node.stamp = stamp;
  node.kind = Kind::kRebase;
  Insert(std::move(node));
  return EventOutcome::kApplied;
}

EventOutcome FilterHistory::AddNoise(Timestamp stamp, const ImuNoise& noise) {
  if (const auto refused = Refuse(stamp, Kind::kNoise)) return *refused;
  Node node;
  node.stamp = stamp;
  node.kind = Kind::kNoise;
  node.new_noise = noise;
  Insert(std::move(node));
  return EventOutcome::kApplied;
}

Estimate FilterHistory::At(Timestamp stamp) const {
  const std::size_t after = FirstAfter(stamp);
  if (after == 0) return nodes_.front().posterior;
  Estimate estimate = nodes_[after - 1].posterior;
  StepTo(estimate, nodes_[after - 1], SampleAt(stamp, after), InGap_s(stamp, after));
  estimate.stamp = stamp;
  return estimate;
}

double FilterHistory::RateErrorStd(Timestamp stamp) const {
  const std::size_t after = FirstAfter(stamp);
  const Node& node = after == 0 ? nodes_.front() : nodes_[after - 1];
  return node.rate_error.std_ratio() * node.sample.w_imu_radps.norm();
}

StampedPoses FilterHistory::Trajectory(Timestamp from, Timestamp to) const {
  StampedPoses poses;
  poses.push_back({from, At(from).state.T_world_imu});
  for (std::size_t at = FirstAfter(from); at < nodes_.size() && nodes_[at].stamp < to; ++at) {
    if (nodes_[at].stamp > poses.back().stamp) {
      poses.push_back({nodes_[at].stamp, nodes_[at].posterior.state.T_world_imu});
    } else {
      poses.back().pose = nodes_[at].posterior.state.T_world_imu;
    }
  }
  if (to > poses.back().stamp) poses.push_back({to, At(to).state.T_world_imu});
  return poses;
}

std::vector<ImuSample> FilterHistory::SamplesBetween(Timestamp from, Timestamp to) const {
  std::vector<ImuSample> samples;
  for (std::size_t at = FirstAfter(from); at < nodes_.size() && nodes_[at].stamp <= to; ++at) {
    if (nodes_[at].kind == Kind::kImu) samples.push_back(nodes_[at].sample);
  }
  return samples;
}

void FilterHistory::Trim() {
  Timestamp oldest = nodes_.back().stamp - Duration::FromSeconds(options_.span_s);
  if (keep_from_) oldest = std::min(oldest, *keep_from_);
  while (nodes_.size() > 2 &&
         (nodes_[1].stamp <= oldest || nodes_.size() > kFilterParameters.history.max_events)) {
    nodes_.pop_front();
  }
}

}  // namespace lio
