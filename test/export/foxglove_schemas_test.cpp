// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/foxglove_schemas.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lio {
namespace {

using nlohmann::json;

TEST(FoxgloveSchemas, AreObjectsWithTheNameOfTheirType) {
  const std::pair<std::string, std::string> schemas[] = {
      {PointCloudSchema(), "foxglove.PointCloud"},
      {PoseInFrameSchema(), "foxglove.PoseInFrame"},
      {PosesInFrameSchema(), "foxglove.PosesInFrame"},
      {FrameTransformSchema(), "foxglove.FrameTransform"},
      {SceneUpdateSchema(), "foxglove.SceneUpdate"},
      {LogSchema(), "foxglove.Log"},
      {PlotSchema("lio.Odometry"), "lio.Odometry"}};
  for (const auto& [text, title] : schemas) {
    const json schema = json::parse(text);
    EXPECT_EQ(schema["type"], "object");
    EXPECT_EQ(schema["title"], title);
  }
}

TEST(FoxgloveSchemas, BytesAreBase64) {
  EXPECT_EQ(json::parse(PointCloudSchema())["properties"]["data"],
            json({{"type", "string"}, {"contentEncoding", "base64"}}));
}

}  // namespace
}  // namespace lio
