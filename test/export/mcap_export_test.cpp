// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads an exported file back: topics, types, and that every message has what its schema names.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "export/mcap_parts.hpp"
#include "export/recorded_log.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/export/export_log.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

using nlohmann::json;

// Whether a value is of the form that a schema's type, properties and items ask for.
bool Agrees(const json& value, const json& schema) {
  const std::string type = schema.value("type", "");
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") {
    return value.is_array() && std::all_of(value.begin(), value.end(), [&](const json& item) {
             return Agrees(item, schema["items"]);
           });
  }
  if (type != "object" || !value.is_object()) return false;
  const json properties = schema.value("properties", json::object());
  return std::all_of(properties.items().begin(), properties.items().end(), [&](const auto& entry) {
    return value.contains(entry.key()) && Agrees(value[entry.key()], entry.value());
  });
}

// Returns the schemas in a file's summary by the name of their type.
std::map<std::string, json> SchemasOf(const std::string& bytes) {
  constexpr std::size_t kMagicBytes = 8;
  constexpr int kSchema = 0x03;
  std::map<std::string, json> schemas;
  for (const auto& part : test::McapParts(bytes, kMagicBytes, bytes.size() - kMagicBytes)) {
    if (part.op != kSchema) continue;
    test::McapCursor cursor(part.content);
    (void)cursor.Number(2);
    const std::string name(cursor.Text());
    EXPECT_EQ(cursor.Text(), "jsonschema");
    schemas[name] = json::parse(cursor.Text());
  }
  return schemas;
}

class McapExportTest : public ::testing::Test {
 protected:
  void Export(const ExportOptions& options = {}) {
    counts_ = ExportMcap(test::RecordedLog(folder_), file_, options);
    auto schemas = SchemasOf(test::ReadText(file_));
    const auto reader = OpenBag(file_);
    for (BagMessage message; reader->Next(message);) {
      const BagTopic& topic = reader->topics()[message.topic];
      json value = json::parse(message.data.begin(), message.data.end());
      const std::string type = topic.type.substr(0, topic.type.find(' '));  // "... as jsonschema"
      EXPECT_TRUE(Agrees(value, schemas[type])) << topic.name << " " << value;
      types_[topic.name] = type;
      messages_[topic.name].push_back(std::move(value));
    }
    EXPECT_FALSE(reader->damage().Any());
  }

  test::TempDir folder_;
  std::filesystem::path file_ = folder_.path() / "out.mcap";
  ExportCounts counts_;
  std::map<std::string, std::string> types_;
  std::map<std::string, std::vector<json>> messages_;
};

TEST_F(McapExportTest, TopicsHaveFoxglovesTypes) {
  Export();
  EXPECT_EQ(counts_.num_messages, 4 * test::kNumScans + 6);
  const std::map<std::string, std::string> expected = {
      {"/tf", "foxglove.FrameTransform"},      {"/liod/pose", "foxglove.PoseInFrame"},
      {"/liod/path", "foxglove.PosesInFrame"}, {"/liod/uncertainty", "foxglove.SceneUpdate"},
      {"/liod/cloud", "foxglove.PointCloud"},  {"/liod/notices", "foxglove.Log"},
      {"/liod/odometry", "lio.Odometry"},      {"/liod/state", "lio.FilterState"},
      {"/liod/match", "lio.Registration"},     {"/liod/status", "lio.Status"}};
  for (const auto& [topic, type] : expected) {
    EXPECT_EQ(types_[topic], type) << topic;
  }
  EXPECT_EQ(types_.size(), expected.size());
}

TEST_F(McapExportTest, FramesAreATreeFromWorldOverMapToImu) {
  Export();
  const auto& tf = messages_["/tf"];
  ASSERT_EQ(tf.size(), 2U * test::kNumScans);
  EXPECT_EQ(tf[0]["parent_frame_id"], "world");
  EXPECT_EQ(tf[0]["child_frame_id"], "map");
  EXPECT_EQ(tf[1]["parent_frame_id"], "map");
  EXPECT_EQ(tf[1]["child_frame_id"], "imu");
  EXPECT_EQ(tf[21]["translation"]["x"], 5.0);
}

TEST_F(McapExportTest, ThePathIsToldAsItGrowsAndOnceWhole) {
  Export();
  const auto& paths = messages_["/liod/path"];
  ASSERT_GE(paths.size(), 4U);
  EXPECT_LE(paths.size(), 7U);
  EXPECT_EQ(paths.front()["poses"].size(), 10U);
  EXPECT_EQ(paths.back()["poses"].size(), static_cast<std::size_t>(test::kNumScans));
}

TEST_F(McapExportTest, ANoticeIsToldOnce) {
  Export();
  ASSERT_EQ(messages_["/liod/notices"].size(), 2U);
  EXPECT_EQ(messages_["/liod/notices"][1]["message"], "a gap");
}

TEST_F(McapExportTest, InputsComeWhenAskedFor) {
  ExportOptions options;
  options.with_inputs = true;
  options.compression = McapCompression::kLz4;
  Export(options);
  EXPECT_EQ(messages_["/imu"].size(), static_cast<std::size_t>(test::kNumScans));
}

TEST_F(McapExportTest, NoFileIsLeftOfALogWithoutMessages) {
  ExportOptions options;
  options.channel_prefix = "CAR_";
  EXPECT_THROW(ExportMcap(test::RecordedLog(folder_), file_, options), InputError);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace lio
