// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/registration_worker.hpp"

#include <utility>

#include "lio/pipeline/match_method.hpp"
#include "lio/scan/deskew.hpp"
#include "relocalization/place_guesses.hpp"

namespace lio {
namespace {

// The motion during the sweep, bent so that its middle is where the scan was found: a constant
// velocity, wrong since the last scan that was found, has grown the error from nothing.
StampedPoses Bend(const MatchJob& job, const Pose& found) {
  const Vector6 correction = LogSe3(job.T_map_imu_guess.Inverse() * found);
  StampedPoses bent = job.T_any_imu;
  for (StampedPose& pose : bent) {
    const double from_mid_sweep_s = SecondsBetween(job.sweep->middle(), pose.stamp);
    pose.pose = pose.pose * ExpSe3((1.0 + from_mid_sweep_s / job.since_last_fix_s) * correction);
  }
  return bent;
}

template <class T>
std::vector<T> Pick(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  std::vector<T> picked;
  if (values.empty()) return picked;
  picked.reserve(indices.size());
  for (const std::uint32_t i : indices) picked.push_back(values[i]);
  return picked;
}

// When the picked points were seen.
std::vector<float> TimesFromMidSweep(const SweepTimes& times, const ReducedScan& reduced) {
  const auto start_s = static_cast<float>(SecondsBetween(times.reference, times.start));
  std::vector<float> from_mid_sweep_s;
  from_mid_sweep_s.reserve(reduced.to_match.size());
  for (const std::uint32_t i : reduced.to_match) {
    from_mid_sweep_s.push_back(start_s + 1e-9f * static_cast<float>(reduced.points[i].t_offset_ns));
  }
  return from_mid_sweep_s;
}

// What the deskew took for the turn rate, put right by what the match says of it.
TurnRate PutRight(const TurnRate& error, const StampedPoses& motion) {
  const double span_s = SecondsBetween(motion.front().stamp, motion.back().stamp);
  const Quaternion turn = motion.front().pose.rotation.conjugate() * motion.back().pose.rotation;
  return {LogSo3(turn) / span_s + error.w_imu_radps, error.cov};
}

constexpr double kSoughtStd_m = 0.5;  // of a shift that was found
constexpr std::size_t kMinScansToSeek = 3;

SweepTimes TimesOf(const Sweep& sweep) {
  return {sweep.start, sweep.end, sweep.middle()};
}

}  // namespace

RegistrationWorker::RegistrationWorker(const Options& options, ClockNs clock,
                                       const std::vector<double>& beam_elevations_rad)
    : T_imu_lidar_(options.rig.T_imu_lidar.value_or(Pose::Identity())),
      clock_(clock),
      feeds_young_map_(options.pipeline.method == MatchMethod::kNdt),
      filter_(options.rig.lidar),
      reducer_(MakeReducer(options, beam_elevations_rad)),
      matcher_(MakeMatcher(options)) {}

void RegistrationWorker::AddTime(Stage stage, std::int64_t since_ns, MatchOutcome& outcome) const {
  outcome.stage_ns[static_cast<std::size_t>(stage)] += Now() - since_ns;
}

MatchInput RegistrationWorker::SeekShift(const MatchJob& job, MatchInput input) const {
  if (!last_found_) return input;
  const Quaternion R_level_map = LevelOf(job.up_map);
  VelocitySearch search;
  search.Add(last_found_->stamp, Levelled(last_found_->points_imu,
                                          R_level_map * last_found_->match.T_map_imu.rotation));
  search.Add(job.sweep->middle(),
             Levelled(input.points_imu, R_level_map * job.T_map_imu_guess.rotation));
  if (const auto v_level = search.Find()) {
    const double since_s = SecondsBetween(last_found_->stamp, job.sweep->middle());
    const Vector3 shift_level = since_s * Vector3(v_level->x(), v_level->y(), 0.0);
    input.T_map_imu_guess.translation =
        last_found_->match.T_map_imu.translation + R_level_map.conjugate() * shift_level;
    input.guess_cov.topLeftCorner<3, 3>() = kSoughtStd_m * kSoughtStd_m * Matrix3::Identity();
  }
  return input;
}

void RegistrationWorker::SeekVelocity(const MatchJob& job, MatchOutcome& outcome) {
  const Quaternion R_level_map = LevelOf(job.up_map);
  velocity_search_.Add(job.sweep->middle(),
                       Levelled(outcome.points_imu, R_level_map * job.T_map_imu_guess.rotation));
  outcome.match.T_map_imu = job.T_map_imu_guess;
  if (velocity_search_.num_scans() < kMinScansToSeek) return;
  if (const auto v_level = velocity_search_.Find()) {
    outcome.v_map_imu_mps = R_level_map.conjugate() * Vector3(v_level->x(), v_level->y(), 0.0);
  }
}

void RegistrationWorker::Match(const MatchJob& job, const ReducedScan& reduced,
                               MatchOutcome& outcome) {
  std::int64_t begin = Now();
  const std::vector<FeatureTag> tags = Pick(reduced.tags, reduced.to_match);
  std::vector<Eigen::Vector3f> to_match = Pick(outcome.points_imu, reduced.to_match);
  MatchInput input{.points_imu = to_match,
                   .T_map_imu_guess = job.T_map_imu_guess,
                   .guess_cov = job.guess_cov,
                   .is_far_off = job.refine_deskew,
                   .tags = tags,
                   .scan_points_imu = outcome.points_imu,
                   .shift_std_m = job.shift_std_m};
  if (job.seek == MatchJob::Seek::kShift) input = SeekShift(job, input);
  outcome.match = matcher_->Match(input);
  if (last_found_) {
    SeekPlace(job, input, outcome);
    TryClockSet(job, input, outcome);
  }
  AddTime(Stage::kMatch, begin, outcome);
  const SweepTimes sweep_times = TimesOf(*job.sweep);
  StampedPoses motion = job.T_any_imu;
  if (job.refine_deskew && outcome.match.IsUsable()) {
    begin = Now();
    if (!outcome.is_sought && !outcome.is_clock_set) motion = Bend(job, outcome.match.T_map_imu);
    outcome.points_imu = Deskew(reduced.points, sweep_times, motion, T_imu_lidar_);
    AddTime(Stage::kDeskew, begin, outcome);
    begin = Now();
    to_match = Pick(outcome.points_imu, reduced.to_match);
    const std::vector<float> from_mid_sweep_s = TimesFromMidSweep(sweep_times, reduced);
    outcome.match = matcher_->Match({to_match, outcome.match.T_map_imu, Matrix6::Zero(), true, tags,
                                     outcome.points_imu, job.shift_std_m, from_mid_sweep_s});
    if (const auto& error = outcome.match.turn_rate_error; error && motion.size() > 1) {
      outcome.turn_rate = PutRight(*error, motion);
    }
    AddTime(Stage::kMatch, begin, outcome);
  }
  if (outcome.match.IsUsable() || outcome.match.status == MatchStatus::kEmptyMap) {
    begin = Now();
    if (job.hold_by_view) HoldByView(job, outcome);
    AddTime(Stage::kMatch, begin, outcome);
    last_found_ = {job.sweep->middle(), std::move(to_match), outcome.match};
  }
  if ((job.clear_map || job.is_map_young) && feeds_young_map_) {
    begin = Now();
    const std::vector<ScanPoint> dense = DensePoints(*job.sweep, filter_);
    outcome.points_imu = Deskew(dense, sweep_times, motion, T_imu_lidar_);
    AddTime(Stage::kDeskew, begin, outcome);
  }
}

MatchOutcome RegistrationWorker::Run(const MatchJob& job) {
  const Sweep& sweep = *job.sweep;
  MatchOutcome outcome;
  outcome.sweep = job.sweep;
  if (job.clear_map) {
    matcher_->Clear();
    matcher_->SetUp(job.up_map);
    velocity_search_ = {};
    views_.clear();
    last_found_.reset();
  }

  std::int64_t begin = Now();
  ReducedScan reduced = reducer_->Reduce(sweep);
  outcome.num_used = static_cast<int>(reduced.to_match.size());
  outcome.num_nonfinite = reduced.num_nonfinite;
  AddTime(Stage::kReduce, begin, outcome);

  begin = Now();
  outcome.points_imu = Deskew(reduced.points, TimesOf(sweep), job.T_any_imu, T_imu_lidar_);
  AddTime(Stage::kDeskew, begin, outcome);

  if (job.seek == MatchJob::Seek::kVelocity) {
    SeekVelocity(job, outcome);
  } else {
    Match(job, reduced, outcome);
  }
  outcome.tags = std::move(reduced.tags);
  outcome.features = std::move(reduced.features);
  StageTimes& times = outcome.stage_ns;
  times[static_cast<std::size_t>(Stage::kDecode)] = sweep.decode_ns;
  times[static_cast<std::size_t>(Stage::kInsert)] = last_insert_ns_;
  times[static_cast<std::size_t>(Stage::kFilter)] = job.filter_ns;
  last_insert_ns_ = 0;
  return outcome;
}

void RegistrationWorker::Insert(const InsertTask& task) {
  if (!task.T_map_imu) return;
  const std::int64_t begin = Now();
  matcher_->Insert({task.points_imu, task.tags, T_imu_lidar_.translation}, *task.T_map_imu);
  last_insert_ns_ = Now() - begin;
}

}  // namespace lio
