// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One cloud of a recording to one sweep, by the rules that its first clouds gave.
#pragma once

#include "lio/convert/rosbag_convert.hpp"
#include "lio/convert/sweep_to_chunks.hpp"

namespace lio {

enum class CloudStatus {
  kOk,
  kEmpty,        // not one usable return
  kWrongFields,  // no x y z, or the point time that the others have is missing
  kBadTime,      // point times that are no sweep near the stamp
};

class CloudToSweep {
 public:
  // `rules` outlives the object.
  explicit CloudToSweep(const CloudRules& rules)
      : rules_(&rules), spin_rate_(rules.spin.rate_radps) {}

  CloudStatus Convert(const RosCloud& cloud, TimedSweep& sweep);
  const CloudPoints& points() const { return points_; }  // of the last cloud

 private:
  std::optional<std::vector<std::int64_t>> Instants(const RosCloud& cloud,
                                                    std::span<const std::uint16_t> rings);

  const CloudRules* rules_;
  SpinRate spin_rate_;
  CloudPoints points_;
};

}  // namespace lio
