// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads from a bag's /tf_static how one sensor is mounted on the other.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/convert/ros_cursor.hpp"

namespace lio {

// p_parent = T_parent_child * p_child.
struct FrameLink {
  std::string parent;
  std::string child;
  Pose T_parent_child;
};

// Decodes a tf2_msgs/TFMessage (tf/tfMessage is the same). Returns nothing when its bytes are not
// exactly one; transforms without a rotation are left out.
[[nodiscard]] std::optional<std::vector<FrameLink>> DecodeRosTransforms(ByteView bytes,
                                                                        RosEncoding encoding);

// Holds the links between frames. tf forbids two parents of a frame, so a later link of the same
// child replaces the earlier one.
class FrameTree {
 public:
  void Add(const FrameLink& link);
  // Returns T_target_source; nothing when the frames are not connected.
  [[nodiscard]] std::optional<Pose> Find(const std::string& target,
                                         const std::string& source) const;
  bool empty() const { return links_.empty(); }

 private:
  struct Ancestor {
    std::string frame;
    Pose T_ancestor_frame;
  };
  [[nodiscard]] std::vector<Ancestor> AncestorsOf(const std::string& frame) const;

  std::map<std::string, FrameLink> links_;  // by child
};

struct MountedSensors {
  std::string lidar_frame;  // frame id in the headers; empty when there was no message
  std::string imu_frame;
  bool has_static_transforms = false;
  std::optional<Pose> T_imu_lidar;  // from /tf_static, where it connects the two frames
};

// Reads the bag's beginning, a minute of it at most, until all is known. Throws InputError when the
// bag cannot be opened.
[[nodiscard]] MountedSensors FindMounting(const std::filesystem::path& bag,
                                          const std::string& lidar_topic,
                                          const std::string& imu_topic);

}  // namespace lio
