// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Assigns ring numbers that begin with 0 at the lowest beam, whatever the source's numbers are:
// drivers count from the bottom (Velodyne), from the top (Ouster, Hesai) or not at all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lio/convert/pointcloud2_layout.hpp"
#include "lio/io/beam_table.hpp"

namespace lio {

struct RingRule {
  enum class Source {
    kNone,    // every point gets ring 0
    kField,   // the ring field, mapped by `ring_of_source`
    kRow,     // the row of an organised cloud, mapped
    kColumn,  // its column, mapped
    kModel,   // the nearest elevation in the beam table
  };
  Source source = Source::kNone;
  std::vector<std::uint16_t> ring_of_source;
  BeamTable table;          // used by kModel
  std::string description;  // for the user, e.g. "from field 'ring', counted from below"
};

// Observes the first clouds of a recording.
class RingObserver {
 public:
  void Add(const CloudPoints& points, std::uint32_t height, std::uint32_t width);
  // `table` is the model that the user named, if any.
  [[nodiscard]] RingRule Decide(const std::optional<BeamTable>& table) const;

 private:
  struct Elevations {
    std::vector<double> sum_rad;  // one per source number
    std::vector<std::int64_t> count;

    void Add(std::size_t number, double elevation_rad);
    [[nodiscard]] std::vector<std::uint16_t> RingOfSource(std::string& order) const;
  };

  Elevations by_field_;
  Elevations by_row_;
  Elevations by_column_;
  bool has_field_ = false;
  bool field_is_ring_ = true;  // false: negative or huge numbers were seen
  std::uint32_t max_height_ = 0;
  std::uint32_t max_width_ = 0;
};

// Returns one ring per point; empty for kNone.
[[nodiscard]] std::vector<std::uint16_t> AssignRings(const RingRule& rule,
                                                     const CloudPoints& points);

}  // namespace lio
