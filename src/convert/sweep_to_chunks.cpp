// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/sweep_to_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lio {

TimedSweep SortSweep(std::vector<LidarPoint> points, std::span<const std::int64_t> instants_ns) {
  TimedSweep sweep;
  if (points.empty()) return sweep;
  const auto [first, last] = std::minmax_element(instants_ns.begin(), instants_ns.end());
  sweep.first = Timestamp{*first};
  sweep.last = Timestamp{*last};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].t_offset_ns = static_cast<std::uint32_t>(instants_ns[i] - sweep.first.ns);
  }
  if (!std::is_sorted(instants_ns.begin(), instants_ns.end())) {
    std::stable_sort(points.begin(), points.end(), [](const LidarPoint& a, const LidarPoint& b) {
      return a.t_offset_ns < b.t_offset_ns;
    });
  }
  sweep.points = std::move(points);
  return sweep;
}

std::vector<SentChunk> SplitSweep(const TimedSweep& sweep, std::int32_t scan_seq,
                                  Timestamp received, std::size_t max_points) {
  const std::size_t num_chunks = (sweep.points.size() + max_points - 1) / max_points;
  std::vector<SentChunk> sent(num_chunks);
  for (std::size_t i = 0; i < num_chunks; ++i) {
    const std::size_t begin = i * max_points;
    const std::size_t end = std::min(begin + max_points, sweep.points.size());
    ScanChunk& chunk = sent[i].chunk;
    chunk.points.assign(sweep.points.begin() + static_cast<std::ptrdiff_t>(begin),
                        sweep.points.begin() + static_cast<std::ptrdiff_t>(end));
    const std::uint32_t first_ns = chunk.points.front().t_offset_ns;
    const std::uint32_t last_ns = chunk.points.back().t_offset_ns;
    for (LidarPoint& point : chunk.points) point.t_offset_ns -= first_ns;
    chunk.stamp = sweep.first + Duration{first_ns};
    chunk.scan_seq = scan_seq;
    chunk.chunk_index = static_cast<std::int16_t>(i);
    chunk.chunk_count = static_cast<std::int16_t>(num_chunks);
    sent[i].sent = received - (sweep.last - (sweep.first + Duration{last_ns}));
  }
  return sent;
}

std::uint16_t QuantiseIntensity(float intensity) {
  if (!(intensity > 0.0f)) return 0;
  return static_cast<std::uint16_t>(std::lround(std::min(intensity, 65535.0f)));
}

}  // namespace lio
