// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows estimates, matches and notices to Python. Vectors and matrices are views on the estimate.
#include <pybind11/stl.h>

#include <array>

#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/estimate.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

using EstimateClass = py::class_<Estimate>;

constexpr std::array<const char*, 6> kMatchNames = {"converged", "max_iterations", "too_few_points",
                                                    "empty_map", "diverged",       "degenerate"};
constexpr std::array<const char*, 3> kSeverityNames = {"info", "warning", "error"};

// Adds a property that is a view of what `member` returns a reference to.
template <typename Member>
void AddView(EstimateClass& estimate, const char* name, Member member) {
  estimate.def_property_readonly(name, [member](const py::object& self) {
    return MatrixView(self, member(self.cast<const Estimate&>()));
  });
}

// Likewise; None where the estimate does not have it.
template <typename Member>
void AddView(EstimateClass& estimate, const char* name, bool Estimate::*has, Member member) {
  estimate.def_property_readonly(name, [member, has](const py::object& self) -> py::object {
    const auto& owner = self.cast<const Estimate&>();
    if (!(owner.*has)) return py::none();
    return MatrixView(self, member(owner));
  });
}

template <typename Member>
void AddNumber(EstimateClass& estimate, const char* name, Member member) {
  estimate.def_property_readonly(name, [member](const Estimate& self) -> py::object {
    return self.has_filter ? py::cast(self.report.*member) : py::none();
  });
}

void AddEnums(py::module_& module) {
  py::enum_<TrackingStatus>(module, "Status")
      .value("INIT", TrackingStatus::kInit)
      .value("OK", TrackingStatus::kOk)
      .value("DEGENERATE", TrackingStatus::kDegenerate)
      .value("COASTING", TrackingStatus::kCoasting)
      .value("LOST", TrackingStatus::kLost);
  py::enum_<OdometrySource>(module, "Source")
      .value("SCAN", OdometrySource::kScanUpdate)
      .value("IMU", OdometrySource::kImuPropagated);
}

void AddMatch(py::module_& module) {
  py::class_<ScanReport>(module, "Match", "The registration of a scan.")
      .def_property_readonly("stamp_ns", [](const ScanReport& self) { return self.stamp.ns; })
      .def_readonly("scan_seq", &ScanReport::scan_seq)
      .def_property_readonly("status",
                             [](const ScanReport& self) {
                               return kMatchNames.at(static_cast<std::size_t>(self.status));
                             })
      .def_readonly("is_fused", &ScanReport::fused)
      .def_readonly("num_raw", &ScanReport::num_raw)
      .def_readonly("num_used", &ScanReport::num_used)
      .def_readonly("num_matched", &ScanReport::num_matched)
      .def_readonly("iterations", &ScanReport::iterations)
      .def_readonly("residual_rms_m", &ScanReport::residual_rms_m)
      .def_readonly("degenerate_mask", &ScanReport::degenerate_mask)
      .def_readonly("nis", &ScanReport::nis);
}

void AddNotice(py::module_& module) {
  py::class_<Notice>(module, "Notice", "The estimator tells people this.")
      .def_property_readonly("stamp_ns", [](const Notice& self) { return self.stamp.ns; })
      .def_property_readonly("severity",
                             [](const Notice& self) {
                               return kSeverityNames.at(static_cast<std::size_t>(self.severity));
                             })
      .def_readonly("text", &Notice::text)
      .def("__repr__", [](const Notice& self) { return "<liod.Notice: " + self.text + ">"; });
}

void AddStamps(EstimateClass& estimate) {
  estimate
      .def_property_readonly("channel",
                             [](const Estimate& self) -> py::object {
                               if (self.channel.empty()) return py::none();
                               return py::str(self.channel);
                             })
      .def_property_readonly("stamp_ns", [](const Estimate& e) { return e.report.nav.stamp.ns; })
      .def_property_readonly("scan_seq", [](const Estimate& e) { return e.report.nav.scan_seq; })
      .def_property_readonly("source", [](const Estimate& e) { return e.report.nav.source; })
      .def_property_readonly("status",
                             [](const Estimate& self) -> py::object {
                               if (!self.has_status) return py::none();
                               return py::cast(self.report.nav.status);
                             })
      .def_readonly("match", &Estimate::match)
      .def("__repr__", [](const Estimate& self) {
        return "<liod.Estimate at " + std::to_string(self.report.nav.stamp.ns) + " ns>";
      });
}

void AddWorld(EstimateClass& estimate) {
  estimate.def_property_readonly(
      "pose", [](const Estimate& self) { return PoseMatrix(self.report.nav.T_world_imu); });
  AddView(
      estimate, "position",
      [](const Estimate& e) -> auto& { return e.report.nav.T_world_imu.translation; });
  AddView(
      estimate, "quaternion_xyzw",
      [](const Estimate& e) -> auto& { return e.report.nav.T_world_imu.rotation.coeffs(); });
  AddView(
      estimate, "covariance", [](const Estimate& e) -> auto& { return e.report.nav.pose_cov; });
  AddView(
      estimate, "velocity",
      [](const Estimate& e) -> auto& { return e.report.nav.v_world_imu_mps; });
  AddView(
      estimate, "velocity_covariance",
      [](const Estimate& e) -> auto& { return e.report.nav.velocity_cov; });
  AddView(
      estimate, "angular_rate",
      [](const Estimate& e) -> auto& { return e.report.nav.w_imu_radps; });
}

void AddMapFrame(EstimateClass& estimate) {
  estimate.def_property_readonly("map_pose", [](const Estimate& self) -> py::object {
    if (!self.has_map) return py::none();
    return PoseMatrix(self.report.nav.T_map_imu);
  });
  AddView(
      estimate, "map_covariance", &Estimate::has_map,
      [](const Estimate& e) -> auto& { return e.report.nav.map_pose_cov; });
  estimate.def_property_readonly("base_pose", [](const Estimate& self) -> py::object {
    const auto& base = self.report.nav.base;
    if (!base) return py::none();
    return PoseMatrix(base->T_world_base);
  });
}

void AddFilter(EstimateClass& estimate) {
  const auto add = [&](const char* name, auto member) {
    AddView(estimate, name, &Estimate::has_filter, member);
  };
  add(
      "gyro_bias", [](const Estimate& e) -> auto& { return e.report.gyro_bias_radps; });
  add(
      "accel_bias", [](const Estimate& e) -> auto& { return e.report.accel_bias_mps2; });
  add(
      "gravity", [](const Estimate& e) -> auto& { return e.report.g_world_mps2; });
  add(
      "filter_covariance", [](const Estimate& e) -> auto& { return e.report.cov; });
  AddNumber(estimate, "clock_offset_s", &FilterReport::clock_offset_s);
  AddNumber(estimate, "clock_offset_std_s", &FilterReport::clock_offset_std_s);
  AddNumber(estimate, "nis", &FilterReport::nis);
  AddNumber(estimate, "nis_dof", &FilterReport::nis_dof);
}

}  // namespace

void AddEstimates(py::module_& module) {
  AddEnums(module);
  AddMatch(module);
  AddNotice(module);
  EstimateClass estimate(module, "Estimate",
                         "Pose, covariance, velocity, biases and status at one instant.");
  AddStamps(estimate);
  AddWorld(estimate);
  AddMapFrame(estimate);
  AddFilter(estimate);
}

}  // namespace lio::python
