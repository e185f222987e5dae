// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs lio-eval consistency as its users do.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "eval/paths.hpp"
#include "support/build_paths.hpp"
#include "support/run_program.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kPositionStd_m = 0.05;
constexpr double kRotationStd_rad = 0.01;

class ConsistencyCommand : public ::testing::Test {
 protected:
  ConsistencyCommand() {
    WriteTum(dir_.path() / "truth.tum", test::Helix(120).poses);
    for (int seed = 1; seed <= 12; ++seed) WriteRun(seed);
  }

  // The errors about the truth are white and have the stated size; the first row has none.
  void WriteRun(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Trajectory estimate = test::Helix(120);
    std::string covariances = "t_s", registration = "t_s,fused,nis\n";
    for (int i = 0; i < 36; ++i) covariances.append(fmt::format(",c{}", i));
    for (std::size_t i = 0; i < 120; ++i) {
      Vector6 noise = Vector6::Zero();
      for (double& entry : noise) entry = i == 0 ? 0 : normal(random);
      Pose& pose = estimate.poses[i].pose;
      pose.translation += kPositionStd_m * noise.head<3>();
      pose.rotation = pose.rotation * ExpSo3(kRotationStd_rad * noise.tail<3>());
      const std::string stamp = StampText(estimate.poses[i].stamp);
      covariances.append("\n" + stamp);
      for (int k = 0; k < 36; ++k) covariances.append(fmt::format(",{}", Variance(k)));
      registration.append(fmt::format("{},1,{}\n", stamp, noise.squaredNorm()));
    }
    const std::string folder = fmt::format("seed_{:02}", seed);
    dir_.Write(folder + "/covariance.csv", covariances + "\n");
    dir_.Write(folder + "/registration.csv", registration);
    WriteTum(dir_.path() / folder / "trajectory.tum", estimate.poses);
    dirs_.push_back((dir_.path() / folder).string());
  }
  static double Variance(int index) {
    if (index % 7 != 0) return 0;
    const double std = index < 18 ? kPositionStd_m : kRotationStd_rad;
    return std * std;
  }

  test::ProgramResult Run(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {test::Program("lio-eval"), "consistency"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::RunProgram(command);
  }
  std::string InDir(const std::string& name) const { return (dir_.path() / name).string(); }

  test::TempDir dir_;
  std::vector<std::string> dirs_;
};

TEST_F(ConsistencyCommand, HonestRunsComeOutHonest) {
  std::vector<std::string> arguments = {InDir("truth.tum"), "--json", InDir("c.json")};
  arguments.insert(arguments.end(), dirs_.begin(), dirs_.end());
  const auto result = Run(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("NEES pose"));
  const auto json = nlohmann::json::parse(test::ReadText(InDir("c.json")));
  EXPECT_EQ(json["num_runs"], 12);
  EXPECT_NEAR(json["nees"]["pose"]["average_per_dof"].get<double>(), 1, 0.05);
  EXPECT_GT(json["nees"]["pose"]["share_in_band"].get<double>(), 0.88);
  EXPECT_NEAR(json["nis"]["average_per_dof"].get<double>(), 1, 0.05);
}

TEST_F(ConsistencyCommand, EachFolderMayHoldItsOwnTruth) {
  const Pose moved{ExpSo3({0, 0, 1}), {9, 9, 9}};
  WriteTum(dirs_[0] + "/own.tum",
           test::Map(test::Helix(120), [&](const Pose& p) { return moved * p; }).poses);
  EXPECT_EQ(Run({"own.tum", dirs_[0]}).exit_code, 0);
}

TEST_F(ConsistencyCommand, JudgesTheFilesOfTheFrameThatIsAskedFor) {
  for (const std::string frame : {"world", "level"}) {
    const auto without = Run({"--" + frame, InDir("truth.tum"), dirs_[0]});
    EXPECT_EQ(without.exit_code, 5);
    EXPECT_THAT(without.err, HasSubstr("trajectory_" + frame + ".tum"));
  }
  for (const std::string kind : {"trajectory.tum", "covariance.csv"}) {
    const auto dot = kind.find('.');
    const std::string head = dirs_[0] + "/" + kind.substr(0, dot), tail = kind.substr(dot);
    std::filesystem::copy_file(head + tail, head + "_level" + tail);
    std::filesystem::rename(head + tail, head + "_world" + tail);
  }
  EXPECT_EQ(Run({InDir("truth.tum"), dirs_[0]}).exit_code, 5) << "the path in map is gone";
  for (const std::string frame : {"world", "level"}) {
    const auto judged = Run({"--" + frame, InDir("truth.tum"), dirs_[0]});
    EXPECT_EQ(judged.exit_code, 0) << judged.err;
  }
  EXPECT_EQ(Run({"--level", "--world", InDir("truth.tum"), dirs_[0]}).exit_code, 2);
}

TEST_F(ConsistencyCommand, WrongInputsEndWithTheirCodes) {
  EXPECT_EQ(Run({InDir("truth.tum")}).exit_code, 2);
  EXPECT_EQ(Run({InDir("truth.tum"), dirs_[0], "--unknown"}).exit_code, 2);
  EXPECT_EQ(Run({InDir("missing.tum"), dirs_[0]}).exit_code, 5);
  std::filesystem::remove(dirs_[0] + "/covariance.csv");
  const auto result = Run({InDir("truth.tum"), dirs_[0]});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.err, AllOf(StartsWith("lio-eval: "), HasSubstr("covariance.csv: cannot")));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
}

TEST_F(ConsistencyCommand, DrawsAPicture) {
  if (test::RunProgram({"/usr/bin/python3", "-c", "import matplotlib"}).exit_code != 0) {
    GTEST_SKIP() << "python3-matplotlib is not installed";
  }
  EXPECT_EQ(Run({InDir("truth.tum"), dirs_[0], dirs_[1], "--plot", InDir("c.png")}).exit_code, 0);
  EXPECT_TRUE(test::ReadText(InDir("c.png")).starts_with("\x89PNG"));
}

TEST_F(ConsistencyCommand, HelpTeaches) {
  EXPECT_THAT(Run({"--help"}).out, HasSubstr("lio-eval consistency truth.tum runs/seed_*"));
}

}  // namespace
}  // namespace lio
