// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/recording.hpp"

#include <gmock/gmock.h>

#include "convert/recorded_bag.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "support/mcap_writer.hpp"

namespace lio {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RecordingTest : public test::RosbagConversion {
 protected:
  PreparedRecording Prepare(const std::filesystem::path& input, bool needs_rig = true) {
    RecordingRequest request;
    request.input = input;
    request.out = dir_.path() / "out";
    request.needs_rig = needs_rig;
    std::filesystem::create_directories(request.out);
    return PrepareRecording(request);
  }
  // Writes the recorded drive with further messages at its beginning.
  void WriteBagWith(const std::function<void(test::Bag1Writer&)>& write_more) {
    test::Bag1Writer writer(dir_.path() / "drive.bag");
    write_more(writer);
    test::Record(
        test::Drivers()[0],
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          writer.Write(topic, test::FullType(type, "/"), received, data);
        },
        test::RosBytes());
    writer.Close();
    options_.input = dir_.path() / "drive.bag";
  }
  Options Load(const PreparedRecording& prepared) {
    const LoadResult loaded = LoadOptions(prepared.rig_files, {});
    EXPECT_THAT(loaded.faults, IsEmpty());
    return loaded.options;
  }
};

TEST_F(RecordingTest, ABagBecomesALogWithItsTruthAndADraftedRig) {
  WriteBag1(test::Drivers()[0]);
  const PreparedRecording prepared = Prepare(options_.input);
  EXPECT_EQ(KindOf(prepared.log), FileKind::kLcmLog);
  EXPECT_EQ(prepared.truth, dir_.path() / "out" / "truth.tum");
  EXPECT_THAT(prepared.assumptions, Contains(HasSubstr("topic /truth")));
  EXPECT_THAT(prepared.assumptions, Contains(HasSubstr("no /tf_static")));
  EXPECT_THAT(prepared.report, HasSubstr("/points"));
  const Options options = Load(prepared);
  EXPECT_EQ(options.rig.lidar.model, "vlp16") << "the test lidar has its beams";
  ASSERT_TRUE(options.rig.T_imu_lidar);
  EXPECT_EQ(options.rig.T_imu_lidar->translation, Vector3::Zero());
}

TEST_F(RecordingTest, TheMountingComesFromTfStatic) {
  WriteBagWith([](test::Bag1Writer& writer) {
    test::RosBytes links;
    links.Put(std::uint32_t{1}).PutHeader(test::kRecordingBegin, "imu_link").PutString("velodyne");
    for (const double value : {0.5, -0.25, 1.0, 0.0, 0.0, 1.0, 0.0}) links.Put(value);
    writer.Write("/tf_static", "tf2_msgs/TFMessage", test::kRecordingBegin, links.bytes());
  });
  const PreparedRecording prepared = Prepare(options_.input);
  EXPECT_THAT(prepared.assumptions, Contains(HasSubstr("from /tf_static: velodyne in imu_link")));
  const Options options = Load(prepared);
  EXPECT_EQ(options.rig.T_imu_lidar->translation, Vector3(0.5, -0.25, 1.0));
  EXPECT_NEAR(std::abs(options.rig.T_imu_lidar->rotation.z()), 1.0, 1e-9);
}

TEST_F(RecordingTest, OfSeveralTruthTopicsNoneIsTakenUnasked) {
  WriteBagWith([](test::Bag1Writer& writer) {
    writer.Write("/slam", "nav_msgs/Odometry", test::kRecordingBegin,
                 test::OdometryMessage({test::kRecordingBegin, Pose::Identity()}));
  });
  const PreparedRecording prepared = Prepare(options_.input);
  EXPECT_FALSE(prepared.truth);
  EXPECT_THAT(prepared.assumptions, Contains(HasSubstr("--truth-topic")));
}

TEST_F(RecordingTest, ARos2FolderIsABagToo) {
  WriteBag2(test::Drivers()[0], false);
  const PreparedRecording prepared = Prepare(options_.input);
  EXPECT_EQ(prepared.kind, "ROS bag");
  EXPECT_EQ(KindOf(prepared.log), FileKind::kLcmLog);
}

TEST_F(RecordingTest, AnMcapFileIsABagToo) {
  WriteBag1(test::Drivers()[0]);
  const auto mcap = dir_.path() / "drive.mcap";
  test::CopyToMcap(options_.input, mcap, {.compression = "zstd"},
                   [](const BagTopic&, const BagMessage& message) {
                     return std::vector<std::uint8_t>(message.data.begin(), message.data.end());
                   });
  const PreparedRecording prepared = Prepare(mcap);
  EXPECT_EQ(prepared.kind, "ROS bag");
  EXPECT_TRUE(prepared.truth);
  EXPECT_EQ(KindOf(prepared.log), FileKind::kLcmLog);
}

TEST_F(RecordingTest, ATruthBesideTheBagIsTakenBeforeOneInIt) {
  WriteBag1(test::Drivers()[0]);
  const auto beside = dir_.Write("drive.gt.tum", "1 0 0 0 0 0 0 1\n");
  EXPECT_EQ(Prepare(options_.input).truth, beside);
}

TEST_F(RecordingTest, WithARigOfTheUsersNothingIsDrafted) {
  WriteBag1(test::Drivers()[0]);
  const PreparedRecording prepared = Prepare(options_.input, false);
  EXPECT_THAT(prepared.rig_files, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(dir_.path() / "out" / "rig_draft.yaml"));
}

TEST_F(RecordingTest, ALogIsReadWhereItLiesWithTheConfigurationBesideIt) {
  WriteBag1(test::Drivers()[0]);
  const PreparedRecording converted = Prepare(options_.input);
  std::filesystem::create_directories(dir_.path() / "sim");
  std::filesystem::copy(converted.log, dir_.path() / "sim" / "log.lcm");
  const auto config = dir_.Write("sim/config.yaml", "pipeline: {use_imu: false}\n");
  const auto truth = dir_.Write("sim/truth.tum", "1 0 0 0 0 0 0 1\n");
  for (const char* input : {"sim", "sim/", "sim/log.lcm"}) {
    const PreparedRecording prepared = Prepare(dir_.path() / input);
    EXPECT_EQ(prepared.log, dir_.path() / "sim" / "log.lcm") << input;
    EXPECT_EQ(prepared.truth, truth) << input;
    ASSERT_EQ(prepared.rig_files.size(), 1u) << input;
    EXPECT_TRUE(std::filesystem::equivalent(prepared.rig_files[0], config)) << input;
  }
}

TEST_F(RecordingTest, ALoneLogGetsADraftFromItsContent) {
  WriteBag1(test::Drivers()[0]);
  const PreparedRecording converted = Prepare(options_.input);
  std::filesystem::rename(converted.log, dir_.path() / "lone.lcm");
  const PreparedRecording prepared = Prepare(dir_.path() / "lone.lcm");
  EXPECT_THAT(prepared.assumptions, Contains(HasSubstr("ASSUMED")));
  EXPECT_THAT(test::ReadText(prepared.rig_files[0]), HasSubstr("IMU the IMU: 100.0 Hz"));
}

TEST_F(RecordingTest, WhatIsNoRecordingIsNamed) {
  const auto text = dir_.Write("notes.txt", "no recording");
  for (const auto& [input, words] : std::vector<std::pair<std::filesystem::path, std::string>>{
           {"/no/such.bag", "no such file"}, {text, "is no ROS bag"}, {dir_.path(), "is no ROS"}}) {
    try {
      static_cast<void>(Prepare(input));
      FAIL() << input;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(input.string()));
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  }
}

}  // namespace
}  // namespace lio
