// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/options_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "support/beams.hpp"
#include "support/build_paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr char kRig[] =
    "rig:\n"
    "  T_imu_lidar:\n"
    "    translation_m: [0.1, 0.2, 0.3]\n"
    "    rotation_wxyz: [1, 0, 0, 0]\n";

class OptionsYaml : public ::testing::Test {
 protected:
  LoadResult Load(const std::string& yaml, const std::vector<std::string>& sets = {}) {
    return LoadOptions({dir_.Write("test.yaml", yaml)}, sets);
  }
  std::string At(int line) const {
    return (dir_.path() / "test.yaml").string() + ":" + std::to_string(line) + ": ";
  }

  test::TempDir dir_;
};

TEST_F(OptionsYaml, ValuesOfEveryTypeAreTaken) {
  const LoadResult result = Load(std::string(kRig) +
                                 "  lidar:\n"
                                 "    model: hdl32e\n"
                                 "    own_vehicle_box: {min_m: [-1, -2, -3], max_m: [1, 2, 3]}\n"
                                 "  imu: {gravity: removed, gyro_noise_density: 1e-2}\n"
                                 "pipeline: {use_imu: false, max_queued_scans: 7}\n");
  EXPECT_THAT(result.faults, IsEmpty());
  const Rig& rig = result.options.rig;
  ASSERT_TRUE(rig.T_imu_lidar.has_value());
  EXPECT_EQ(rig.T_imu_lidar->translation, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(rig.lidar.model, "hdl32e");
  ASSERT_TRUE(rig.lidar.own_vehicle_box.has_value());
  EXPECT_EQ(rig.lidar.own_vehicle_box->min_m, Vector3(-1, -2, -3));
  EXPECT_EQ(rig.imu.gravity, GravityInput::kRemoved);
  EXPECT_EQ(rig.imu.gyro_noise_density, 0.01);
  EXPECT_FALSE(result.options.pipeline.use_imu);
  EXPECT_EQ(result.options.pipeline.max_queued_scans, 7);
}

TEST_F(OptionsYaml, ABaseFrameIsOptional) {
  EXPECT_FALSE(Load(kRig).options.rig.T_base_imu);
  const LoadResult result = Load(std::string(kRig) +
                                 "  T_base_imu:\n"
                                 "    translation_m: [1, 0, 0.5]\n"
                                 "    rotation_wxyz: [0, 0, 0, 1]\n");
  EXPECT_THAT(result.faults, IsEmpty());
  ASSERT_TRUE(result.options.rig.T_base_imu);
  EXPECT_EQ(result.options.rig.T_base_imu->translation, Vector3(1, 0, 0.5));
}

TEST_F(OptionsYaml, LaterFilesOverrideKeyByKeyAndSetsOverrideAll) {
  const auto first = dir_.Write("a.yaml", std::string(kRig) + "ndt: {voxel_m: 2, max_cells: 5000}");
  const auto second = dir_.Write("b.yaml", "ndt: {voxel_m: 3}\nrig: {gravity_mps2: 9.7}");
  const LoadResult result =
      LoadOptions({first, second}, {"ndt.voxel_m=4", "ndt.voxel_m=5", "rig.lidar.model=vlp16"});
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_EQ(result.options.ndt.voxel_m, 5);
  EXPECT_EQ(result.options.ndt.max_cells, 5000);
  EXPECT_EQ(result.options.rig.gravity_mps2, 9.7);
  EXPECT_EQ(result.options.rig.lidar.model, "vlp16");
  EXPECT_TRUE(result.options.rig.T_imu_lidar.has_value());
}

TEST_F(OptionsYaml, SetTakesListsMapsAndNull) {
  const LoadResult result = LoadOptions(
      {}, {"rig.T_imu_lidar.rotation_wxyz=[0, 1, 0, 0]", "rig.T_imu_lidar.translation_m=[1,2,3]",
           "rig.lidar.own_vehicle_box={min_m: [0,0,0], max_m: [1,1,1]}",
           "rig.lidar.own_vehicle_box=null"});
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_EQ(result.options.rig.T_imu_lidar->rotation.x(), 1.0);
  EXPECT_EQ(result.options.rig.T_imu_lidar->translation, Vector3(1, 2, 3));
  EXPECT_FALSE(result.options.rig.lidar.own_vehicle_box.has_value());
}

TEST_F(OptionsYaml, AllFaultsAreListedAtOnceWithTheirLines) {
  const LoadResult result = Load(
      "ndt:\n"
      "  voxle_m: 1\n"
      "  max_cells: many\n"
      "  max_iterations: 1.5\n"
      "filter: 3\n"
      "reduce:\n"
      "  voxel_m: -1\n"
      "rig:\n"
      "  imu:\n"
      "    gravity: maybe\n");
  EXPECT_THAT(
      result.faults,
      ElementsAre(At(2) + "ndt.voxle_m: unknown key; did you mean ndt.voxel_m?",
                  At(3) + "ndt.max_cells: expects a whole number, not 'many'",
                  At(4) + "ndt.max_iterations: expects a whole number, not '1.5'",
                  At(5) + "filter: expects keys, not '3'",
                  At(10) + "rig.imu.gravity: expects one of auto, present, removed, not 'maybe'",
                  At(7) + "reduce.voxel_m: is -1, must be within 0.01 .. 10",
                  AllOf(StartsWith("configuration: rig.T_imu_lidar: is required with an IMU"),
                        HasSubstr("rotation_wxyz")),
                  "configuration: reduce.min_voxel_m: must not be above reduce.voxel_m"));
}

TEST_F(OptionsYaml, WrongTypesAreRefused) {
  const std::vector<std::string> wrong = {"ndt.voxel_m=\"1\"",
                                          "ndt.voxel_m=[1]",
                                          "ndt.voxel_m=",
                                          "ndt.voxel_m=1m",
                                          "ndt.voxel_m=1,5",
                                          "ndt.max_cells=99999999999",
                                          "pipeline.use_imu=yes",
                                          "pipeline.use_imu=1",
                                          "rig.lidar.model=[a]",
                                          "pipeline.method=icp",
                                          "rig.T_imu_lidar.translation_m=[1, 2]",
                                          "rig.T_imu_lidar.translation_m=[1, 2, x]",
                                          "ndt={voxel_m: {a: 1}}"};
  for (const std::string& set : wrong) {
    const LoadResult result = Load(kRig, {set});
    ASSERT_THAT(result.faults, SizeIs(1)) << set;
    EXPECT_THAT(result.faults[0], AllOf(StartsWith("--set " + set), HasSubstr("expects"))) << set;
  }
}

TEST_F(OptionsYaml, AValueThatCannotBeReadHasOneFault) {
  EXPECT_THAT(Load(kRig, {"pipeline.max_queued_scans=-1e300"}).faults, SizeIs(1));
  EXPECT_THAT(Load(kRig, {"rig.gravity_mps2=-x"}).faults, SizeIs(1));
}

TEST_F(OptionsYaml, NonFiniteNumbersAreRefused) {
  for (const std::string value : {"nan", "inf", "-inf"}) {
    const LoadResult result = Load(kRig, {"ndt.voxel_m=" + value});
    EXPECT_THAT(result.faults, ElementsAre(EndsWith("must be a finite number"))) << value;
  }
  EXPECT_THAT(Load(kRig, {"ndt.voxel_m=.nan"}).faults, SizeIs(1));
}

TEST_F(OptionsYaml, RotationIsNormalisedOrRefused) {
  const LoadResult near = Load(kRig, {"rig.T_imu_lidar.rotation_wxyz=[0.7071, 0, 0, -0.7071]"});
  EXPECT_THAT(near.faults, IsEmpty());
  EXPECT_NEAR(near.options.rig.T_imu_lidar->rotation.norm(), 1.0, 1e-15);
  const LoadResult far = Load(kRig, {"rig.T_imu_lidar.rotation_wxyz=[0.7, 0, 0, 0.7]"});
  ASSERT_THAT(far.faults, SizeIs(1));
  EXPECT_THAT(far.faults[0], HasSubstr("rotation_wxyz: has norm 0.98994949"));
}

TEST_F(OptionsYaml, LidarModelsNeedABeamTable) {
  for (const std::string model : {"hdl32e", "vlp16", "hdl64e", "os1_64", "generic"}) {
    EXPECT_THAT(Load(kRig, {"rig.lidar.model=" + model}).faults, IsEmpty()) << model;
  }
  for (const std::string model : {"hdl32", "../lidars/hdl32e", "HDL32E"}) {
    EXPECT_THAT(Load(kRig, {"rig.lidar.model=" + model}).faults,
                ElementsAre(HasSubstr("rig.lidar.model: ")))
        << model;
  }
}

TEST_F(OptionsYaml, HalfAGroupIsRefused) {
  const LoadResult result = Load("rig:\n  T_imu_lidar:\n    translation_m: [0, 0, 1]\n");
  EXPECT_THAT(result.faults,
              ElementsAre(At(2) + "rig.T_imu_lidar.rotation_wxyz (or rotation_rpy_deg, "
                                  "rotation_matrix, matrix): is missing; the "
                                  "keys of its group go together"));
}

TEST_F(OptionsYaml, DoubledKeysAreRefused) {
  const LoadResult result = Load(std::string(kRig) + "ndt:\n  voxel_m: 1\n  voxel_m: 2\n");
  EXPECT_THAT(result.faults, ElementsAre(At(7) + "ndt.voxel_m: is given twice"));
}

// The error must not blame a key that may stand in them.
TEST_F(OptionsYaml, UnreadableAndBrokenFilesAreNamed) {
  const LoadResult result = LoadOptions(
      {dir_.path() / "missing.yaml", dir_.path(), dir_.Write("broken.yaml", "a: 1\n  b: [\n")}, {});
  ASSERT_THAT(result.faults, SizeIs(3));
  EXPECT_THAT(result.faults[0], HasSubstr("missing.yaml: cannot be read"));
  EXPECT_THAT(result.faults[1], HasSubstr(": cannot be read"));
  EXPECT_THAT(result.faults[2], HasSubstr("broken.yaml:2: is not valid YAML"));
  EXPECT_THAT(Load("- 1\n").faults, ElementsAre(At(1) + "expects keys, not a list"));
}

TEST_F(OptionsYaml, OddDocumentsAreFaultsNotCrashes) {
  const std::vector<std::string> documents = {
      "[1, 2]", "3", "? [1]\n: 2", "a: 1\n---\nb: 2", "rig: &x {lidar: *x}", "rig: &x [*x]"};
  for (const std::string& document : documents) {
    EXPECT_FALSE(Load(document, {"pipeline.use_imu=false"}).faults.empty()) << document;
  }
  EXPECT_THAT(Load("", {"pipeline.use_imu=false"}).faults, IsEmpty());
  EXPECT_THAT(Load("ndt:\n", {"pipeline.use_imu=false"}).faults, IsEmpty());
}

TEST_F(OptionsYaml, MalformedSetsAreFaults) {
  for (const std::string set : {"ndt.voxel_m", "=1", "ndt.voxel_m=[1"}) {
    EXPECT_THAT(Load(kRig, {set}).faults, ElementsAre(StartsWith("--set " + set + ": "))) << set;
  }
  EXPECT_THAT(Load(kRig, {"ndt.voxle=1"}).faults,
              ElementsAre(EndsWith("unknown key; did you mean ndt.voxel_m?")));
}

TEST_F(OptionsYaml, PrintedOptionsLoadAsTheSameValues) {
  LoadResult first = Load(kRig, {"rig.T_imu_lidar.rotation_wxyz=[0.1, 0.7, 0.70003, 0.1]",
                                 "ndt.voxel_m=0.30000000000000004", "rig.imu.gravity=present",
                                 "rig.lidar.own_vehicle_box={min_m: [0,0,0], max_m: [1,1,0.1]}"});
  ASSERT_THAT(first.faults, IsEmpty());
  const std::string printed = PrintOptions(first.options);
  const LoadResult second = Load(printed);
  EXPECT_THAT(second.faults, IsEmpty());
  EXPECT_EQ(PrintOptions(second.options), printed);
  EXPECT_EQ(second.options.ndt.voxel_m, 0.30000000000000004);
  EXPECT_EQ(second.options.rig.T_imu_lidar->rotation.coeffs(),
            first.options.rig.T_imu_lidar->rotation.coeffs());
}

// --- the files in config/ ---

std::filesystem::path Config(const std::string& name) {
  return std::filesystem::path(test::SourceDir()) / "config" / name;
}

TEST(ConfigFiles, DefaultYamlIsWhatTheStructsSay) {
  EXPECT_EQ(test::ReadText(Config("default.yaml")), PrintOptions(Options{}))
      << "after changing options run: build/bin/lio-replay --print-options 2>/dev/null "
         "> config/default.yaml";
}

TEST(ConfigFiles, DefaultYamlLacksOnlyTheExtrinsic) {
  EXPECT_THAT(LoadOptions({Config("default.yaml")}, {}).faults,
              ElementsAre(StartsWith("configuration: rig.T_imu_lidar: is required")));
}

TEST(ConfigFiles, OthersAreCompleteWhenGivenAlone) {
  for (const std::string name : {"ulhk.yaml", "kitti_raw.yaml", "kitti_odometry.yaml"}) {
    EXPECT_THAT(LoadOptions({Config(name)}, {}).faults, IsEmpty()) << name;
  }
  EXPECT_FALSE(LoadOptions({Config("kitti_odometry.yaml")}, {}).options.pipeline.use_imu);
}

TEST(ConfigFiles, MethodsAreCompleteWithARig) {
  struct File {
    std::string name;
    MatchMethod method;
    bool uses_imu;
  };
  for (const File& file : {File{"methods/ndt.yaml", MatchMethod::kNdt, true},
                           File{"methods/loam.yaml", MatchMethod::kLoam, true},
                           File{"methods/gicp.yaml", MatchMethod::kGicp, true},
                           File{"loosely_lio.yaml", MatchMethod::kNdt, true},
                           File{"ndt_lo.yaml", MatchMethod::kNdt, false},
                           File{"dlo.yaml", MatchMethod::kGicp, false}}) {
    const LoadResult result = LoadOptions({Config("ulhk.yaml"), Config(file.name)}, {});
    EXPECT_THAT(result.faults, IsEmpty()) << file.name;
    EXPECT_EQ(result.options.pipeline.method, file.method) << file.name;
    EXPECT_EQ(result.options.pipeline.use_imu, file.uses_imu) << file.name;
  }
}

// The files write down the defaults: they explain, and choose nothing but the method.
TEST(ConfigFiles, MethodsHoldTheDefaultsOfTheirOptions) {
  Options expected = LoadOptions({Config("ulhk.yaml")}, {}).options;
  for (const auto& [name, method] : {std::pair{"methods/ndt.yaml", MatchMethod::kNdt},
                                     std::pair{"methods/loam.yaml", MatchMethod::kLoam},
                                     std::pair{"methods/gicp.yaml", MatchMethod::kGicp},
                                     std::pair{"loosely_lio.yaml", MatchMethod::kNdt}}) {
    expected.pipeline.method = method;
    EXPECT_EQ(PrintOptions(LoadOptions({Config("ulhk.yaml"), Config(name)}, {}).options),
              PrintOptions(expected));
  }
}

// The calibration's own matrix maps imu to velodyne: R p_imu + T. The lidar's origin in imu is
// then -R' T.
TEST(ConfigFiles, KittiRawHoldsTheInverseOfTheDatasetsCalibration) {
  Matrix3 rotation;
  rotation << 9.999976e-01, 7.553071e-04, -2.035826e-03, -7.854027e-04, 9.998898e-01, -1.482298e-02,
      2.024406e-03, 1.482454e-02, 9.998881e-01;
  const Vector3 translation(-8.086759e-01, 3.195559e-01, -7.997231e-01);
  const auto rig = LoadOptions({Config("kitti_raw.yaml")}, {}).options.rig;
  ASSERT_TRUE(rig.T_imu_lidar.has_value());
  EXPECT_LT((rig.T_imu_lidar->translation + rotation.transpose() * translation).norm(), 1e-6);
  EXPECT_LT((rig.T_imu_lidar->rotation.toRotationMatrix() - rotation.transpose()).norm(), 1e-6);
}

// The yaw is -90 deg and the lidar is above: the lidar's -x faces forward, which is the IMU's y.
TEST(ConfigFiles, UlhkPutsTheLidarsMinusXAheadOfTheImu) {
  const auto rig = LoadOptions({Config("ulhk.yaml")}, {}).options.rig;
  ASSERT_TRUE(rig.T_imu_lidar.has_value());
  EXPECT_LT((rig.T_imu_lidar->rotation * Vector3(-1, 0, 0) - Vector3(0, 1, 0)).norm(), 1e-9);
  EXPECT_EQ(rig.T_imu_lidar->translation, Vector3(0, 0, 0.28));
}

TEST_F(OptionsYaml, RotationsMayComeAsAnglesOrMatrices) {
  const Quaternion quarter(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitZ()));
  const std::string head = "rig:\n  T_imu_lidar:\n";
  const std::string translation = "    translation_m: [1, 2, 3]\n";
  for (const std::string& form :
       {translation + "    rotation_rpy_deg: [0, 0, 90]\n",
        translation + "    rotation_matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]\n",
        std::string("    matrix: [0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1]\n")}) {
    const LoadResult result = Load(head + form);
    EXPECT_THAT(result.faults, IsEmpty()) << form;
    ASSERT_TRUE(result.options.rig.T_imu_lidar) << form;
    EXPECT_EQ(result.options.rig.T_imu_lidar->translation, Vector3(1, 2, 3));
    EXPECT_LT(result.options.rig.T_imu_lidar->rotation.angularDistance(quarter), 1e-12) << form;
  }
}

