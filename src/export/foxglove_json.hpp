// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes liod's messages as JSON of Foxglove's types, and as plain JSON for plots.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lio/io/status_report.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

inline constexpr const char* kWorldFrame = "world";
inline constexpr const char* kMapFrame = "map";
inline constexpr const char* kImuFrame = "imu";
inline constexpr const char* kLidarFrame = "lidar";

[[nodiscard]] std::string Base64(std::string_view bytes);

// Points that are not finite are left out. The fields are x, y, z [m], intensity and ring.
[[nodiscard]] std::string PointCloudJson(const ScanChunk& chunk, const char* frame);
[[nodiscard]] std::string PoseJson(Timestamp stamp, const char* frame, const Pose& pose);
[[nodiscard]] std::string PosesJson(Timestamp stamp, const char* frame,
                                    std::span<const Pose> poses);
// Returns the pose of `child` in `parent`.
[[nodiscard]] std::string TransformJson(Timestamp stamp, const char* parent, const char* child,
                                        const Pose& T_parent_child);
// Returns the ellipsoid of three standard deviations of the position, in world.
[[nodiscard]] std::string EllipsoidJson(const NavOutput& nav);
[[nodiscard]] std::string LogJson(Timestamp stamp, Trust trust, std::string_view text);

[[nodiscard]] std::string OdometryPlotJson(const NavOutput& nav);
[[nodiscard]] std::string StatePlotJson(const FilterReport& report);
[[nodiscard]] std::string MatchPlotJson(const ScanReport& report);
[[nodiscard]] std::string StatusPlotJson(const StatusReport& report);
[[nodiscard]] std::string ImuPlotJson(const ImuSample& sample);

}  // namespace lio
