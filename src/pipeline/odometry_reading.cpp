// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What the inertial messages' numbers mean: judged while scouting and, until it is beyond doubt,
// while the filter runs.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <iterator>
#include <utility>

#include "lio/pipeline/options_fields.hpp"
#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr std::size_t kMinToJudge = 8;
constexpr int kManyUnmatched = 5;
constexpr Duration kWildSpan{500'000'000};
constexpr double kWildRate_radps = 1.0;
constexpr int kPosesPerVerdict = 5;
constexpr double kMaxDoubt_s = 10.0;
constexpr std::uint32_t kLastScans = 0b11111;
constexpr int kMaxGated = 2;  // of these

bool HasSameRates(const ImuConvention& a, const ImuConvention& b) {
  return a.is_in_deg == b.is_in_deg && a.R_imu_sent == b.R_imu_sent;
}

std::string FixOf(const ImuConvention& found, const Rig& rig) {
  std::string fix = "set rig.imu.units: auto";
  if (found.R_imu_sent == Matrix3::Identity()) {
    const auto units = static_cast<std::size_t>(UnitsOf(found));
    return fix + " or " + std::string(kEnumNames<ImuUnits>[units]);
  }
  const Pose T_sent_imu{Quaternion(Matrix3(found.R_imu_sent.transpose())), Vector3::Zero()};
  const Pose T = T_sent_imu * rig.T_imu_lidar.value_or(Pose{});
  char text[200];
  std::snprintf(text, sizeof text,
                ", or turn rig.T_imu_lidar: translation_m: [%.3f, %.3f, %.3f], rotation_wxyz: "
                "[%.5f, %.5f, %.5f, %.5f]",
                T.translation.x(), T.translation.y(), T.translation.z(), T.rotation.w(),
                T.rotation.x(), T.rotation.y(), T.rotation.z());
  return fix + text;
}

}  // namespace

// A sample that came, in the units and axes that are believed; absent when no gyro can turn so fast
// in them.
std::optional<ImuSample> Odometry::Impl::Read(const ImuSample& sent) {
  const ImuSample sample = ToSi(reading_, sent);
  if (sample.w_imu_radps.norm() <= kMaxGyroRate_radps) return sample;
  ++counters_.num_imu_out_of_range;
  return std::nullopt;
}

void Odometry::Impl::TellClassifier(const StampedPose& T_map_imu) {
  if (is_reading_settled_ || !use_imu_) return;
  const Timestamp since = std::exchange(classified_until_, T_map_imu.stamp);
  std::vector<ImuSample> sent;
  for (const ImuSample& sample : sent_) {
    if (sample.stamp >= since && sample.stamp <= T_map_imu.stamp) sent.push_back(sample);
  }
  classifier_.AddPose(T_map_imu, sent);
  ++num_poses_to_judge_;
}

void Odometry::Impl::ClassifyAnew() {
  classifier_ = ImuClassifier(reading_, options_.rig);
  if (is_force_unit_told_) classifier_.KeepForceUnit();
}

// True when what was scouted is of no use any more.
bool Odometry::Impl::JudgeWhileScouting(Timestamp stamp) {
  if (is_reading_settled_) return false;
  const ImuVerdict verdict = classifier_.Judge(IsInDoubt(stamp));
  has_gravity_in_motion_ = verdict.has_gravity;
  if (scouts_with_gyro_ && IsGyroMisleading(verdict)) {
    ClassifyAnew();
    ScoutWithoutGyro();
    return true;
  }
  is_reading_settled_ = verdict.finding == ImuVerdict::Finding::kAsExpected;
  if (verdict.finding != ImuVerdict::Finding::kOtherwise) return false;
  Adopt(verdict.convention, verdict.evidence, stamp);
  return true;
}

// Judged by poses that were scouted with it.
bool Odometry::Impl::IsGyroMisleading(const ImuVerdict& verdict) const {
  if (verdict.finding == ImuVerdict::Finding::kOtherwise) {
    return !HasSameRates(verdict.convention, reading_);
  }
  const auto num_matched = std::count_if(scouted_.begin(), scouted_.end(),
                                         [](const Scouted& s) { return s.is_matched; });
  const bool few_are_matched =
      scouted_.size() >= kMinToJudge && 2 * num_matched < std::ssize(scouted_);
  return verdict.finding == ImuVerdict::Finding::kNotExpected || few_are_matched ||
         classifier_.IsGyroAbsurd() ||
         MayBeDegrees(SamplesBetween(ready_.front()->start, scouted_.back().pose.stamp));
}

