// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/pointcloud2_layout.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

using test::Field;

constexpr Timestamp kLayoutStamp{1'500'000'000'000'000'000};

// Describes one driver's layout of the same four points.
struct Layout {
  std::string name;
  std::vector<CloudField> fields;
  std::uint32_t point_step;
  bool has_ring;
  double time_per_second;  // units of the time field per second; 0: no time field
};

std::vector<CloudField> Xyz(FieldType type = FieldType::kFloat32) {
  const auto size = static_cast<std::uint32_t>(NumBytes(type));
  return {Field("x", 0, type), Field("y", size, type), Field("z", 2 * size, type)};
}

Layout MakeLayout(std::string name, std::vector<CloudField> more, std::uint32_t step, bool has_ring,
                  double time_per_second, FieldType xyz = FieldType::kFloat32) {
  std::vector<CloudField> fields = Xyz(xyz);
  fields.insert(fields.end(), more.begin(), more.end());
  return {std::move(name), fields, step, has_ring, time_per_second};
}

class PointLayouts : public testing::TestWithParam<std::tuple<Layout, bool>> {};

TEST_P(PointLayouts, AreReadByNameTypeAndOffset) {
  const auto& [layout, big_endian] = GetParam();
  test::TestCloud cloud;
  cloud.stamp = kLayoutStamp;
  cloud.fields = layout.fields;
  cloud.point_step = layout.point_step;
  cloud.big_endian = big_endian;
  const auto seen = test::SeePoints({.num_rings = 2, .num_columns = 2}, 0);
  cloud.Resize(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    test::StorePoint(cloud, i, seen[i]);
    for (const char* name : {"time", "t", "timestamp"}) {
      cloud.Set(i, name, seen[i].time_s * layout.time_per_second);
    }
  }
  const auto message = test::CloudMessage(cloud);
  const auto decoded = DecodeRosCloud(message, RosEncoding::kRos1);
  ASSERT_TRUE(decoded);
  const auto found = FindLayout(decoded->fields);
  ASSERT_TRUE(found);
  CloudPoints points;
  ReadPoints(*decoded, *found, points);
  ASSERT_EQ(points.size(), seen.size());
  EXPECT_EQ(points.ring.empty(), !layout.has_ring);
  EXPECT_EQ(points.time.empty(), layout.time_per_second == 0.0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_FLOAT_EQ(points.x_m[i], static_cast<float>(seen[i].x));
    EXPECT_FLOAT_EQ(points.y_m[i], static_cast<float>(seen[i].y));
    EXPECT_FLOAT_EQ(points.z_m[i], static_cast<float>(seen[i].z));
    if (layout.has_ring) {
      EXPECT_EQ(points.ring[i], seen[i].ring);
    }
    if (!points.time.empty()) {
      EXPECT_NEAR(points.time[i] / layout.time_per_second, seen[i].time_s, 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Drivers, PointLayouts,
    testing::Combine(testing::Values(MakeLayout("velodyne_s",
                                                {Field("intensity", 12, FieldType::kFloat32),
                                                 Field("ring", 16, FieldType::kUint16),
                                                 Field("time", 18, FieldType::kFloat32)},
                                                22, true, 1.0),
                                     MakeLayout("velodyne_us_float",
                                                {Field("intensity", 16, FieldType::kFloat32),
                                                 Field("ring", 20, FieldType::kUint16),
                                                 Field("time", 24, FieldType::kFloat32)},
                                                32, true, 1e6),
                                     MakeLayout("velodyne_us_double",
                                                {Field("intensity", 16, FieldType::kFloat32),
                                                 Field("time", 20, FieldType::kFloat64),
                                                 Field("ring", 28, FieldType::kUint16)},
                                                32, true, 1e6),
                                     MakeLayout("velodyne_us_uint",
                                                {Field("intensity", 12, FieldType::kUint8),
                                                 Field("time", 13, FieldType::kUint32),
                                                 Field("ring", 17, FieldType::kUint8)},
                                                18, true, 1e6),
                                     MakeLayout("velodyne_old",
                                                {Field("intensity", 16, FieldType::kFloat32),
                                                 Field("ring", 20, FieldType::kUint16)},
                                                32, true, 0.0),
                                     MakeLayout("xyzi",
                                                {Field("intensity", 12, FieldType::kFloat32)}, 16,
                                                false, 0.0),
                                     MakeLayout("ouster",
                                                {Field("intensity", 16, FieldType::kFloat32),
                                                 Field("t", 20, FieldType::kUint32),
                                                 Field("reflectivity", 24, FieldType::kUint16),
                                                 Field("ring", 26, FieldType::kUint8),
                                                 Field("ambient", 28, FieldType::kUint16),
                                                 Field("range", 32, FieldType::kUint32)},
                                                48, true, 1e9),
                                     MakeLayout("hesai",
                                                {Field("intensity", 16, FieldType::kFloat32),
                                                 Field("timestamp", 24, FieldType::kFloat64),
                                                 Field("ring", 32, FieldType::kUint16)},
                                                48, true, 1.0),
                                     MakeLayout("doubles",
                                                {Field("intensity", 24, FieldType::kFloat64),
                                                 Field("ring", 32, FieldType::kInt32),
                                                 Field("time", 36, FieldType::kFloat64)},
                                                44, true, 1.0, FieldType::kFloat64)),
                     testing::Bool()),
    [](const auto& test) {
      return std::get<0>(test.param).name + (std::get<1>(test.param) ? "_big" : "_little");
    });

class PointsOfACloud : public testing::Test {
 protected:
  CloudPoints Read() {
    const auto message = test::CloudMessage(cloud_);
    const auto decoded = DecodeRosCloud(message, RosEncoding::kRos1);
    CloudPoints points;
    ReadPoints(*decoded, *FindLayout(decoded->fields), points);
    return points;
  }
  test::TestCloud cloud_ =
      test::VelodyneCloud(kLayoutStamp, test::SeePoints({.num_rings = 4, .num_columns = 3}, 0));
};

TEST_F(PointsOfACloud, LeaveOutWhatIsNotFiniteOrNoReturn) {
  cloud_.Set(0, "x", std::numeric_limits<double>::quiet_NaN());
  cloud_.Set(1, "z", std::numeric_limits<double>::infinity());
  cloud_.Set(2, "time", std::numeric_limits<double>::quiet_NaN());
  for (const char* name : {"x", "y", "z"}) cloud_.Set(3, name, 0.0);
  const CloudPoints points = Read();
  EXPECT_EQ(points.size(), 8u);
  EXPECT_EQ(points.num_nonfinite, 3);
  EXPECT_EQ(points.num_zero, 1);
  EXPECT_EQ(points.time.size(), 8u);
  EXPECT_EQ(points.ring.size(), 8u);
}

TEST_F(PointsOfACloud, KnowRowAndColumnWhenOrganised) {
  cloud_.height = 3;
  cloud_.width = 4;
  cloud_.row_step = 100;
  std::vector<std::uint8_t> padded(300);
  for (std::size_t i = 0; i < 12; ++i) {
    std::copy_n(cloud_.data.begin() + static_cast<std::ptrdiff_t>(22 * i), 22,
                padded.begin() + static_cast<std::ptrdiff_t>(100 * (i / 4) + 22 * (i % 4)));
  }
  cloud_.data = padded;
  const CloudPoints points = Read();
  ASSERT_EQ(points.size(), 12u);
  EXPECT_EQ(points.row[7], 1u);
  EXPECT_EQ(points.column[7], 3u);
  EXPECT_EQ(points.ring[7], 7 % 4);
}

TEST(PointLayoutSearch, NeedsThreeFloatingCoordinates) {
  EXPECT_FALSE(
      FindLayout({Field("x", 0, FieldType::kFloat32), Field("y", 4, FieldType::kFloat32)}));
  EXPECT_FALSE(FindLayout({Field("x", 0, FieldType::kUint16), Field("y", 2, FieldType::kUint16),
                           Field("z", 4, FieldType::kUint16)}));
}

TEST(PointLayoutSearch, DescribesFieldsForPeople) {
  EXPECT_EQ(
      DescribeFields({Field("x", 0, FieldType::kFloat32), Field("ring", 4, FieldType::kUint16)}),
      "x ring(uint16)");
}

}  // namespace
}  // namespace lio
