// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/registration_worker.hpp"

#include <utility>

#include "lio/relocalization/parameters.hpp"
#include "lio/scan/deskew.hpp"
#include "pipeline/lidar_beams.hpp"
#include "pipeline/match_method.hpp"
#include "pipeline/scan_in_work.hpp"

namespace lio {
namespace {

// Returns the turn rate that the scan was deskewed by, less its error as the match shows it.
TurnRate Corrected(const TurnRate& error, const StampedPoses& motion) {
  const double span_s = SecondsBetween(motion.front().stamp, motion.back().stamp);
  const Quaternion turn = motion.front().pose.rotation.conjugate() * motion.back().pose.rotation;
  return {LogSo3(turn) / span_s + error.w_imu_radps, error.cov};
}

// Fills the times of what others did for the scan, and of the insertion of the scan before.
void FillTimes(const MatchJob& job, std::int64_t insert_ns, StageTimes& times) {
  times[static_cast<std::size_t>(Stage::kDecode)] = job.sweep->decode_ns;
  times[static_cast<std::size_t>(Stage::kInsert)] = insert_ns;
  times[static_cast<std::size_t>(Stage::kFilter)] = job.filter_ns;
}

}  // namespace

RegistrationWorker::RegistrationWorker(const Options& options, ClockNs clock,
                                       const std::vector<double>& beam_elevations_rad,
                                       const InitialMapPtr& initial_map)
    : T_imu_lidar_(options.rig.T_imu_lidar.value_or(Pose::Identity())),
      calibration_(KnownBeams(options.rig.lidar)),
      clock_(clock),
      has_cells_(options.pipeline.method == MatchMethod::kNdt),
      filter_(options.rig.lidar),
      reducer_(MakeReducer(options, beam_elevations_rad)),
      matcher_(MakeMatcher(options)) {
  if (initial_map) initial_ = std::make_unique<InitialMapEntry>(*initial_map, MakeMatcher(options));
}

void RegistrationWorker::AddTime(Stage stage, std::int64_t since_ns, MatchOutcome& outcome) const {
  outcome.stage_ns[static_cast<std::size_t>(stage)] += Now() - since_ns;
}

void RegistrationWorker::CorrectBeams(std::vector<ScanPoint>& points) const {
  const BeamErrors& errors = calibration_.errors();
  if (errors.rings.empty()) return;
  for (ScanPoint& point : points) {
    point.position -= Displacement(errors, point.ring, AxesOf(point.position));
  }
}

// These scans have been learned from.
void RegistrationWorker::TakeCalibration(const BeamCalibration& found) {
  calibration_ = found;
  calibration_.ForgetScan();
  calibration_.Freeze();
}

std::optional<LidarBeams> RegistrationWorker::FoundBeams() const {
  if (!has_cells_ || !calibration_.IsOfUseElsewhere()) return std::nullopt;
  return AsLidarBeams(calibration_.Found());
}

void RegistrationWorker::ClearMap(const Vector3& up_map) {
  if (initial_) initial_->Leave(matcher_);
  matcher_->Clear();
  matcher_->SetUp(up_map);
  relocalizer_.Clear();
}

void RegistrationWorker::Do(const FindVelocity& /*task*/, ScanInWork& scan) {
  const MotionPrior& prior = scan.job.prior;
  MatchOutcome& outcome = scan.outcome;
  const auto found =
      relocalizer_.FindVelocity({scan.job.sweep->middle(), outcome.points_imu}, prior);
  outcome.v_map_imu_mps = found.v_map_imu_mps;
  outcome.speed_by_buildings = found.by_buildings;
  outcome.match.T_map_imu = prior.T_map_imu;
}

void RegistrationWorker::Do(const Track& task, ScanInWork& scan) {
  MatchFromPrior(task, nullptr, scan);
  FinishMatch(task, scan);
}

void RegistrationWorker::Do(const Relocalize& task, ScanInWork& scan) {
  MatchFromPrior(task.track, &task.search, scan);
  FinishMatch(task.track, scan);
}

MatchResult RegistrationWorker::MatchFully(const MatchInput& input, ScanInWork& scan) {
  if (scan.budget.Take()) return matcher_->Match(input);
  MatchResult none;
  none.status = MatchStatus::kMaxIterations;
  none.T_map_imu = input.T_map_imu_guess;
  return none;
}

MatchResult RegistrationWorker::MatchCoarsely(MatchInput input, ScanInWork& scan) {
  input.calibration = nullptr;
  scan.budget.CountCoarse();
  return matcher_->Match(input);
}

void RegistrationWorker::MatchFromPrior(const Track& task, const SearchRequest* search,
                                        ScanInWork& scan) {
  const std::int64_t begin = Now();
  const MatchJob& job = scan.job;
  scan.tags_to_match = Pick(scan.reduced.tags, scan.reduced.to_match);
  scan.to_match = Pick(scan.outcome.points_imu, scan.reduced.to_match);
  scan.beams_to_match = Pick(scan.reduced.points, scan.reduced.to_match);
  const DeskewedScan deskewed{job.sweep->middle(), scan.to_match};
  const MotionPrior prior = task.aligns_prior ? relocalizer_.Align(deskewed, job.prior) : job.prior;
  scan.outcome.match = job.bends_scan ? MatchBending(prior, scan) : MatchAsMeasured(prior, scan);
  if (search != nullptr) Search(*search, scan);
  AddTime(Stage::kMatch, begin, scan.outcome);
}

void RegistrationWorker::DeskewAgain(ScanInWork& scan) const {
  scan.outcome.points_imu =
      Deskew(scan.reduced.points, TimesOf(*scan.job.sweep), scan.motion, T_imu_lidar_);
  scan.to_match = Pick(scan.outcome.points_imu, scan.reduced.to_match);
}

void RegistrationWorker::Search(const SearchRequest& request, ScanInWork& scan) {
  std::vector<std::uint32_t> few;  // picked once they are needed, which is seldom
  std::vector<Eigen::Vector3f> few_points;
  std::vector<FeatureTag> few_tags;
  const auto pick_few = [&] {
    if (!few.empty()) return;
    few = SpreadIndices(scan.to_match.size(), kRelocalization.num_coarse_points);
    few_points = Pick(scan.to_match, few);
    few_tags = Pick(scan.tags_to_match, few);
  };
  const int num_for_deskew = scan.job.refines_deskew ? 1 : 0;
  const CandidateMatcher matcher{[&](const Pose& guess, const Matrix6& cov) {
                                   MatchInput input = scan.InputFrom(guess, cov);
                                   input.calibration = nullptr;
                                   return MatchFully(input, scan);
                                 },
                                 [&](const Pose& guess, const Matrix6& cov) {
                                   pick_few();
                                   MatchInput input = scan.InputFrom(guess, cov);
                                   input.points_imu = few_points;
                                   input.tags = few_tags;
                                   input.is_far_off = false;
                                   return MatchCoarsely(input, scan);
                                 },
                                 scan.budget.num_left() - num_for_deskew};
  const DeskewedScan deskewed{scan.job.sweep->middle(), scan.to_match};
  const Relocalizer::Found found =
      relocalizer_.Search(request, deskewed, scan.job.prior, scan.outcome.match, matcher);
  // The rows of the first match are of another place.
  if (found.is_relocalized || found.is_clock_set) calibration_.ForgetScan();
  scan.outcome.match = found.match;
  scan.outcome.is_relocalized = found.is_relocalized;
  scan.outcome.is_clock_set = found.is_clock_set;
}

void RegistrationWorker::RefineDeskew(ScanInWork& scan) {
  const MatchJob& job = scan.job;
  MatchOutcome& outcome = scan.outcome;
  const SweepTimes times = TimesOf(*job.sweep);
  std::int64_t begin = Now();
  if (!job.bends_scan) {  // else it is deskewed along what was found already
    const bool is_near_prior = !outcome.is_relocalized && !outcome.is_clock_set;
    if (is_near_prior) scan.motion = BentTo(outcome.match.T_map_imu, job);
    DeskewAgain(scan);
  }
  AddTime(Stage::kDeskew, begin, outcome);
  begin = Now();
  const std::vector<float> from_mid_sweep_s = TimesFromMidSweep(times, scan.reduced);
  MatchInput input = scan.InputFrom(outcome.match.T_map_imu, Matrix6::Zero());
  input.from_mid_sweep_s = from_mid_sweep_s;
  input.is_far_off = false;  // the guess is what was found
  outcome.match = MatchFully(input, scan);
  if (const auto& error = outcome.match.turn_rate_error; error && scan.motion.size() > 1) {
    outcome.turn_rate = Corrected(*error, scan.motion);
  }
  AddTime(Stage::kMatch, begin, outcome);
}

void RegistrationWorker::TakeDensePoints(ScanInWork& scan) {
  const std::int64_t begin = Now();
  const Sweep& sweep = *scan.job.sweep;
  scan.reduced.points = DensePoints(sweep, filter_);
  CorrectBeams(scan.reduced.points);
  scan.outcome.points_imu = Deskew(scan.reduced.points, TimesOf(sweep), scan.motion, T_imu_lidar_);
  AddTime(Stage::kDeskew, begin, scan.outcome);
}

void RegistrationWorker::FinishMatch(const Track& task, ScanInWork& scan) {
  const MatchJob& job = scan.job;
  MatchOutcome& outcome = scan.outcome;
  if (job.refines_deskew && outcome.match.IsUsable()) RefineDeskew(scan);
  if (outcome.match.IsUsable() || outcome.match.status == MatchStatus::kEmptyMap) {
    const std::int64_t begin = Now();
    if (task.holds_degenerate) {
      relocalizer_.HoldDegenerate(outcome.points_imu, job.prior, outcome.match);
    }
    if (job.seeks_place && initial_) SeekPlace(scan);
    AddTime(Stage::kMatch, begin, outcome);
    relocalizer_.SetLocated(job.sweep->middle(), std::move(scan.to_match), outcome.match);
  }
  const bool warms_up = job.map_action == MapAction::kWarmUp || job.map_action == MapAction::kClear;
  if (warms_up && has_cells_) TakeDensePoints(scan);
}

void RegistrationWorker::SeekPlace(ScanInWork& scan) {
  MatchOutcome& outcome = scan.outcome;
  outcome.place =
      initial_->Seek({scan.to_match, outcome.match}, outcome.points_imu, T_imu_lidar_, scan.budget);
}

void RegistrationWorker::PrepareMap(const MatchJob& job) {
  if (job.map_action == MapAction::kClear) ClearMap(job.prior.up_map);
  if (job.map_action == MapAction::kEnter && initial_) {
    initial_->Enter(matcher_);
    relocalizer_.Clear();
  }
}

void RegistrationWorker::Reduce(const Sweep& sweep, ScanInWork& scan) {
  const std::int64_t begin = Now();
  scan.reduced = reducer_->Reduce(sweep);
  range_std_m_ = scan.reduced.range_std_m;
  CorrectBeams(scan.reduced.points);
  scan.outcome.num_used = static_cast<int>(scan.reduced.to_match.size());
  scan.outcome.num_nonfinite = scan.reduced.num_nonfinite;
  scan.outcome.is_repeated = repeats_.IsRepeated(sweep);
  AddTime(Stage::kReduce, begin, scan.outcome);
}

MatchOutcome RegistrationWorker::Run(const MatchJob& job) {
  const Sweep& sweep = *job.sweep;
  if (job.T_imu_lidar) T_imu_lidar_ = *job.T_imu_lidar;
  ScanInWork scan{.job = job,
                  .T_imu_lidar = T_imu_lidar_,
                  .calibration = &calibration_,
                  .motion = job.T_any_imu};
  MatchOutcome& outcome = scan.outcome;
  outcome.sweep = job.sweep;
  calibration_.ForgetScan();
  PrepareMap(job);
  Reduce(sweep, scan);
  const std::int64_t begin = Now();
  outcome.points_imu = Deskew(scan.reduced.points, TimesOf(sweep), scan.motion, T_imu_lidar_);
  AddTime(Stage::kDeskew, begin, outcome);
  std::visit([&](const auto& task) { Do(task, scan); }, job.task);
  new_content_share_ = outcome.match.new_content_share;
  is_blind_ = outcome.match.degenerate_mask != 0;
  outcome.points_lidar = std::move(scan.reduced.points);
  outcome.tags = std::move(scan.reduced.tags);
  outcome.features = std::move(scan.reduced.features);
  FillTimes(job, std::exchange(last_insert_ns_, 0), outcome.stage_ns);
  outcome.num_matches = scan.budget.num_taken();
  outcome.num_coarse_matches = scan.budget.num_coarse();
  return std::move(scan.outcome);
}

void RegistrationWorker::Insert(const InsertTask& task) {
  if (!task.T_map_imu) return;
  const std::int64_t begin = Now();
  matcher_->Insert({.points_imu = task.points_imu,
                    .tags = task.tags,
                    .T_imu_lidar = T_imu_lidar_,
                    .beam_points = task.points_lidar,
                    .corrected = &calibration_.errors(),
                    .range_std_m = range_std_m_},
                   *task.T_map_imu);
  calibration_.Keep(new_content_share_, is_blind_);
  last_insert_ns_ = Now() - begin;
}

}  // namespace lio
