// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the program as its users do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/paths.hpp"
#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class LioEval : public ::testing::Test {
 protected:
  LioEval() {
    WriteTum(truth_, test::Helix(300).poses);
    const Trajectory raised = test::Map(test::Helix(300), [](const Pose& p) {
      return Pose{p.rotation, p.translation + Vector3(0, 0, 2)};
    });
    WriteTum(estimate_, raised.poses);
  }

  test::ProgramResult Run(std::vector<std::string> arguments,
                          const std::vector<std::string>& environment = {}) {
    arguments.insert(arguments.begin(), test::Program("lio-eval"));
    return test::RunProgram(arguments, environment);
  }
  // Expects one line on stderr that holds `part`.
  void ExpectFault(const test::ProgramResult& result, int exit_code, const std::string& part) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, AllOf(StartsWith("lio-eval: "), HasSubstr(part)));
  }
  std::string InDir(const std::string& name) const { return (dir_.path() / name).string(); }
  bool IsPicture(const std::string& name) const {
    return test::ReadText(dir_.path() / name).starts_with("\x89PNG");
  }
  static bool HasMatplotlib() {
    return test::RunProgram({"/usr/bin/python3", "-c", "import matplotlib"}).exit_code == 0;
  }

  test::TempDir dir_;
  std::string truth_ = (dir_.path() / "truth.tum").string();
  std::string estimate_ = (dir_.path() / "estimate.tum").string();
};

