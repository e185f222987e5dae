// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/pointcloud2_layout.hpp"

#include <cmath>
#include <initializer_list>

namespace lio {
namespace {

std::optional<CloudField> Find(const std::vector<CloudField>& fields,
                               std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    for (const CloudField& field : fields) {
      if (field.name == name) return field;
    }
  }
  return {};
}

bool IsFloat(const CloudField& field) {
  return field.type == FieldType::kFloat32 || field.type == FieldType::kFloat64;
}

// Converts between number types, defined for every input: a float that is no integer of the
// target's range gives 0.
template <typename Out, typename Source>
Out Cast(Source value) {
  if constexpr (std::is_integral_v<Out> && std::is_floating_point_v<Source>) {
    constexpr Source kLimit = 1e9;
    return value > -kLimit && value < kLimit ? static_cast<Out>(value) : Out{0};
  } else {
    return static_cast<Out>(value);
  }
}

// Reads one field of every kept point into `out`.
template <typename Source, typename Out>
void ReadColumnAs(const RosCloud& cloud, std::uint32_t offset,
                  const std::vector<std::size_t>& starts, std::vector<Out>& out) {
  out.resize(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::uint8_t* at = cloud.data.data() + starts[i] + offset;
    out[i] = Cast<Out>(LoadAs<Source>(at, cloud.big_endian));
  }
}

template <typename Out>
void ReadColumn(const RosCloud& cloud, const CloudField& field,
                const std::vector<std::size_t>& starts, std::vector<Out>& out) {
  switch (field.type) {
    case FieldType::kInt8:
      return ReadColumnAs<std::int8_t>(cloud, field.offset, starts, out);
    case FieldType::kUint8:
      return ReadColumnAs<std::uint8_t>(cloud, field.offset, starts, out);
    case FieldType::kInt16:
      return ReadColumnAs<std::int16_t>(cloud, field.offset, starts, out);
    case FieldType::kUint16:
      return ReadColumnAs<std::uint16_t>(cloud, field.offset, starts, out);
    case FieldType::kInt32:
      return ReadColumnAs<std::int32_t>(cloud, field.offset, starts, out);
    case FieldType::kUint32:
      return ReadColumnAs<std::uint32_t>(cloud, field.offset, starts, out);
    case FieldType::kFloat32:
      return ReadColumnAs<float>(cloud, field.offset, starts, out);
    case FieldType::kFloat64:
      return ReadColumnAs<double>(cloud, field.offset, starts, out);
  }
}

double ReadFloat(const RosCloud& cloud, const CloudField& field, std::size_t start) {
  const std::uint8_t* at = cloud.data.data() + start + field.offset;
  return field.type == FieldType::kFloat32 ? LoadAs<float>(at, cloud.big_endian)
                                           : LoadAs<double>(at, cloud.big_endian);
}

bool IsNoise(const RosCloud& cloud, std::uint8_t tag) {
  const std::uint8_t noise = cloud.noise_tag;
  return noise != 0 && ((tag & 3) == noise || ((tag >> 2) & 3) == noise);
}

// Returns where the kept points begin in the cloud's data.
std::vector<std::size_t> KeptStarts(const RosCloud& cloud, const PointLayout& layout,
                                    CloudPoints& points) {
  const bool organised = cloud.height > 1 && cloud.width > 1;
  const bool float_time = layout.time && IsFloat(*layout.time);
  std::vector<std::size_t> starts;
  starts.reserve(cloud.num_points());
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const std::size_t start =
          std::size_t{row} * cloud.row_step + std::size_t{column} * cloud.point_step;
      const auto x = static_cast<float>(ReadFloat(cloud, layout.x, start));
      const auto y = static_cast<float>(ReadFloat(cloud, layout.y, start));
      const auto z = static_cast<float>(ReadFloat(cloud, layout.z, start));
      const double time = float_time ? ReadFloat(cloud, *layout.time, start) : 0.0;
      const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
      if (!finite || !std::isfinite(time)) {
        ++points.num_nonfinite;
      } else if (x == 0.0f && y == 0.0f && z == 0.0f) {
        ++points.num_zero;
      } else if (layout.tag && IsNoise(cloud, cloud.data[start + layout.tag->offset])) {
        ++points.num_noise;
      } else {
        starts.push_back(start);
        if (organised) points.row.push_back(row);
        if (organised) points.column.push_back(column);
      }
    }
  }
  return starts;
}

std::string_view TypeName(FieldType type) {
  constexpr std::string_view kNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                         "int32", "uint32", "float32", "float64"};
  return kNames[static_cast<std::size_t>(type) - 1];
}

}  // namespace

std::optional<PointLayout> FindLayout(const std::vector<CloudField>& fields) {
  const auto x = Find(fields, {"x"});
  const auto y = Find(fields, {"y"});
  const auto z = Find(fields, {"z"});
  if (!x || !y || !z || !IsFloat(*x) || !IsFloat(*y) || !IsFloat(*z)) return {};
  PointLayout layout;
  layout.x = *x;
  layout.y = *y;
  layout.z = *z;
  layout.intensity = Find(fields, {"intensity", "reflectivity", "i"});
  layout.ring = Find(fields, {"ring", "channel", "line", "laser_id"});
  layout.tag = Find(fields, {"tag"});
  if (layout.tag && layout.tag->type != FieldType::kUint8) layout.tag.reset();
  layout.time = Find(fields, {"time", "t", "timestamp", "time_stamp", "offset_time", "ts"});
  return layout;
}

void ReadPoints(const RosCloud& cloud, const PointLayout& layout, CloudPoints& points) {
  points.row.clear();
  points.column.clear();
  points.num_nonfinite = 0;
  points.num_zero = 0;
  points.num_noise = 0;
  const std::vector<std::size_t> starts = KeptStarts(cloud, layout, points);
  ReadColumn(cloud, layout.x, starts, points.x_m);
  ReadColumn(cloud, layout.y, starts, points.y_m);
  ReadColumn(cloud, layout.z, starts, points.z_m);
  points.intensity.assign(starts.size(), 0.0f);
  points.ring.clear();
  points.time.clear();
  if (layout.intensity) ReadColumn(cloud, *layout.intensity, starts, points.intensity);
  if (layout.ring) ReadColumn(cloud, *layout.ring, starts, points.ring);
  if (layout.time) ReadColumn(cloud, *layout.time, starts, points.time);
}

std::string DescribeFields(const std::vector<CloudField>& fields) {
  std::string text;
  for (const CloudField& field : fields) {
    if (!text.empty()) text += ' ';
    text += field.name;
    if (field.name != "x" && field.name != "y" && field.name != "z") {
      text += '(' + std::string(TypeName(field.type)) + ')';
    }
  }
  return text;
}

}  // namespace lio
