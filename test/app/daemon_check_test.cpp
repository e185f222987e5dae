// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/daemon_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::internal::CaptureStderr;
using ::testing::internal::CaptureStdout;
using ::testing::internal::GetCapturedStderr;
using ::testing::internal::GetCapturedStdout;

class DaemonCheckTest : public ::testing::Test {
 protected:
  int Check(bool has_faulty_options = false) {
    CaptureStdout();
    CaptureStderr();
    const int code = CheckDaemon(arguments_, options_, has_faulty_options);
    out_ = GetCapturedStdout();
    err_ = GetCapturedStderr();
    return code;
  }

  test::TempDir folder_;
  DaemonArguments arguments_;
  Options options_;
  std::string out_, err_;
};

TEST_F(DaemonCheckTest, SaysWhatWouldBeUsedAndMakesNothing) {
  arguments_.lcm_url = "udpm://239.255.76.67:7700";
  arguments_.channel_prefix = "CAR_";
  arguments_.options.files = {"rig.yaml"};
  arguments_.out = (folder_.path() / "a" / "b").string();
  EXPECT_EQ(Check(), kExitDone);
  EXPECT_EQ(err_, "");
  EXPECT_THAT(out_, AllOf(HasSubstr("rig.yaml, 0 keys set"), HasSubstr("CAR_IMU, CAR_SCAN and"),
                          HasSubstr("udpm://239.255.76.67:7700"), HasSubstr(arguments_.out)));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a"));
}

TEST_F(DaemonCheckTest, NamesTheFolderThatARestartWouldTake) {
  arguments_.out = (folder_.path() / "live").string();
  folder_.Write("live/options.yaml", "");
  EXPECT_EQ(Check(), kExitDone);
  EXPECT_THAT(out_, HasSubstr(arguments_.out + "-2"));
  arguments_.overwrites = true;
  EXPECT_EQ(Check(), kExitDone);
  EXPECT_THAT(out_, HasSubstr(arguments_.out + "\n"));
}

TEST_F(DaemonCheckTest, TellsAllFaultsAndEndsWithTheFirstCode) {
  arguments_.lcm_url = "carrier-pigeon://";
  arguments_.out = (folder_.Write("file", "") / "out").string();
  EXPECT_EQ(Check(), kExitNoTransport);
  EXPECT_EQ(out_, "");
  EXPECT_THAT(err_, AllOf(HasSubstr("carrier-pigeon"), HasSubstr("--out: "), HasSubstr("/file")));
  arguments_.initial_map.map = folder_.path() / "missing.pcd";
  EXPECT_EQ(Check(), kExitUnusableInput);
  EXPECT_THAT(err_, AllOf(HasSubstr("missing.pcd"), HasSubstr("carrier-pigeon")));
  EXPECT_EQ(Check(true), kExitConfiguration);
}

}  // namespace
}  // namespace lio