// The same sweeps again, their motion guessed by constant velocity.
void Odometry::Impl::ScoutWithoutGyro() {
  scouts_with_gyro_ = false;
  BeginScoutingAnew();
}

// After a start at rest the first turns tell.
void Odometry::Impl::JudgeWhileRunning(Timestamp stamp) {
  if (is_reading_settled_) return;
  const bool is_wild = IsGyroWild(stamp);
  const bool is_doubtful = IsDoubtful();
  if (num_poses_to_judge_ < kPosesPerVerdict && !is_wild && !is_doubtful) return;
  num_poses_to_judge_ = 0;
  const ImuVerdict::Finding finding = classifier_.Judge().finding;
  is_reading_settled_ = finding == ImuVerdict::Finding::kAsExpected;
  const bool is_unfit = classifier_.HasMoved() && (finding == ImuVerdict::Finding::kNotExpected ||
                                                   finding == ImuVerdict::Finding::kOtherwise);
  const bool is_useless = is_wild || classifier_.IsGyroAbsurd();
  if (is_reading_settled_ || !(is_useless || is_unfit || is_doubtful)) return;
  has_doubted_ = true;
  StartAnew(stamp,
            "scan matching and inertial unit disagree: the start begins anew to find out why");
  if (clock_offset_) clock_offset_.emplace(options_.rig.imu);  // it was found with wrong rates
  if (is_useless) ClassifyAnew();
  scouts_with_gyro_ = false;
}

// The filter is sure of itself and refuses what scan matching saw, as it does soon after driving
// off with a wrong reading. Told once: there may be other reasons.
bool Odometry::Impl::IsDoubtful() const {
  return !has_doubted_ && std::popcount(gated_scans_ & kLastScans) >= kMaxGated &&
         classifier_.FavoursAnother();
}

// A start would be wrong again as long as the doubts that ended the last one are not settled.
bool Odometry::Impl::IsInDoubt(Timestamp stamp) const {
  return resumption_ && !is_reading_settled_ && has_doubted_ &&
         SecondsBetween(resumption_->last_fix.stamp, stamp) < kMaxDoubt_s;
}

// Nothing is matched any more, and the gyro reads more than a vehicle's turns.
bool Odometry::Impl::IsGyroWild(Timestamp stamp) const {
  if (num_unmatched_in_a_row_ < kManyUnmatched) return false;
  const Vector3 bias = history_->head().state.gyro_bias;
  double sum_sq = 0.0;
  const std::vector<ImuSample> samples = SamplesBetween(stamp - kWildSpan, stamp);
  for (const ImuSample& sample : samples) sum_sq += (sample.w_imu_radps - bias).squaredNorm();
  return sum_sq > kWildRate_radps * kWildRate_radps * static_cast<double>(samples.size());
}

// The mean force over a rest: false when there cannot be a start from it.
bool Odometry::Impl::AcceptForceAtRest(const Vector3& mean_f_mps2, Timestamp stamp) {
  ImuSample mean;
  mean.f_imu_mps2 = mean_f_mps2;
  const Vector3 sent = FromSi(reading_, mean).f_imu_mps2;
  const ForceAtRest force = JudgeForceAtRest(sent, options_.rig.gravity_mps2);
  char seen[80];
  std::snprintf(seen, sizeof seen, "at rest the accelerometer reads %.2f", sent.norm());
  if (force == ForceAtRest::kUnclear) {
    SayWaiting(stamp, std::string(seen) + ", neither m/s^2 nor g nor without gravity: no start");
    return false;
  }
  if (!AcceptGravity(force != ForceAtRest::kWithoutGravity, seen, stamp)) return false;
  if (force == ForceAtRest::kWithoutGravity) return true;
  is_force_unit_told_ = true;
  classifier_.KeepForceUnit();
  ImuConvention found = reading_;
  found.is_in_g = force == ForceAtRest::kInG;
  if (found == reading_) return true;
  Adopt(found, seen, stamp);
  return false;
}

bool Odometry::Impl::MayBeDegrees(std::span<const ImuSample> samples) const {
  return options_.rig.imu.units == ImuUnits::kAutomatic && !reading_.is_in_deg &&
         IsNoiseOfDegrees(samples, options_.rig.imu);
}

