// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts one cloud of a recording to one sweep, by the rules derived from its first clouds.
#pragma once

#include "convert/sweep_to_chunks.hpp"
#include "lio/convert/rosbag_convert.hpp"

namespace lio {

enum class CloudStatus {
  kOk,
  kEmpty,        // there is no usable return
  kWrongFields,  // x, y, z or the point time that the other clouds have is missing
  kBadTime,      // the point times form no sweep near the stamp
};

class CloudToSweep {
 public:
  // `rules` must outlive the object.
  explicit CloudToSweep(const CloudRules& rules)
      : rules_(&rules), spin_rate_(rules.spin.rate_radps) {}

  [[nodiscard]] CloudStatus Convert(const RosCloud& cloud, TimedSweep& sweep);
  [[nodiscard]] const CloudPoints& points() const { return points_; }  // points of the last cloud

 private:
  [[nodiscard]] std::optional<std::vector<std::int64_t>> Instants(
      const RosCloud& cloud, std::span<const std::uint16_t> rings);

  const CloudRules* rules_;
  SpinRate spin_rate_;
  CloudPoints points_;
};

}  // namespace lio
