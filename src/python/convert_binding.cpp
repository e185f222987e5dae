// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts recordings for Python, as lio-convert does on its command line.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "lio/convert/kitti_odometry.hpp"
#include "lio/convert/kitti_raw.hpp"
#include "lio/convert/pcap_convert.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_guard.hpp"
#include "python/bindings.hpp"
#include "python/errors.hpp"
#include "python/wishes.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace lio::python {
namespace {

constexpr double kLongest_s = 1e9;  // 30 years

struct Conversion {
  std::string kind;
  std::string summary;  // as lio-convert prints it
  bool is_damaged = false;
};

// Returns what stands for the name in a table of names and values.
template <typename Value, std::size_t kNum>
std::optional<Value> Choose(const std::optional<std::string>& name, const char* option,
                            const std::array<std::pair<const char*, Value>, kNum>& table) {
  if (!name || *name == "auto") return std::nullopt;
  std::string known = "auto";
  for (const auto& [text, value] : table) {
    if (*name == text) return value;
    known += fmt::format(", {}", text);
  }
  throw UsageError(fmt::format("{}: expects one of {}, not '{}'", option, known, *name));
}

// No output may replace an input, and results or logs need not be converted. The recording is the
// first of the inputs.
void Guard(const Paths& inputs, const std::vector<std::optional<fs::path>>& outputs) {
  for (const auto& output : outputs) RefuseToOverwrite(inputs, {output.value_or("")});
  if (const std::string why = WhyNoRecording(inputs.front()); !why.empty()) throw InputError(why);
}

// Lets Python's handlers of signals run, and throws what they raise: KeyboardInterrupt ends a
// conversion.
void HeedSignals() {
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Converts, without Python's lock; `convert` makes a report.
template <typename Options, typename Convert>
Conversion Run(const char* kind, Options& options, Convert&& convert) {
  options.progress = [](double) { HeedSignals(); };
  return RunUnlocked([&] {
    const auto report = convert(options);
    return Conversion{kind, FormatReport(report, options), report.IsDamaged()};
  });
}

Conversion ConvertBag(const fs::path& input, const fs::path& output, Wishes wishes) {
  RosbagOptions options;
  options.input = input;
  options.output = output;
  options.lidar_topic = wishes.Text("lidar_topic");
  options.imu_topic = wishes.Text("imu_topic");
  options.truth_topic = wishes.Text("truth_topic");
  options.truth_file = wishes.Path("truth");
  options.lidar_model = wishes.Text("lidar").value_or(options.lidar_model);
  options.point_time.unit = Choose<TimeUnit, 4>(wishes.Text("point_time"), "point_time",
                                                {{{"s", TimeUnit::kSeconds},
                                                  {"ms", TimeUnit::kMilliseconds},
                                                  {"us", TimeUnit::kMicroseconds},
                                                  {"ns", TimeUnit::kNanoseconds}}});
  options.point_time.stamp = Choose<StampMeaning, 2>(
      wishes.Text("stamp"), "stamp",
      {{{"start", StampMeaning::kSweepStart}, {"end", StampMeaning::kSweepEnd}}});
  options.start_s = wishes.Number("start_s", 0.0, kLongest_s).value_or(0.0);
  options.duration_s = wishes.Number("duration_s", std::numeric_limits<double>::min(), kLongest_s);
  options.whole_scans = wishes.Flag("whole_scans");
  wishes.DemandAllTaken();
  if (options.truth_topic && !options.truth_file) {
    throw UsageError("truth_topic: needs truth, the file to write");
  }
  Guard({input}, {output, options.truth_file});
  return Run("rosbag", options, ConvertRosbag);
}

Conversion ConvertCapture(const fs::path& input, const fs::path& output, Wishes wishes) {
  PcapOptions options;
  options.input = input;
  options.output = output;
  options.sensor = wishes.Text("sensor");
  options.imu = wishes.Path("imu");
  options.metadata = wishes.Path("metadata");
  options.whole_scans = wishes.Flag("whole_scans");
  wishes.DemandAllTaken();
  Guard(InputsOf(options), {output});
  return Run("pcap", options, ConvertPcap);
}

Conversion ConvertRaw(const fs::path& input, const fs::path& output, Wishes wishes) {
  KittiRawOptions options;
  options.drive = input;
  options.output = output;
  options.truth_file = wishes.Path("truth");
  options.rig_file = wishes.Path("rig");
  options.imu_rate_hz = wishes.Number("imu_rate_hz", 1.0, 10'000.0);
  wishes.DemandAllTaken();
  Guard(InputsOf(options), {output, options.truth_file, options.rig_file});
  return Run("kitti-raw", options, ConvertKittiRaw);
}

Conversion ConvertSequence(const fs::path& input, const fs::path& output, Wishes wishes) {
  KittiOdometryOptions options;
  options.sequence = input;
  options.output = output;
  options.truth_file = wishes.Path("truth");
  options.poses_file = wishes.Path("poses");
  options.vertical_correction_deg =
      wishes.Number("vertical_correction_deg", -5.0, 5.0).value_or(0.0);
  wishes.DemandAllTaken();
  if (options.poses_file && !options.truth_file) {
    throw UsageError("poses: needs truth, the file to write");
  }
  Guard(InputsOf(options), {output, options.truth_file});
  return Run("kitti-odometry", options, ConvertKittiOdometry);
}

// Finds out what the recording is, unless `kind` says it.
std::string ChosenKind(const std::optional<std::string>& kind, const fs::path& input) {
  if (kind) return *kind;
  switch (RunUnlocked([&] { return KindOf(input); })) {
    case FileKind::kRosBag:
      return "rosbag";
    case FileKind::kCapture:
      return "pcap";
    case FileKind::kKittiRaw:
      return "kitti-raw";
    case FileKind::kKittiOdometry:
      return "kitti-odometry";
    default:
      break;
  }
  if (!fs::exists(input)) throw InputError(input.string() + ": does not exist");
  const std::string why = WhyNoRecording(input);
  throw InputError(why.empty() ? input.string() + ": is no recording that liod.convert knows: " +
                                     "a ROS bag, a network capture, or a drive of KITTI"
                               : why);
}

Conversion ConvertAny(const fs::path& input, const fs::path& output,
                      const std::optional<std::string>& kind, const py::dict& options) {
  const std::string chosen = ChosenKind(kind, input);
  Wishes wishes(options.attr("copy")(), "a conversion of the kind " + chosen);
  if (chosen == "rosbag") return ConvertBag(input, output, std::move(wishes));
  if (chosen == "pcap") return ConvertCapture(input, output, std::move(wishes));
  if (chosen == "kitti-raw") return ConvertRaw(input, output, std::move(wishes));
  if (chosen == "kitti-odometry") return ConvertSequence(input, output, std::move(wishes));
  throw UsageError("kind: expects one of rosbag, pcap, kitti-raw, kitti-odometry, not '" + chosen +
                   "'");
}

}  // namespace

void AddConvert(py::module_& module) {
  py::class_<Conversion>(module, "Conversion")
      .def_readonly("kind", &Conversion::kind)
      .def_readonly("summary", &Conversion::summary)
      .def_readonly("is_damaged", &Conversion::is_damaged)
      .def("__repr__", [](const Conversion& self) {
        return "<liod.Conversion of " + self.kind + (self.is_damaged ? ", damaged>" : ">");
      });
  module.def("convert", &ConvertAny, py::arg("recording"), py::arg("log"), py::arg("kind"),
             py::arg("options"));
}

}  // namespace lio::python
