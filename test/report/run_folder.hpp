// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the folder of a short run: ten scans along a bend, written by RunWriter.
#pragma once

#include <gtest/gtest.h>

#include "lio/io/run_writer.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/temp_dir.hpp"

namespace lio::test {

inline constexpr Timestamp kRunBegin{1'700'000'000'000'000'000};
inline constexpr int kRunScans = 10;

inline Timestamp ScanStamp(int i) {
  return kRunBegin + Duration::FromSeconds(0.1 * i);
}

inline Vector3 PositionAt(int i) {
  return {5.0 * i, 0.5 * i * i, 0.0};
}

class RunFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    RunWriter writer(out_, Options{});
    for (int i = 0; i < kRunScans; ++i) {
      ScanOutput output;
      output.scan.stamp = ScanStamp(i);
      output.scan.nis = 6.0;
      FilterReport& filter = output.filter.emplace();
      filter.nav.stamp = output.scan.stamp;
      filter.nav.status = TrackingStatus::kOk;
      filter.nav.T_map_imu.translation = PositionAt(i);
      filter.nav.T_world_imu = filter.nav.T_map_imu;
      filter.nav.pose_cov = 0.04 * Matrix6::Identity();
      filter.map_as_world_cov = filter.nav.pose_cov;
      filter.g_world_mps2 = Vector3(0, 0, -9.8);
      filter.cov = Eigen::MatrixXd::Identity(21, 21);
      output.trust = Trust::kDoubtful;
      writer.Write(output);
    }
    writer.Write(Notice{ScanStamp(3), Notice::Severity::kWarning, "a <b> & \"c\""});
    writer.WriteMap(std::vector<Eigen::Vector3f>{{0, 0, 0}, {1, 1, 1}});
    writer.Finish({});
  }
  // A truth that is 0.1 m to the left of the path; it has the path's shape.
  std::filesystem::path WriteTruth() const {
    std::string text;
    for (int i = 0; i < kRunScans; ++i) {
      text += TumRow({ScanStamp(i), {Quaternion::Identity(), PositionAt(i) + Vector3(0, 0.1, 0)}}) +
              "\n";
    }
    return folder_.Write("truth.tum", text);
  }

  TempDir folder_;
  std::filesystem::path out_ = folder_.path() / "run";
};

}  // namespace lio::test