// The rates over a rest: false when the start begins anew. Should they be in rad/s all the same,
// the drive tells.
bool Odometry::Impl::AcceptRatesAtRest(std::span<const ImuSample> samples, Timestamp stamp) {
  if (!MayBeDegrees(samples)) return true;
  ImuConvention found = reading_;
  found.is_in_deg = true;
  char seen[80];
  std::snprintf(seen, sizeof seen, "at rest the gyro's noise is %.2f", RateNoise(samples));
  Adopt(found, seen, stamp);
  return false;
}

// Is gravity in the forces of a drive? Absent where that is not clear.
std::optional<bool> Odometry::Impl::GravityInMotion(const Vector3& mean_f_mps2) const {
  if (mean_f_mps2.norm() > 0.5 * options_.rig.gravity_mps2) return true;
  return has_gravity_in_motion_ == false ? has_gravity_in_motion_ : std::nullopt;
}

bool Odometry::Impl::AcceptGravity(bool is_there, const std::string& evidence, Timestamp stamp) {
  const GravityInput expected = options_.rig.imu.gravity;
  const GravityInput found = is_there ? GravityInput::kPresent : GravityInput::kRemoved;
  if (expected == GravityInput::kAutomatic || expected == found) return true;
  const auto name = [](GravityInput g) {
    return std::string(kEnumNames<GravityInput>[static_cast<std::size_t>(g)]);
  };
  Refuse(stamp, "the accelerometer's gravity is " + name(found) + ", rig.imu.gravity says " +
                    name(expected) + " (" + evidence + "): set rig.imu.gravity: auto or " +
                    name(found));
  return false;
}

// Reads all samples so, those of the past seconds included, and begins the start anew with them.
void Odometry::Impl::Adopt(const ImuConvention& found, const std::string& evidence,
                           Timestamp stamp) {
  const Rig& rig = options_.rig;
  const std::string what = "inertial messages: " + Describe(found) + " (" + evidence + ")";
  if (rig.imu.units != ImuUnits::kAutomatic) {
    const auto units = static_cast<std::size_t>(rig.imu.units);
    Refuse(stamp, what + ", rig.imu.units says " + std::string(kEnumNames<ImuUnits>[units]) + ": " +
                      FixOf(found, rig));
    return;
  }
  if (resumption_ && !resumption_->is_by_lidar) TurnResumption(found);
  ReadAnewAs(found);
  ClassifyAnew();
  scouts_with_gyro_ = true;
  has_doubted_ = false;
  Say(stamp, Notice::Severity::kWarning, what);
  BeginScoutingAnew();
}

// What was published since a start with the axes that were believed was turned about it. The path
// in map is the lidar's, rigid; the filter's world was bent by a gravity that it took for another.
void Odometry::Impl::TurnResumption(const ImuConvention& found) {
  const Matrix3 R_found_believed = found.R_imu_sent * reading_.R_imu_sent.transpose();
  const Pose turn{Quaternion(Matrix3(R_found_believed.transpose())), Vector3::Zero()};
  const Pose& T_world_start = resumption_->T_world_start;
  const Pose T_start_map = resumption_->T_map_start.Inverse();
  LastFix& fix = resumption_->last_fix;
  const Pose since_start = T_start_map * fix.T_map_imu;
  const Vector3 v_imu = fix.T_world_imu.rotation.conjugate() * fix.v_world_imu;
  fix.T_world_imu = T_world_start * turn * since_start;
  fix.v_world_imu = fix.T_world_imu.rotation * v_imu;
  if (!is_map_by_lidar_) fix.T_map_imu = resumption_->T_map_start * turn * since_start;
}

// What could not be in the units that were believed until now comes back.
void Odometry::Impl::ReadAnewAs(const ImuConvention& found) {
  counters_.num_imu_out_of_range -= std::ssize(sent_) - std::ssize(imu_);
  imu_.clear();
  reading_ = found;
  for (const ImuSample& sent : sent_) {
    if (const std::optional<ImuSample> sample = Read(sent)) imu_.push_back(*sample);
  }
}

void Odometry::Impl::Refuse(Timestamp stamp, const std::string& why) {
  is_refused_ = true;
  ready_.clear();
  BeginScoutingAnew();
  Say(stamp, Notice::Severity::kError, why);
}

}  // namespace lio
