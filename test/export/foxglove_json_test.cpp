// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/foxglove_json.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "export/recorded_log.hpp"

namespace lio {
namespace {

using nlohmann::json;

std::string Decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int num_bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    num_bits += 6;
    if (num_bits < 8) continue;
    num_bits -= 8;
    bytes += static_cast<char>(bits >> num_bits & 0xff);
  }
  return bytes;
}

TEST(FoxgloveJson, Base64IsThatOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

TEST(FoxgloveJson, CloudHasItsFinitePointsAsFieldsSay) {
  const json cloud = json::parse(PointCloudJson(test::CloudOf(2), "map"));
  EXPECT_EQ(cloud["frame_id"], "map");
  EXPECT_EQ(cloud["point_stride"], 16);
  EXPECT_EQ(cloud["timestamp"], json({{"sec", 1'700'000'000}, {"nsec", 200'000'000}}));
  const std::string data = Decoded(cloud["data"].get<std::string>());
  ASSERT_EQ(data.size(), 19U * 16U);
  float xyz[3];
  std::memcpy(xyz, data.data(), sizeof(xyz));
  EXPECT_EQ(xyz[0], 2.5F);
  EXPECT_EQ(xyz[1], 1.5F);
  std::uint16_t ring = 0;
  std::memcpy(&ring, data.data() + cloud["fields"][4]["offset"].get<std::size_t>(), sizeof(ring));
  EXPECT_EQ(ring, 3);
}

TEST(FoxgloveJson, TransformMapsTheChildIntoTheParent) {
  const Pose pose = test::NavOf(4).T_world_imu;
  const json transform = json::parse(TransformJson({}, "world", "imu", pose));
  EXPECT_EQ(transform["parent_frame_id"], "world");
  EXPECT_EQ(transform["child_frame_id"], "imu");
  EXPECT_EQ(transform["translation"]["y"], 2.0);
  EXPECT_NEAR(transform["rotation"]["z"].get<double>(), std::sqrt(0.5), 1e-12);
}

TEST(FoxgloveJson, EllipsoidHasThreeStandardDeviationsToEachSide) {
  const json scene = json::parse(EllipsoidJson(test::NavOf(0)));
  const json& size = scene["entities"][0]["spheres"][0]["size"];
  EXPECT_NEAR(size["x"].get<double>(), 0.6, 1e-9);
  EXPECT_NEAR(size["y"].get<double>(), 1.2, 1e-9);
  EXPECT_NEAR(size["z"].get<double>(), 1.8, 1e-9);
}

TEST(FoxgloveJson, PlotsHaveTheirNumbers) {
  const json odometry = json::parse(OdometryPlotJson(test::NavOf(1)));
  EXPECT_EQ(odometry["speed_mps"], 5.0);
  EXPECT_EQ(odometry["pose_cov"].size(), 36U);
  EXPECT_NEAR(odometry["position_std_m"]["z"].get<double>(), 0.3, 1e-12);
  FilterReport filter;
  filter.nis = 4.5;
  EXPECT_EQ(json::parse(StatePlotJson(filter))["nis"], 4.5);
  ScanReport scan;
  scan.stage_ns.back() = 2'000'000;
  EXPECT_EQ(json::parse(MatchPlotJson(scan))["stage_ms"]["total"], 2.0);
  StatusReport status;
  status.counters.num_gated = 3;
  status.note = "\xff";
  EXPECT_EQ(json::parse(StatusPlotJson(status))["counts"]["num_gated"], 3);
  EXPECT_EQ(json::parse(ImuPlotJson({}))["gyro_radps"]["x"], 0.0);
}

TEST(FoxgloveJson, NoticesAreAsGraveAsTheVerdict) {
  EXPECT_EQ(json::parse(LogJson({}, Trust::kYes, "a"))["level"], 2);
  EXPECT_EQ(json::parse(LogJson({}, Trust::kNo, "a"))["level"], 4);
}

}  // namespace
}  // namespace lio
