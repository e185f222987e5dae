// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/diagnosis_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A clock that is 25 ms off, mended, and a second sender, which no entry mends.
Diagnosis Example() {
  Diagnosis diagnosis;
  diagnosis.recording.kind = "LCM log";
  diagnosis.recording.assumptions = {"Extrinsic: guessed."};
  diagnosis.options.rig.T_imu_lidar = Pose::Identity();
  diagnosis.options.rig.lidar.clock_offset_s = 0.025;
  const Cause clock{CauseKind::kClockOffset, Trust::kNo, 123.4, "turns agree when 25 ms are added",
                    "rig:\n  lidar:\n    clock_offset_s: 0.025\n"};
  const Cause senders{CauseKind::kTwoSenders, Trust::kDoubtful, 0.0, "samples came twice", ""};
  diagnosis.verdict = {Trust::kNo, 0.97, {}, {clock, senders}};
  diagnosis.treated = {clock};
  diagnosis.is_checked = true;
  diagnosis.with_fixes = {Trust::kDoubtful, 1.0, {}, {senders}};
  return diagnosis;
}

TEST(DiagnosisReport, TellsEachCauseInItsOrderWithSigmaEvidenceAndFix) {
  const std::string text = DiagnosisText(Example(), "walk.lcm");
  EXPECT_THAT(text, HasSubstr("input: walk.lcm (LCM log)\nassumed: Extrinsic: guessed.\n"
                              "trust: no (the result must not be used); poses for 97 %"));
  EXPECT_THAT(text, HasSubstr("\n1. clock_offset (123.4 sigma; leaves trust: no)\n"
                              "   evidence: turns agree when 25 ms are added\n"
                              "   fix:\n     rig:\n       lidar:\n"));
  EXPECT_THAT(text, HasSubstr("\n2. two_senders (counted, not estimated; leaves trust: doubtful)\n"
                              "   evidence: samples came twice\n   fix: no entry of its own"));
  EXPECT_THAT(text, HasSubstr("with the fix of clock_offset: trust: doubtful"));
}

TEST(DiagnosisReport, OfARightRigSaysSo) {
  Diagnosis diagnosis;
  diagnosis.verdict = {Trust::kYes, 1.0, {}, {}};
  const std::string text = DiagnosisText(diagnosis, "walk.lcm");
  EXPECT_THAT(text, HasSubstr("nothing was found to be wrong"));
  EXPECT_THAT(text, Not(HasSubstr("with the fix")));
}

TEST(DiagnosisReport, DoubtWithoutACauseIsNotCalledWell) {
  Diagnosis diagnosis;
  diagnosis.verdict = {Trust::kDoubtful, 0.57, {}, {}};
  const std::string text = DiagnosisText(diagnosis, "walk.lcm");
  EXPECT_THAT(text, HasSubstr("no cause of this was found"));
  EXPECT_THAT(text, Not(HasSubstr("nothing was found to be wrong")));
}

TEST(DiagnosisReport, JsonHasTheVerdictAndThatWithTheFixes) {
  Diagnosis diagnosis = Example();
  auto json = nlohmann::json::parse(DiagnosisJson(diagnosis, "walk.lcm"));
  EXPECT_EQ(json["trust"], "no");
  EXPECT_EQ(json["causes"][0]["kind"], "clock_offset");
  EXPECT_EQ(json["causes"][0]["sigma"], 123.4);
  EXPECT_EQ(json["treated"], nlohmann::json({"clock_offset"}));
  EXPECT_EQ(json["with_fixes"]["trust"], "doubtful");
  diagnosis.is_checked = false;
  json = nlohmann::json::parse(DiagnosisJson(diagnosis, "walk.lcm"));
  EXPECT_TRUE(json["with_fixes"].is_null());
}

TEST(DiagnosisReport, TheRigIsCommentedAndLoadsAgain) {
  Diagnosis diagnosis = Example();
  diagnosis.options.pipeline.use_imu = false;
  diagnosis.recording.assumptions = {"two\nlines: [unclosed"};
  const std::string yaml = DiagnosedRigYaml(diagnosis, "walk\x1b.lcm");
  EXPECT_THAT(yaml, HasSubstr("# Changed for clock_offset: turns agree"));
  EXPECT_THAT(yaml, HasSubstr("# added to the lidar's stamps"));
  const test::TempDir dir;
  const LoadResult loaded = LoadOptions({dir.Write("rig.yaml", yaml)}, {});
  ASSERT_TRUE(loaded.faults.empty()) << loaded.faults.front();
  EXPECT_EQ(loaded.options.rig.lidar.clock_offset_s, 0.025);
  EXPECT_TRUE(loaded.options.rig.T_imu_lidar);
  EXPECT_FALSE(loaded.options.pipeline.use_imu);
}

}  // namespace
}  // namespace lio
