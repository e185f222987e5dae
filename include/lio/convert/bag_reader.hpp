// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads recorded ROS drives in one way, whatever their form: ROS 1 bags, ROS 2 folders and
// MCAP files give the same stream of messages in the order in which they were recorded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/convert/ros_cursor.hpp"

namespace lio {

struct BagTopic {
  std::string name;
  std::string type;        // in ROS 1's form, "sensor_msgs/Imu"
  std::string definition;  // message definition with its parts; empty when the bag has none
  RosEncoding encoding = RosEncoding::kRos1;
  std::int64_t num_messages = 0;  // read so far
};

struct BagMessage {
  std::size_t topic = 0;  // index into topics()
  Timestamp received;
  ByteView data;  // valid until the next call of Next()
};

// Describes the damage of a file. Everything is zero for a sound file.
struct BagDamage {
  bool cut_short = false;                 // the end is missing, or unreadable from some place on
  bool not_closed = false;                // the recorder never wrote the index
  std::int64_t lost_bytes = 0;            // bytes not read because of damage, missing ones included
  std::int64_t num_chunks_damaged = 0;    // compressed chunks with broken content
  std::int64_t num_messages_damaged = 0;  // records that are no messages, e.g. of impossible length
  std::int64_t num_messages_missing = 0;  // compared with the count in a ROS 2 bag's metadata
  std::string first_reason;               // e.g. "record header of 4000000000 bytes at byte 1234"

  [[nodiscard]] bool Any() const {
    return cut_short || not_closed || num_chunks_damaged > 0 || num_messages_damaged > 0;
  }
};

class BagReader {
 public:
  virtual ~BagReader() = default;

  // Returns all topics seen so far, from the index if there is one. Indices stay valid; without an
  // index the list grows while reading.
  [[nodiscard]] virtual const std::vector<BagTopic>& topics() const = 0;
  // Returns whether the list of topics is complete already.
  [[nodiscard]] virtual bool knows_all_topics() const = 0;
  // Only messages of topics that `wanted` accepts are returned and copied; the default is all.
  virtual void Select(std::function<bool(const BagTopic&)> wanted) = 0;
  // Reads the next message. Returns false at the end, and at damage after which nothing can be
  // read.
  [[nodiscard]] virtual bool Next(BagMessage& message) = 0;
  [[nodiscard]] virtual const BagDamage& damage() const = 0;

  // Returns the receive time of the first message of any topic, once one was read.
  [[nodiscard]] virtual std::optional<Timestamp> begin_time() const = 0;
  [[nodiscard]] virtual std::int64_t position_bytes() const = 0;  // used by progress bars
  [[nodiscard]] virtual std::int64_t size_bytes() const = 0;
};

// Opens a ROS 1 bag (a file, or the folder of a split recording, whose bags are joined), a ROS 2
// bag (its folder, its metadata.yaml or one .db3 file), or an MCAP file of either. Throws
// InputError that names the path when it is neither.
[[nodiscard]] std::unique_ptr<BagReader> OpenBag(const std::filesystem::path& path);

[[nodiscard]] std::unique_ptr<BagReader> OpenRosbag1(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<BagReader> OpenRosbag2(const std::filesystem::path& path);

}  // namespace lio
