// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The verdict on a run: may its result be trusted, and if not, which entry of the configuration or
// which property of the data is the likeliest reason.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lio {

enum class Trust : std::int8_t { kYes = 0, kDoubtful = 1, kNo = 2 };

enum class CauseKind : std::int8_t {
  kClockOffset,
  kLeverArm,
  kExtrinsicRotation,
  kExtrinsicInverted,
  kImuAxes,
  kImuUnits,
  kImuGravity,
  kImuNoise,
  kImuSlow,
  kLidarModel,
  kPointTime,
  kOwnVehicle,
  kSaturation,
  kImuBroken,
  kLidarRepeats,
  kWayLost,
  kWayGuessed,
  kPlaceUnknown,
  kTwoSenders,
  kNoMotion,
  kNoScans,
  kNoImu,
};

// In the order of the enumerators; verdict.json has these words.
inline constexpr std::array<std::string_view, 3> kTrustNames = {"yes", "doubtful", "no"};
inline constexpr std::array<std::string_view, 22> kCauseNames = {
    "clock_offset", "lever_arm",   "extrinsic_rotation", "extrinsic_inverted", "imu_axes",
    "imu_units",    "imu_gravity", "imu_noise",          "imu_slow",           "lidar_model",
    "point_time",   "own_vehicle", "saturation",         "imu_broken",         "lidar_repeats",
    "way_lost",     "way_guessed", "place_unknown",      "two_senders",        "no_motion",
    "no_scans",     "no_imu"};

[[nodiscard]] constexpr std::string_view Name(Trust trust) {
  return kTrustNames[static_cast<std::size_t>(trust)];
}
[[nodiscard]] constexpr std::string_view Name(CauseKind kind) {
  return kCauseNames[static_cast<std::size_t>(kind)];
}

struct Cause {
  CauseKind kind = CauseKind::kNoScans;
  Trust leaves = Trust::kDoubtful;  // the most trust that is left beside this cause
  double sigma = 0.0;    // how many standard deviations off; 0 where it is counted, not estimated
  std::string evidence;  // one line
  std::string fix;       // YAML for the configuration; empty where no entry mends it
};

[[nodiscard]] constexpr bool IsOfExtrinsic(const Cause& cause) {
  return cause.kind == CauseKind::kExtrinsicRotation || cause.kind == CauseKind::kLeverArm ||
         cause.kind == CauseKind::kExtrinsicInverted;
}

// The filter claims this; absent where the drive was too short to say it.
struct ClaimedAccuracy {
  std::optional<double> position_std_m_per_100m;
  std::optional<double> tilt_std_deg;
};

struct Verdict {
  Trust trust = Trust::kNo;
  double coverage = 0.0;  // share of the input's time that has poses
  ClaimedAccuracy claimed;
  std::vector<Cause> causes;       // likeliest first
  std::vector<Cause> mended = {};  // found by the pass before, and no longer there
  double path_m = 0.0;             // length of the path
};

}  // namespace lio
