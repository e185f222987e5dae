// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows the estimator to Python: arrays in, estimates out. The work is done without Python's lock.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>

#include "lio/base/counters_fields.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/verdict_report.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/errors.hpp"
#include "python/log_reader.hpp"
#include "python/odometry_run.hpp"
#include "python/scan_arrays.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

// An estimator that several threads of Python may use, one at a time.
class SharedRun {
 public:
  SharedRun(const Options& options, const RunSettings& settings) : run_(options, settings) {}

  // Does `work` on the run without Python's lock.
  template <typename Work>
  auto Do(Work&& work) {
    return RunUnlocked([&] {
      const std::lock_guard lock(mutex_);
      return work(run_);
    });
  }

 private:
  std::mutex mutex_;  // guards the run
  OdometryRun run_;
};

Options LoadedOptions(const std::vector<std::filesystem::path>& files,
                      const std::vector<std::string>& sets) {
  const LoadResult loaded = LoadOptions(files, sets);
  if (loaded.faults.empty()) return loaded.options;
  std::string text;
  for (const std::string& fault : loaded.faults) text += (text.empty() ? "" : "\n") + fault;
  throw ConfigurationError(text);
}

std::unique_ptr<SharedRun> MakeRun(const std::vector<std::filesystem::path>& files,
                                   const std::vector<std::string>& sets,
                                   const std::filesystem::path& out, bool overwrites, bool imu_rate,
                                   bool keeps_map) {
  return RunUnlocked([&] {
    return std::make_unique<SharedRun>(LoadedOptions(files, sets),
                                       RunSettings{out, overwrites, imu_rate, keeps_map});
  });
}

std::vector<Estimate> AddSamples(SharedRun& shared, const std::vector<ImuSample>& samples) {
  return shared.Do([&](OdometryRun& run) {
    for (const ImuSample& sample : samples) run.AddImu(sample);
    return run.TakeEstimates();
  });
}

std::vector<Estimate> AddGivenImu(SharedRun& shared, const py::object& stamps,
                                  const py::object& gyro, const py::object& accel) {
  return AddSamples(shared, TakeSamples(stamps, gyro, accel));
}

std::vector<Estimate> AddGivenScan(SharedRun& shared, const py::object& stamp,
                                   const py::object& points, const py::object& times,
                                   const py::object& rings, const py::object& intensity) {
  ScanChunk scan = TakeScan(stamp, points, times, rings, intensity);
  return shared.Do([&](OdometryRun& run) {
    run.AddUnnumbered(std::move(scan));
    return run.TakeEstimates();
  });
}

std::vector<Estimate> AddSweep(SharedRun& shared, const Sweep& sweep) {
  return shared.Do([&](OdometryRun& run) {
    ScanChunk chunk;
    chunk.stamp = sweep.start;
    chunk.scan_seq = sweep.scan_seq;
    // The estimator waits for what is missing, and counts it, as in a replay.
    chunk.chunk_count = static_cast<std::int16_t>(1 + sweep.num_missing_chunks);
    chunk.points = sweep.points;
    run.AddScan(std::move(chunk));
    return run.TakeEstimates();
  });
}

std::vector<Estimate> AddItem(SharedRun& shared, const py::object& item) {
  if (py::isinstance<ImuBatch>(item)) {
    return AddSamples(shared, item.cast<const ImuBatch&>().samples);
  }
  if (py::isinstance<Sweep>(item)) return AddSweep(shared, item.cast<const Sweep&>());
  if (py::isinstance<Estimate>(item)) return {};
  throw py::type_error("add: expects an item of liod.read_log");
}

std::vector<Estimate> Finish(SharedRun& shared) {
  return shared.Do([](OdometryRun& run) {
    run.Finish();
    return run.TakeEstimates();
  });
}

py::dict CountersOf(SharedRun& shared) {
  const Counters counters = shared.Do([](OdometryRun& run) { return run.counters(); });
  py::dict dict;
  for (const CounterField& field : kCounterFields) {
    dict[py::str(field.name.data(), field.name.size())] = counters.*field.count;
  }
  return dict;
}

}  // namespace

void AddOdometry(py::module_& module) {
  py::class_<SharedRun> odometry(module, "Odometry");
  odometry.def(py::init(&MakeRun), py::arg("files"), py::arg("sets"), py::arg("out"),
               py::arg("overwrite"), py::arg("imu_rate"), py::arg("keep_map"));
  odometry.def("add_imu", &AddGivenImu, py::arg("stamp_ns"), py::arg("gyro"), py::arg("accel"),
               "Adds a sample, or N: stamps [ns], rates [rad/s], specific forces [m/s^2].");
  odometry.def("add_scan", &AddGivenScan, py::arg("stamp_ns"), py::arg("points"),
               py::arg("times_ns") = py::none(), py::arg("rings") = py::none(),
               py::arg("intensity") = py::none(),
               "Adds one turn of the lidar: points (N, 3) [m], times after the stamp [ns].");
  odometry.def("add", &AddItem, py::arg("item"), "Adds an event of liod.read_log.");
  odometry.def("finish", &Finish, "Matches what still waits, and completes the files.");
  odometry.def_property_readonly("notices", [](SharedRun& self) {
    return self.Do([](OdometryRun& run) { return run.notices(); });
  });
  odometry.def_property_readonly("status", [](SharedRun& self) {
    return self.Do([](OdometryRun& run) { return run.status(); });
  });
  odometry.def_property_readonly("is_finished", [](SharedRun& self) {
    return self.Do([](OdometryRun& run) { return run.is_finished(); });
  });
  odometry.def_property_readonly("counters", &CountersOf);
  odometry.def("verdict_json", [](SharedRun& self) {
    return self.Do([](OdometryRun& run) { return VerdictJson(run.Judge()); });
  });
  odometry.def_property_readonly("map_points", [](SharedRun& self) {
    return CloudArray(self.Do([](OdometryRun& run) { return run.points_map(); }));
  });
}

}  // namespace lio::python
