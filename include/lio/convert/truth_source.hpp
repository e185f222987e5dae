// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the reference poses of a bag's truth topic, whatever its type, to a TUM file row by row.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "lio/convert/bag_reader.hpp"
#include "lio/convert/inspvax.hpp"

namespace lio {

struct TruthCounts {
  std::int64_t num_rows = 0;       // rows written
  std::int64_t num_damaged = 0;    // messages that cannot be decoded
  std::int64_t num_not_good = 0;   // INSPVAX rows whose status is not "solution good"
  std::int64_t num_not_later = 0;  // rows whose stamps do not increase
  std::optional<Timestamp> first;  // stamps of the rows written
  std::optional<Timestamp> last;
  double delay_sum_s = 0.0;  // receive time minus stamp, over the rows written
};

// Returns true for nav_msgs/Odometry, geometry_msgs/PoseStamped and every INSPVAX.
[[nodiscard]] bool IsTruthType(const std::string& type);

class TruthSource {
 public:
  // Throws InputError when the topic's type cannot be read, which is an INSPVAX without a
  // definition.
  TruthSource(const BagTopic& topic, const std::filesystem::path& tum_file);

  void Add(const BagMessage& message);
  // Throws std::runtime_error when the file could not be written.
  void Close();

  const TruthCounts& counts() const { return counts_; }
  // Says, for the user, in which frame the poses are and of which body.
  [[nodiscard]] std::string description() const;

 private:
  struct Decoded {
    bool is_sound = false;
    std::optional<StampedPose> pose;  // empty for a sound row whose status is not good
  };
  [[nodiscard]] Decoded Decode(const BagMessage& message);

  BagTopic topic_;
  std::optional<RosSchema> schema_;  // used for INSPVAX
  LocalFrame local_frame_;
  std::filesystem::path path_;
  std::ofstream file_;
  TruthCounts counts_;
};

}  // namespace lio
