// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows the items of a log to Python. Arrays are views on the decoded messages; nothing is copied.
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstddef>
#include <mutex>
#include <utility>

#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/errors.hpp"
#include "python/log_reader.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

// A reader that several threads of Python may ask.
struct SharedReader {
  SharedReader(const std::filesystem::path& log, const std::string& channel_prefix)
      : reader(log, channel_prefix) {}

  std::mutex mutex;  // guards the reader
  LogReader reader;
};

// Adds a property that is a view of one member of all rows; `first` points to that of a row.
template <typename Owner, typename Row, typename First>
void AddColumn(py::class_<Owner>& shown, const char* name, std::vector<Row> Owner::*rows,
               First first, py::ssize_t columns = 1) {
  shown.def_property_readonly(name, [rows, first, columns](const py::object& self) {
    const std::vector<Row>& all = self.cast<const Owner&>().*rows;
    const auto* number = all.empty() ? nullptr : first(all.front());
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(all.size())};
    std::vector<py::ssize_t> strides = {static_cast<py::ssize_t>(sizeof(Row))};
    if (columns > 1) {
      shape.push_back(columns);
      strides.push_back(static_cast<py::ssize_t>(sizeof(*number)));
    }
    return View(self, number, std::move(shape), std::move(strides));
  });
}

void AddImuBatch(py::module_& module) {
  py::class_<ImuBatch> batch(module, "ImuSamples",
                             "Inertial samples that came one after another; arrays are views.");
  batch.def("__len__", [](const ImuBatch& self) { return self.samples.size(); });
  AddColumn(batch, "stamps_ns", &ImuBatch::samples, [](const auto& s) { return &s.stamp.ns; });
  AddColumn(
      batch, "gyro", &ImuBatch::samples, [](const auto& s) { return s.w_imu_radps.data(); }, 3);
  AddColumn(
      batch, "accel", &ImuBatch::samples, [](const auto& s) { return s.f_imu_mps2.data(); }, 3);
}

// Returns the points as rows with named fields, as they lie in memory.
py::array PointRecords(const py::object& self) {
  const auto& points = self.cast<const Sweep&>().points;
  static_assert(offsetof(LidarPoint, t_offset_ns) == 12 && offsetof(LidarPoint, ring) == 18);
  constexpr std::array<std::pair<const char*, const char*>, 6> kFields = {{{"x", "<f4"},
                                                                           {"y", "<f4"},
                                                                           {"z", "<f4"},
                                                                           {"t_offset_ns", "<u4"},
                                                                           {"intensity", "<u2"},
                                                                           {"ring", "<u2"}}};
  py::list fields;
  for (const auto& [name, format] : kFields) fields.append(py::make_tuple(name, format));
  py::array records(py::dtype::from_args(fields), {static_cast<py::ssize_t>(points.size())},
                    {static_cast<py::ssize_t>(sizeof(LidarPoint))}, points.data(), self);
  records.attr("setflags")(py::arg("write") = false);
  return records;
}

void AddScan(py::module_& module) {
  py::class_<Sweep> scan(module, "Scan",
                         "One turn of the lidar, put together from its chunks; arrays are views.");
  scan.def("__len__", [](const Sweep& self) { return self.points.size(); })
      .def_property_readonly("stamp_ns", [](const Sweep& self) { return self.start.ns; })
      .def_property_readonly("end_ns", [](const Sweep& self) { return self.end.ns; })
      .def_readonly("seq", &Sweep::scan_seq)
      .def_readonly("num_missing_chunks", &Sweep::num_missing_chunks)
      .def_property_readonly("records", &PointRecords);
  AddColumn(
      scan, "points", &Sweep::points, [](const auto& p) { return &p.x_m; }, 3);
  AddColumn(scan, "times_ns", &Sweep::points, [](const auto& p) { return &p.t_offset_ns; });
  AddColumn(scan, "intensity", &Sweep::points, [](const auto& p) { return &p.intensity; });
  AddColumn(scan, "rings", &Sweep::points, [](const auto& p) { return &p.ring; });
}

py::object NextItem(SharedReader& self) {
  std::optional<LogItem> item = RunUnlocked([&] {
    const std::lock_guard lock(self.mutex);
    return self.reader.Next();
  });
  if (!item) throw py::stop_iteration();
  return std::visit([](auto& value) { return py::cast(std::move(value)); }, *item);
}

// Adds a count that is complete when the iteration is.
template <typename Count>
void AddCount(py::class_<SharedReader>& log, const char* name, Count count) {
  log.def_property_readonly(name, [count](SharedReader& self) {
    return RunUnlocked([&] {
      const std::lock_guard lock(self.mutex);
      return count(self.reader);
    });
  });
}

}  // namespace

void AddLog(py::module_& module) {
  AddImuBatch(module);
  AddScan(module);
  py::class_<SharedReader> log(module, "LogReader",
                               "The events of a log, as an iterator; see liod.read_log.");
  log.def(
      py::init([](const std::filesystem::path& path, const std::string& channel_prefix) {
        return RunUnlocked([&] { return std::make_unique<SharedReader>(path, channel_prefix); });
      }),
      py::arg("path"), py::arg("channel_prefix") = kDefaultChannelPrefix);
  log.def("__iter__", [](const py::object& self) { return self; });
  log.def("__next__", &NextItem);
  AddCount(log, "num_skipped_bytes", [](const LogReader& r) { return r.num_skipped_bytes(); });
  AddCount(log, "num_refused", [](const LogReader& r) { return r.num_refused(); });
  AddCount(log, "num_missing_chunks",
           [](const LogReader& r) { return r.counters().num_chunks_missing; });
}

}  // namespace lio::python
