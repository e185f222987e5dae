// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/foxglove_schemas.hpp"

#include <nlohmann/json.hpp>

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

Json Typed(const char* type) {
  return {{"type", type}};
}
Json NumberType() {
  return Typed("number");
}

Json Object(const Json& properties, const char* title = nullptr) {
  Json object = {{"type", "object"}, {"properties", properties}};
  if (title != nullptr) object["title"] = title;
  return object;
}

Json ArrayOf(const Json& items) {
  return {{"type", "array"}, {"items", items}};
}

Json WholeNumbers(const char* first, const char* second) {
  const Json whole = {{"type", "integer"}, {"minimum", 0}};
  return Object({{first, whole}, {second, whole}});
}

Json Time() {
  return WholeNumbers("sec", "nsec");
}

Json Vector() {
  return Object({{"x", NumberType()}, {"y", NumberType()}, {"z", NumberType()}});
}

Json Rotation() {
  return Object(
      {{"x", NumberType()}, {"y", NumberType()}, {"z", NumberType()}, {"w", NumberType()}});
}

Json PoseType() {
  return Object({{"position", Vector()}, {"orientation", Rotation()}});
}

Json ColourType() {
  return Object(
      {{"r", NumberType()}, {"g", NumberType()}, {"b", NumberType()}, {"a", NumberType()}});
}

}  // namespace

std::string PointCloudSchema() {
  const Json field =
      Object({{"name", Typed("string")}, {"offset", Typed("integer")}, {"type", Typed("integer")}});
  return Object({{"timestamp", Time()},
                 {"frame_id", Typed("string")},
                 {"pose", PoseType()},
                 {"point_stride", Typed("integer")},
                 {"fields", ArrayOf(field)},
                 {"data", {{"type", "string"}, {"contentEncoding", "base64"}}}},
                "foxglove.PointCloud")
      .dump();
}

std::string PoseInFrameSchema() {
  return Object({{"timestamp", Time()}, {"frame_id", Typed("string")}, {"pose", PoseType()}},
                "foxglove.PoseInFrame")
      .dump();
}

std::string PosesInFrameSchema() {
  return Object(
             {{"timestamp", Time()}, {"frame_id", Typed("string")}, {"poses", ArrayOf(PoseType())}},
             "foxglove.PosesInFrame")
      .dump();
}

std::string FrameTransformSchema() {
  return Object({{"timestamp", Time()},
                 {"parent_frame_id", Typed("string")},
                 {"child_frame_id", Typed("string")},
                 {"translation", Vector()},
                 {"rotation", Rotation()}},
                "foxglove.FrameTransform")
      .dump();
}

// All kinds of primitives have their place in an entity; those that are not used stay empty arrays.
std::string SceneUpdateSchema() {
  const Json sphere = Object({{"pose", PoseType()}, {"size", Vector()}, {"color", ColourType()}});
  Json entity = {
      {"timestamp", Time()},
      {"frame_id", Typed("string")},
      {"id", Typed("string")},
      {"lifetime", WholeNumbers("sec", "nsec")},
      {"frame_locked", Typed("boolean")},
      {"metadata", ArrayOf(Object({{"key", Typed("string")}, {"value", Typed("string")}}))},
      {"spheres", ArrayOf(sphere)}};
  for (const char* kind :
       {"arrows", "cubes", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[kind] = ArrayOf(Typed("object"));
  }
  return Object({{"deletions", ArrayOf(Typed("object"))}, {"entities", ArrayOf(Object(entity))}},
                "foxglove.SceneUpdate")
      .dump();
}

std::string LogSchema() {
  return Object({{"timestamp", Time()},
                 {"level", Typed("integer")},
                 {"message", Typed("string")},
                 {"name", Typed("string")},
                 {"file", Typed("string")},
                 {"line", Typed("integer")}},
                "foxglove.Log")
      .dump();
}

std::string PlotSchema(const std::string& title) {
  return Object({{"timestamp", Time()}}, title.c_str()).dump();
}

}  // namespace lio
