// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/pipeline/options_fields.hpp"
#include "lio/sensor/beam_errors.hpp"

namespace lio {
namespace {

std::string RangeText(const Range& range) {
  if (std::isinf(range.max)) return fmt::format("at least {:.9g}", range.min);
  if (std::isinf(range.min)) return fmt::format("at most {:.9g}", range.max);
  return fmt::format("within {:.9g} .. {:.9g}", range.min, range.max);
}

// Checks each field on its own: finite, and inside its range.
class FieldChecker {
 public:
  explicit FieldChecker(std::vector<OptionFault>& faults) : faults_(faults) {}

  template <class T>
  void operator()(const char* key, const T& field, const char* /*meaning*/, Range range = {}) {
    const std::string outer = key_;
    key_ += key;
    Check(field, range);
    key_ = outer;
  }

 private:
  void Fault(std::string message) { faults_.push_back({key_, std::move(message)}); }

  void Check(double value, const Range& range) {
    if (!std::isfinite(value)) {
      Fault("must be a finite number");
    } else if (value < range.min || value > range.max) {
      Fault(fmt::format("is {:.9g}, must be {}", value, RangeText(range)));
    }
  }
  void Check(int value, const Range& range) { Check(static_cast<double>(value), range); }
  void Check(bool, const Range&) {}
  void Check(const Vector3& value, const Range& range) { CheckEach(value, range); }
  void Check(const std::vector<double>& value, const Range& range) { CheckEach(value, range); }
  template <class Values>
  void CheckEach(const Values& values, const Range& range) {
    const auto is_finite = [](double v) { return std::isfinite(v); };
    const auto is_inside = [&](double v) { return v >= range.min && v <= range.max; };
    if (!std::all_of(values.begin(), values.end(), is_finite)) {
      Fault("must be finite numbers");
    } else if (!std::all_of(values.begin(), values.end(), is_inside)) {
      Fault("every entry must be " + RangeText(range));
    }
  }
  void Check(const Quaternion& value, const Range&) {
    if (!value.coeffs().allFinite()) {
      Fault("must be finite numbers");
    } else if (std::abs(value.norm() - 1.0) > kMaxQuaternionNormError) {
      Fault(fmt::format("has norm {:.9g}, a rotation needs norm 1 (w first)", value.norm()));
    }
  }
  void Check(const std::string& value, const Range&) {
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (value.empty() || !std::all_of(value.begin(), value.end(), is_plain)) {
      Fault("must be a name of lower-case letters, digits and underscores");
    }
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void Check(Enum value, const Range&) {
    if (static_cast<std::size_t>(value) >= kEnumNames<Enum>.size()) Fault("is no known choice");
  }
  template <class T>
  void Check(const std::optional<T>& value, const Range& range) {
    if (value) Check(*value, range);
  }
  template <class Group>
  requires kIsGroup<Group>
  void Check(const Group& group, const Range&) {
    key_ += '.';
    VisitFields(*this, group);
  }

  std::vector<OptionFault>& faults_;
  std::string key_;  // dotted path of the field being checked
};

void CheckBox(const OwnVehicleBox& box, std::vector<OptionFault>& faults) {
  if (!(box.min_m.array() < box.max_m.array()).all()) {
    faults.push_back({"rig.lidar.own_vehicle_box", "min_m must be below max_m in x, y and z"});
  }
}

void CheckBeams(const LidarBeams& beams, std::vector<OptionFault>& faults) {
  const auto check = [&](const char* key, const std::vector<double>& list, std::size_t size) {
    if (list.size() == size) return;
    faults.push_back({fmt::format("rig.lidar.beams.{}", key),
                      fmt::format("has {} entries, must have {}", list.size(), size)});
  };
  const std::size_t num_rings = beams.range_m.size();
  if (num_rings == 0 || num_rings > kMaxCalibratedRings) {
    faults.push_back({"rig.lidar.beams.range_m",
                      fmt::format("has {} entries, must have one for each ring, 1 .. {}", num_rings,
                                  kMaxCalibratedRings)});
  }
  check("range_std_m", beams.range_std_m, num_rings);
  check("elevation_rad", beams.elevation_rad, num_rings);
  check("elevation_std_rad", beams.elevation_std_rad, num_rings);
  check("azimuth_rad", beams.azimuth_rad, num_rings);
  check("azimuth_std_rad", beams.azimuth_std_rad, num_rings);
  check("encoder_rad", beams.encoder_rad, 2);
  check("encoder_std_rad", beams.encoder_std_rad, 2);
}

// Some fields make demands on others: this checks them.
void CheckAcross(const Options& o, std::vector<OptionFault>& faults) {
  if (o.pipeline.use_imu && !o.rig.T_imu_lidar) {
    faults.push_back({"rig.T_imu_lidar",
                      "is required with an IMU: give translation_m and rotation_wxyz, or set "
                      "pipeline.use_imu to false"});
  }
  if (o.pipeline.publish_features && o.pipeline.method != MatchMethod::kLoam) {
    faults.push_back({"pipeline.publish_features", "needs pipeline.method: loam"});
  }
  if (o.rig.lidar.own_vehicle_box) CheckBox(*o.rig.lidar.own_vehicle_box, faults);
  if (o.rig.lidar.beams) CheckBeams(*o.rig.lidar.beams, faults);
  if (o.rig.lidar.min_range_m >= o.rig.lidar.max_range_m) {
    faults.push_back({"rig.lidar.min_range_m", "must be below rig.lidar.max_range_m"});
  }
  if (o.reduce.min_voxel_m > o.reduce.voxel_m) {
    faults.push_back({"reduce.min_voxel_m", "must not be above reduce.voxel_m"});
  }
  if (o.reduce.voxel_m > o.reduce.max_voxel_m) {
    faults.push_back({"reduce.voxel_m", "must not be above reduce.max_voxel_m"});
  }
  if (o.ndt.min_cell_points >= o.ndt.max_cell_points) {
    faults.push_back({"ndt.min_cell_points", "must be below ndt.max_cell_points"});
  }
}

}  // namespace

std::vector<OptionFault> Validate(const Options& options) {
  std::vector<OptionFault> faults;
  FieldChecker checker(faults);
  VisitFields(checker, options);
  CheckAcross(options, faults);
  return faults;
}

}  // namespace lio