TEST_F(LioEval, SeveralRunsAndFoldersMakeOneTable) {
  std::filesystem::create_directories(InDir("run"));
  WriteTum(InDir("run/trajectory.tum"), test::Helix(300).poses);
  const auto result = Run({truth_, estimate_, InDir("run"), "--align", "none", "--csv",
                           InDir("t.csv"), "--json", InDir("t.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
  const std::string csv = test::ReadText(InDir("t.csv"));
  EXPECT_THAT(csv, StartsWith("run,path_length_m,ape_rmse_m,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  const auto json = nlohmann::json::parse(test::ReadText(InDir("t.json")));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_NEAR(json[0]["ape"]["position_m"]["rmse"].get<double>(), 2.0, 1e-6);
  EXPECT_THAT(json[1]["estimate"].get<std::string>(), HasSubstr("run/trajectory.tum"));
  ExpectFault(Run({truth_, estimate_, InDir("run"), "--plot", InDir("p.png")}), 2, "--plot");
}

TEST_F(LioEval, ATimeOffsetIsGivenOrFound) {
  const auto drive = [](int i) {
    const double s = 0.002 * i * i;
    return Pose{Quaternion::Identity(), {s, 20.0 * std::sin(0.05 * s), std::sin(0.2 * i)}};
  };
  WriteTum(truth_, test::MakeTrajectory(300, drive).poses);
  StampedPoses late = test::MakeTrajectory(300, drive).poses;
  for (StampedPose& row : late) row.stamp = row.stamp + Duration::FromSeconds(0.2);
  WriteTum(estimate_, late);
  for (const std::string wish : {"auto", "-0.2"}) {
    const auto result = Run({truth_, estimate_, "--time-offset", wish, "--json", InDir("o.json")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("time offset -0.2 s"));
    const auto json = nlohmann::json::parse(test::ReadText(InDir("o.json")));
    EXPECT_NEAR(json["time_offset_s"].get<double>(), -0.2, 1e-3);
    EXPECT_NEAR(json["ape"]["position_m"]["rmse"].get<double>(), 0.0, 1e-2);
  }
  ExpectFault(Run({truth_, estimate_, "--time-offset", "soon"}), 2, "--time-offset");
}

TEST_F(LioEval, PrintsFiguresAndWritesJson) {
  const auto result = Run({truth_, estimate_, "--json", InDir("e.json"), "--align", "none"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("alignment   none"));
  const auto json = nlohmann::json::parse(test::ReadText(InDir("e.json")));
  EXPECT_NEAR(json["ape"]["position_m"]["rmse"].get<double>(), 2.0, 1e-6);
  EXPECT_EQ(json["association"]["num_pairs"], 300);
}

TEST_F(LioEval, OptionsMayStandBeforeThePositionals) {
  EXPECT_EQ(Run({"--align", "yaw", "--max-gap", "0.5", truth_, estimate_}).exit_code, 0);
}

TEST_F(LioEval, UsageFaultsEndWithTwo) {
  ExpectFault(Run({truth_}), 2, "ESTIMATE is required");
  ExpectFault(Run({truth_, estimate_, "--align", "sim3"}), 2, "--align");
  ExpectFault(Run({truth_, estimate_, "--max-gap", "-1"}), 2, "--max-gap");
  ExpectFault(Run({truth_, estimate_, "--more"}), 2, "more");
  ExpectFault(Run({truth_, estimate_, "--json", InDir("no/such/dir.json")}), 2, "cannot write ");
}

TEST_F(LioEval, UnusableInputEndsWithFiveAndNamesThePlace) {
  ExpectFault(Run({InDir("missing.tum"), estimate_}), 5, "missing.tum: cannot be read");
  ExpectFault(Run({truth_, estimate_, InDir("other.tum")}), 5, "other.tum: cannot be read");
  const auto bad = dir_.Write("bad.tum", "1 0 0 0 0 0 0 1\n2 0 0 nan 0 0 0 1\n");
  ExpectFault(Run({truth_, bad.string()}), 5, "bad.tum:2: column 4 ('nan')");
  const auto empty = dir_.Write("empty.tum", "");
  ExpectFault(Run({truth_, empty.string()}), 5, "holds no pose");
  const auto late = dir_.Write("late.tum", "9000 0 0 0 0 0 0 1\n9001 0 0 0 0 0 0 1\n");
  ExpectFault(Run({truth_, late.string()}), 5, "check their clocks");
  ExpectFault(Run({truth_, estimate_, "--map", InDir("missing.pcd")}), 5, "missing.pcd");
}

TEST_F(LioEval, HelpTeachesAndVersionIsTold) {
  const auto help = Run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("Examples:"), HasSubstr("--max-gap"), HasSubstr("none|yaw|se3")));
  EXPECT_THAT(Run({"--version"}).out, StartsWith("lio-eval "));
}

TEST_F(LioEval, DrawsPicturesOverAMap) {
  if (!HasMatplotlib()) GTEST_SKIP() << "python3-matplotlib is not installed";
  const auto map = dir_.Write("map.pcd",
                              "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                              "COUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n"
                              "0 0 0\n5 5 1\nnan nan nan\n");
  const auto result = Run({truth_, estimate_, "--plot", InDir("all.png"), "--plots", InDir("out"),
                           "--map", map.string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"all.png", "out/path.png", "out/error.png", "out/map.png"}) {
    EXPECT_TRUE(IsPicture(name)) << name;
  }
}

TEST_F(LioEval, DamagedMapsAndUnwritablePicturesAreTold) {
  if (!HasMatplotlib()) GTEST_SKIP() << "python3-matplotlib is not installed";
  const auto map = dir_.Write("map.pcd",
                              "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                              "COUNT 1 1 1\nPOINTS 9\nDATA binary\nshort");
  ExpectFault(Run({truth_, estimate_, "--plot", InDir("a.png"), "--map", map.string()}), 5,
              "map.pcd: holds 0 of the 9 points");
  ExpectFault(Run({truth_, estimate_, "--plot", InDir("no/such/a.png")}), 2, "cannot be written");
}

TEST_F(LioEval, MissingMatplotlibIsToldAfterTheFigures) {
  // A matplotlib that cannot be imported comes before the real one in the search path.
  dir_.Write("fake/matplotlib/__init__.py", "raise ImportError('not here')\n");
  const auto result =
      Run({truth_, estimate_, "--plot", InDir("a.png")}, {"PYTHONPATH=" + InDir("fake")});
  EXPECT_THAT(result.out, HasSubstr("APE position"));
  ExpectFault(result, 3, "apt-get install python3-matplotlib");
}

TEST_F(LioEval, MissingInterpreterOrScriptIsTold) {
  ExpectFault(Run({truth_, estimate_, "--plot", InDir("a.png")}, {"LIO_PYTHON=/no/python3"}), 3,
              "LIO_PYTHON");
  ExpectFault(Run({truth_, estimate_, "--plot", InDir("a.png")}, {"LIO_PLOT_DIR=/no/scripts"}), 3,
              "LIO_PLOT_DIR");
}

}  // namespace
}  // namespace lio
