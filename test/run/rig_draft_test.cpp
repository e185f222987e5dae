// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/rig_draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/io/options_yaml.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

RigDraft Draft() {
  RigDraft draft;
  draft.input = "drive.bag";
  draft.command = "lio-run drive.bag --rig rig_draft.yaml --out out";
  draft.about = {"Lidar /points: 10 Hz"};
  draft.rig.T_imu_lidar = Pose{Quaternion(0.5, -0.5, 0.5, -0.5), Vector3(1, 2, 3)};
  draft.rig.lidar.model = "vlp16";
  draft.rig.imu.gyro_noise_density = 4e-3;
  draft.extrinsic_reason = "from /tf_static";
  return draft;
}

TEST(RigDraftYaml, IsAConfigurationThatLoadsWithTheSameValues) {
  const test::TempDir dir;
  const LoadResult loaded = LoadOptions({dir.Write("rig.yaml", RigDraftYaml(Draft()))}, {});
  EXPECT_THAT(loaded.faults, IsEmpty());
  const Rig& rig = loaded.options.rig;
  EXPECT_EQ(rig.T_imu_lidar->translation, Vector3(1, 2, 3));
  EXPECT_LT(rig.T_imu_lidar->rotation.angularDistance(Quaternion(0.5, -0.5, 0.5, -0.5)), 1e-8);
  EXPECT_EQ(rig.lidar.model, "vlp16");
  EXPECT_EQ(rig.imu.gyro_noise_density, 4e-3);
  EXPECT_TRUE(loaded.options.pipeline.use_imu);
}

TEST(RigDraftYaml, SaysWhyAndWhatToDoNext) {
  const std::string text = RigDraftYaml(Draft());
  EXPECT_THAT(text, HasSubstr("# from /tf_static\n"));
  EXPECT_THAT(text, HasSubstr("#   lio-run drive.bag --rig rig_draft.yaml --out out\n"));
  EXPECT_THAT(text, HasSubstr("# Lidar /points: 10 Hz\n"));
}

TEST(RigDraftYaml, WithoutAnImuItIsOfLidarOnlyOdometry) {
  RigDraft draft = Draft();
  draft.rig.T_imu_lidar.reset();
  draft.use_imu = false;
  const test::TempDir dir;
  const LoadResult loaded = LoadOptions({dir.Write("rig.yaml", RigDraftYaml(draft))}, {});
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_FALSE(loaded.options.pipeline.use_imu);
}

TEST(RigDraftYaml, ATextWithNewlinesStaysAComment) {
  RigDraft draft = Draft();
  draft.input = "drive\nrig: {lidar: {model: hdl32e}}";
  const test::TempDir dir;
  const LoadResult loaded = LoadOptions({dir.Write("rig.yaml", RigDraftYaml(draft))}, {});
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.options.rig.lidar.model, "vlp16");
}

}  // namespace
}  // namespace lio
