// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/lidar_beams.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace lio {
namespace {

using Values = std::vector<double>;

BeamErrors ByRing(const Values& range_m, const Values& elevation_rad, const Values& azimuth_rad,
                  const Values& encoder_rad) {
  BeamErrors errors;
  errors.encoder_rad = {static_cast<float>(encoder_rad[0]), static_cast<float>(encoder_rad[1])};
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    errors.rings.push_back({static_cast<float>(range_m[i]), static_cast<float>(elevation_rad[i]),
                            static_cast<float>(azimuth_rad[i])});
  }
  return errors;
}

// A micrometre, or ten nanoradians: far below any error, and short to print.
double RoundedLength(float value_m) {
  return std::round(static_cast<double>(value_m) * 1e6) / 1e6;
}
double RoundedAngle(float value_rad) {
  return std::round(static_cast<double>(value_rad) * 1e8) / 1e8;
}

void Split(const BeamErrors& errors, Values& range_m, Values& elevation_rad, Values& azimuth_rad,
           Values& encoder_rad) {
  encoder_rad = {RoundedAngle(errors.encoder_rad.x()), RoundedAngle(errors.encoder_rad.y())};
  for (const BeamErrors::OfRing& ring : errors.rings) {
    range_m.push_back(RoundedLength(ring.range_m));
    elevation_rad.push_back(RoundedAngle(ring.elevation_rad));
    azimuth_rad.push_back(RoundedAngle(ring.azimuth_rad));
  }
}

}  // namespace

BeamKnowledge KnownBeams(const LidarRig& rig) {
  if (!rig.beams) return {};
  const LidarBeams& beams = *rig.beams;
  return {ByRing(beams.range_m, beams.elevation_rad, beams.azimuth_rad, beams.encoder_rad),
          ByRing(beams.range_std_m, beams.elevation_std_rad, beams.azimuth_std_rad,
                 beams.encoder_std_rad)};
}

std::optional<LidarBeams> AsLidarBeams(const BeamKnowledge& known) {
  if (known.std.rings.empty()) return std::nullopt;
  LidarBeams beams;
  Split(known.errors, beams.range_m, beams.elevation_rad, beams.azimuth_rad, beams.encoder_rad);
  Split(known.std, beams.range_std_m, beams.elevation_std_rad, beams.azimuth_std_rad,
        beams.encoder_std_rad);
  return beams;
}

}  // namespace lio
