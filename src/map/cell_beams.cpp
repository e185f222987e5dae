// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/cell_beams.hpp"

#include <limits>

namespace lio {
namespace {

constexpr int kMaxCount = std::numeric_limits<std::uint8_t>::max();

BeamShift Mean(const BeamShift& a, const BeamShift& b, float share_of_b) {
  return {a.range + share_of_b * (b.range - a.range),
          a.elevation + share_of_b * (b.elevation - a.elevation),
          a.azimuth + share_of_b * (b.azimuth - a.azimuth)};
}

CellBeams::OfRing Merged(const CellBeams::OfRing& a, const CellBeams::OfRing& b) {
  const int num_points = a.num_points + b.num_points;
  CellBeams::OfRing merged;
  merged.ring = a.num_points >= b.num_points ? a.ring : b.ring;
  merged.shift =
      Mean(a.shift, b.shift, static_cast<float>(b.num_points) / static_cast<float>(num_points));
  merged.num_points = static_cast<std::uint8_t>(std::min(num_points, kMaxCount));
  return merged;
}

}  // namespace

void CellBeams::Add(const SeenBeam& beam, const Eigen::Vector3f& normal, float scan_path_m) {
  if (beam.ring >= kMaxCalibratedRings) return;
  const BeamShift shift = ShiftAlong(normal, beam.axes);
  const float share = 1.f / static_cast<float>(++num_points);
  const auto take = [&](float value, float& mean) { mean += share * (value - mean); };
  take(scan_path_m, path_m);
  take(shift.azimuth * beam.axes.cos_azimuth, cos_azimuth);
  take(shift.azimuth * beam.axes.sin_azimuth, sin_azimuth);
  take(GrazingShift(shift.range), grazing);
  take(normal.dot(beam.correction_m), correction_m);
  AddToRing(static_cast<std::uint8_t>(beam.ring), shift);
}

void CellBeams::AddToRing(std::uint8_t ring, const BeamShift& shift) {
  auto at = std::find_if(rings.begin(), rings.end(), [&](const OfRing& each) {
    return each.num_points == 0 || each.ring >= ring;
  });
  if (at == rings.end() || at->num_points == 0 || at->ring != ring) {
    if (rings.back().num_points > 0) {
      MergeNearest();
      AddToRing(ring, shift);
      return;
    }
    std::move_backward(at, rings.end() - 1, rings.end());
    *at = {shift, ring, 1};
    return;
  }
  if (at->num_points == kMaxCount) {
    for (OfRing& each : rings) {
      each.num_points = static_cast<std::uint8_t>((each.num_points + 1) / 2);
    }
  }
  ++at->num_points;
  at->shift = Mean(at->shift, shift, 1.f / static_cast<float>(at->num_points));
}

// Makes room: of all rings the two that are nearest to each other become one.
void CellBeams::MergeNearest() {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
    if (rings[i + 1].ring - rings[i].ring < rings[nearest + 1].ring - rings[nearest].ring) {
      nearest = i;
    }
  }
  rings[nearest] = Merged(rings[nearest], rings[nearest + 1]);
  std::move(rings.begin() + static_cast<std::ptrdiff_t>(nearest) + 2, rings.end(),
            rings.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
  rings.back() = {};
}

}  // namespace lio
