// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "report/truth_parts.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "report/run_folder.hpp"

namespace lio {
namespace {

using TruthPartsTest = test::RunFolder;

TEST_F(TruthPartsTest, ErrorsComeWithTheStandardDeviationsThatTheFilterClaims) {
  const auto parts = TruthParts(out_, WriteTruth(), test::kRunBegin);
  ASSERT_TRUE(parts.contains("errors")) << parts;
  const auto& errors = parts["errors"];
  // The first row is where truth and path are joined.
  EXPECT_EQ(errors["t"].size(), test::kRunScans - 1u);
  EXPECT_NEAR(errors["t"][0], 0.1, 1e-9);
  EXPECT_NEAR(errors["x"][4], 0.0, 1e-6);
  EXPECT_NEAR(errors["x_std"][4], 0.2, 1e-4);
  EXPECT_NEAR(errors["rz_std"][4], 11.459, 1e-2);
}

TEST_F(TruthPartsTest, TheTruePathIsMovedOntoTheEstimate) {
  const auto parts = TruthParts(out_, WriteTruth(), test::kRunBegin);
  EXPECT_NEAR(parts["path"]["x"][9], 45.0, 1e-6);
  EXPECT_NEAR(parts["path"]["y"][9], 40.5, 1e-6);
  EXPECT_NEAR(parts["figures"]["ape"]["position_m"]["rmse"], 0.0, 1e-6);
}

TEST_F(TruthPartsTest, ATruthOfAnotherTimeIsANote) {
  const auto truth = folder_.Write("other.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const auto parts = TruthParts(out_, truth, test::kRunBegin);
  EXPECT_FALSE(parts.contains("errors"));
  EXPECT_FALSE(parts["note"].get<std::string>().empty());
}

TEST_F(TruthPartsTest, PosesOfAStartInOtherAxesAreLeftOut) {
  // The truth's body is turned by 90 deg against the estimate's, in the first three rows alone.
  std::string text;
  for (int i = 0; i < test::kRunScans; ++i) {
    const double half_turn_rad = i < 3 ? 0.25 * M_PI : 0.0;
    const Quaternion turned(std::cos(half_turn_rad), 0, 0, std::sin(half_turn_rad));
    text += TumRow({test::ScanStamp(i), {turned, test::PositionAt(i)}}) + "\n";
  }
  const auto parts = TruthParts(out_, folder_.Write("truth.tum", text), test::kRunBegin);
  ASSERT_TRUE(parts.contains("errors")) << parts;
  ASSERT_TRUE(parts.contains("remark")) << parts;
  EXPECT_THAT(parts["remark"].get<std::string>(), ::testing::HasSubstr("first 3 poses"));
  for (const double error_m : parts["errors"]["x"]) EXPECT_NEAR(error_m, 0.0, 1e-6);
  for (const double error_deg : parts["errors"]["rz"]) EXPECT_NEAR(error_deg, 0.0, 1e-3);
}

}  // namespace
}  // namespace lio
