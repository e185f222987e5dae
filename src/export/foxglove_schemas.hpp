// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives JSON schemas of the types that an exported MCAP file has: Foxglove's well-known ones, of
// which the viewers know the names (docs.foxglove.dev, "Foxglove schemas"), and our own for plots.
#pragma once

#include <string>

namespace lio {

[[nodiscard]] std::string PointCloudSchema();
[[nodiscard]] std::string PoseInFrameSchema();
[[nodiscard]] std::string PosesInFrameSchema();
[[nodiscard]] std::string FrameTransformSchema();
[[nodiscard]] std::string SceneUpdateSchema();
[[nodiscard]] std::string LogSchema();
// Describes an object with a timestamp and numbers, vectors and texts of any name.
[[nodiscard]] std::string PlotSchema(const std::string& title);

}  // namespace lio