TEST_F(OptionsYaml, ALaterFormOverridesAnEarlierOneOfAnotherFile) {
  const LoadResult result = Load(kRig, {"rig.T_imu_lidar.rotation_rpy_deg=[0, 0, 180]"});
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_NEAR(std::abs(result.options.rig.T_imu_lidar->rotation.z()), 1.0, 1e-12);
}

TEST_F(OptionsYaml, TwoFormsOfOneRotationInOneFileAreRefused) {
  EXPECT_THAT(
      Load(std::string(kRig) + "    rotation_rpy_deg: [0, 0, 0]\n").faults,
      ElementsAre(At(5) + "rig.T_imu_lidar.rotation_rpy_deg: rig.T_imu_lidar.rotation_wxyz gives "
                          "this already; keep one"));
  EXPECT_THAT(
      Load(std::string(kRig) + "    matrix: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n").faults,
      ElementsAre(StartsWith(At(5) + "rig.T_imu_lidar.matrix: rig.T_imu_lidar.translation_m")));
}

TEST_F(OptionsYaml, AFaultyRotationIsToldOnceWithItsLine) {
  EXPECT_THAT(Load("rig:\n  T_imu_lidar:\n    translation_m: [0, 0, 0]\n"
                   "    rotation_matrix: [[1, 1, 0], [0, 1, 0], [0, 0, 1]]\n")
                  .faults,
              ElementsAre(StartsWith(At(4) + "rig.T_imu_lidar.rotation_matrix: is no rotation")));
  EXPECT_THAT(Load("rig:\n  T_imu_lidar:\n    translation_m: [0, 0, 0]\n"
                   "    rotation_rpy: [0, 0, 0]\n")
                  .faults,
              ::testing::Contains(HasSubstr("did you mean rig.T_imu_lidar.rotation_rpy_deg?")));
}

