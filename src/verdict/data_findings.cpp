// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/data_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "lio/imu/rest.hpp"
#include "lio/verdict/rig_examiner.hpp"

namespace lio {
namespace {

constexpr const char* kWithoutImuYaml = "pipeline:\n  use_imu: false\n";

double Share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void FindMissing(const Counters& counters, const RunTally& tally, bool uses_imu,
                 std::vector<Cause>& causes) {
  if (counters.num_scans == counters.num_scans_empty) {
    causes.push_back(
        {CauseKind::kNoScans, Trust::kNo, 0.0,
         fmt::format("{} chunks came, no sweep with points was put together", counters.num_chunks),
         ""});
  } else if (tally.WithoutSweeps_s() > kDataFindings.max_without_s) {
    causes.push_back(
        {CauseKind::kNoScans, Trust::kDoubtful, 0.0,
         fmt::format("the IMU goes on for {:.1f} s after the last sweep", tally.WithoutSweeps_s()),
         ""});
  }
  if (uses_imu && counters.num_imu == 0) {
    causes.push_back({CauseKind::kNoImu, Trust::kDoubtful, 0.0,
                      "no inertial sample came: the path is the lidar's alone", kWithoutImuYaml});
  } else if (uses_imu && tally.IsImuSlow()) {
    causes.push_back({CauseKind::kImuSlow, Trust::kDoubtful, 0.0,
                      fmt::format("most inertial samples come {:.0f} ms and more after the one "
                                  "before, and do not tell the motion between: 100 Hz and more "
                                  "would; without them the path is the lidar's alone",
                                  1e3 * kRunTally.slow_imu_s),
                      kWithoutImuYaml});
  } else if (uses_imu && tally.WithoutImu_s() > kDataFindings.max_without_s) {
    causes.push_back({CauseKind::kNoImu, Trust::kDoubtful, 0.0,
                      fmt::format("sweeps go on for {:.1f} s after the last inertial sample",
                                  tally.WithoutImu_s()),
                      ""});
  }
}

void FindDoubled(const Counters& counters, std::vector<Cause>& causes) {
  const double imu = Share(counters.num_imu_duplicate + counters.num_imu_late, counters.num_imu);
  const double chunks = Share(counters.num_chunks_duplicate, counters.num_chunks);
  if (std::max(imu, chunks) <= kDataFindings.max_doubled_share) return;
  causes.push_back({CauseKind::kTwoSenders, Trust::kDoubtful, 0.0,
                    fmt::format("{:.0f} % of the inertial samples came twice or late, {:.0f} % of "
                                "the chunks twice: do two programs send on these channels?",
                                100.0 * imu, 100.0 * chunks),
                    ""});
}

void FindNoise(const ImuNoiseRatios& noise, const ImuRig& imu, std::vector<Cause>& causes) {
  const auto is_useless = [](double ratio, double rig_density, double max_density) {
    return ratio >= kDataFindings.max_noise_ratio && ratio * rig_density >= max_density;
  };
  if (!is_useless(noise.gyro, imu.gyro_noise_density, kDataFindings.max_gyro_density) &&
      !is_useless(noise.accel, imu.accel_noise_density, kDataFindings.max_accel_density)) {
    return;
  }
  causes.push_back({CauseKind::kImuNoise, Trust::kDoubtful, 0.0,
                    fmt::format("the gyro's noise is {:.0f} times, the accelerometer's {:.0f} "
                                "times that of the rig, most of the time",
                                noise.gyro, noise.accel),
                    ""});
}

void FindBroken(const Counters& counters, std::vector<Cause>& causes) {
  if (counters.num_imu_contradicted > 0) {
    causes.push_back(
        {CauseKind::kImuBroken, Trust::kDoubtful, 0.0,
         fmt::format("times that scans and IMU contradicted each other on the way, and "
                     "the path followed the scans: {}; has the IMU broken, or has "
                     "the lidar been moved?",
                     counters.num_imu_contradicted),
         ""});
  }
  if (counters.num_imu_stuck > 0) {
    causes.push_back(
        {CauseKind::kImuBroken, Trust::kYes, 0.0,
         fmt::format("times that an axis of the IMU stopped, and the path followed the "
                     "scans alone: {}",
                     counters.num_imu_stuck),
         ""});
  }
  if (counters.num_scans_repeated > 0) {
    causes.push_back({CauseKind::kLidarRepeats, Trust::kDoubtful, 0.0,
                      fmt::format("{} sweeps had the points of the sweep before, although the body "
                                  "had moved",
                                  counters.num_scans_repeated),
                      ""});
  }
}

void FindLost(const Counters& counters, std::vector<Cause>& causes) {
  if (counters.num_lost == 0) return;
  causes.push_back({CauseKind::kWayLost, Trust::kDoubtful, 0.0,
                    fmt::format("times that the way was lost, and the map began anew where the "
                                "body was believed to be: {}",
                                counters.num_lost),
                    ""});
}

void FindGuessed(const RunTally& tally, std::vector<Cause>& causes) {
  if (tally.Guessed_s() <= kDataFindings.max_guessed_s) return;
  causes.push_back(
      {CauseKind::kWayGuessed, Trust::kDoubtful, 0.0,
       fmt::format("for {:.1f} s in a row scans showed no motion along some direction, "
                   "as in a plain tunnel, and no IMU told it: the path there is a guess",
                   tally.Guessed_s()),
       ""});
}

}  // namespace

std::vector<Cause> FindDataFaults(const Counters& counters, const RunTally& tally,
                                  const ImuRig* imu) {
  std::vector<Cause> causes;
  FindMissing(counters, tally, imu != nullptr, causes);
  FindDoubled(counters, causes);
  if (const double bad = Share(counters.num_chunks_bad, counters.num_chunks);
      bad > kDataFindings.max_bad_chunk_share) {
    causes.push_back({CauseKind::kPointTime, Trust::kDoubtful, 0.0,
                      fmt::format("{:.0f} % of the chunks are refused: index, count or time span "
                                  "of their points are inconsistent",
                                  100.0 * bad),
                      ""});
  }
  if (const double clipped = Share(counters.num_imu_clipped, counters.num_imu);
      clipped > kDataFindings.max_clipped_share) {
    causes.push_back({CauseKind::kSaturation, Trust::kDoubtful, 0.0,
                      fmt::format("{:.1f} % of the inertial samples are at the end of their range",
                                  100.0 * clipped),
                      ""});
  }
  FindBroken(counters, causes);
  FindLost(counters, causes);
  FindGuessed(tally, causes);
  if (imu != nullptr) FindNoise(tally.MedianNoise(), *imu, causes);
  // Nobody knows what the body did while it had no poses.
  const bool is_watched = tally.Coverage() >= kRigExaminer.doubtful_coverage;
  const bool is_still = is_watched && tally.num_rows() > 0 &&
                        tally.path_m() < kRest.whole_run.max_path_m &&
                        tally.turned_rad() < kRest.whole_run.max_turn_rad;
  if (is_still && causes.empty()) {
    causes.push_back({CauseKind::kNoMotion, Trust::kYes, 0.0,
                      "the body stood: clock offset, rotation and lever arm were not checked", ""});
  }
  return causes;
}

}  // namespace lio