TEST_F(OptionsYaml, BeamsOfAnEarlierRunFollowTheRig) {
  const LidarBeams beams = test::TwoLidarBeams();
  const LoadResult result =
      LoadOptions({dir_.Write("rig.yaml", kRig), dir_.Write("beams.yaml", PrintBeams(beams))}, {});
  EXPECT_THAT(result.faults, IsEmpty());
  ASSERT_TRUE(result.options.rig.lidar.beams);
  EXPECT_EQ(result.options.rig.lidar.beams->range_m, beams.range_m);
  EXPECT_EQ(result.options.rig.lidar.beams->elevation_rad, beams.elevation_rad);
  EXPECT_EQ(result.options.rig.lidar.beams->encoder_std_rad, beams.encoder_std_rad);
}

TEST_F(OptionsYaml, ListsOfBeamsThatDoNotGoTogetherAreAllNamed) {
  const LoadResult result = Load(std::string(kRig) +
                                 "  lidar:\n"
                                 "    beams:\n"
                                 "      range_m: [0.01, 0.02]\n"
                                 "      range_std_m: [0.01]\n"
                                 "      elevation_rad: [0, one]\n"
                                 "      elevation_std_rad: [1e-4, 0]\n"
                                 "      azimuth_rad: [0, 0]\n"
                                 "      azimuth_std_rad: 1e-4\n"
                                 "      encoder_rad: [0, 0]\n");
  EXPECT_THAT(result.faults,
              testing::UnorderedElementsAre(
                  At(9) + "rig.lidar.beams.elevation_rad: expects a list of numbers, not one with "
                          "'one'",
                  At(12) + "rig.lidar.beams.azimuth_std_rad: expects a list of numbers, not "
                           "'1e-4'",
                  At(6) + "rig.lidar.beams.encoder_std_rad: is missing; the keys of its group go "
                          "together",
                  At(8) + "rig.lidar.beams.range_std_m: has 1 entries, must have 2",
                  At(10) + "rig.lidar.beams.elevation_std_rad: every entry must be within 1e-06 "
                           ".. 1"));
}

}  // namespace
}  // namespace lio
