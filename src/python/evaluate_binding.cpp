// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores paths for Python, as lio-eval does on its command line.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <variant>

#include "lio/eval/report.hpp"
#include "lio/eval/scored_run.hpp"
#include "lio/eval/time_offset.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/trajectory_file.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/errors.hpp"
#include "python/path_arrays.hpp"
#include "python/wishes.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

// The truth or the path to score: a file, or arrays that Python gave.
using Source = std::variant<std::string, Trajectory>;

// Holds an evaluation with its columns for pictures: a row for each pair of poses.
struct Scored {
  std::string json;
  std::string text;
  std::vector<std::int64_t> stamps_ns;
  std::vector<Vector3> truth_m;
  std::vector<Vector3> estimate_m;  // moved by the alignment, onto the truth
  ErrorSeries errors;
};

Source TakeSource(const py::object& given, const char* what) {
  if (py::isinstance<py::tuple>(given)) return TakeTrajectory(given.cast<py::tuple>(), what);
  try {
    return given.cast<std::filesystem::path>().string();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("{}: expects a path, or a tuple of stamps and poses", what));
  }
}

AlignMode ModeOf(const std::string& align) {
  if (align == "none") return AlignMode::kNone;
  if (align == "yaw") return AlignMode::kYaw;
  if (align == "se3") return AlignMode::kSe3;
  throw UsageError("align: expects one of none, yaw, se3, not '" + align + "'");
}

Trajectory ReadSource(const Source& source) {
  if (const auto* trajectory = std::get_if<Trajectory>(&source)) return *trajectory;
  const auto& file = std::get<std::string>(source);
  if (const std::string why = WhyNoTrajectory(file); !why.empty()) throw InputError(why);
  return ReadTrajectory(file);
}

// A file or a folder of a run is scored as lio-eval does it, and arrays likewise.
ScoredRun ScoreSource(const Trajectory& truth, const Source& run, const EvaluationOptions& options,
                      const TimeOffsetWish& wish) {
  if (const auto* file = std::get_if<std::string>(&run)) {
    if (KindOf(*file) == FileKind::kRunFolder) return ScoreRun(truth, *file, options, wish);
    if (const std::string why = WhyNoTrajectory(*file); !why.empty()) throw InputError(why);
    return ScoreRun(truth, *file, options, wish);
  }
  return ScoreTrajectory(truth, std::get<Trajectory>(run), options, wish);
}

Scored Columns(const ScoredRun& run, const Source& truth) {
  const auto* file = std::get_if<std::string>(&truth);
  const ReportedFiles files = {file == nullptr ? "" : *file, run.file};
  const Evaluation& evaluation = run.evaluation;
  nlohmann::ordered_json figures = EvaluationJson(evaluation, files);
  figures["time_offset_s"] = run.time_offset_s;
  Scored scored;
  scored.json = figures.dump();
  scored.text = EvaluationText(evaluation, files);
  scored.errors = ComputeErrorSeries(evaluation);
  for (const PosePair& pair : evaluation.association.pairs) {
    scored.stamps_ns.push_back(pair.stamp.ns);
    scored.truth_m.push_back(pair.truth.translation);
    scored.estimate_m.push_back(evaluation.alignment.T_truth_estimate * pair.estimate.translation);
  }
  return scored;
}

std::unique_ptr<Scored> EvaluatePaths(const py::object& truth_given, const py::object& run_given,
                                      const std::string& align,
                                      const std::optional<double>& max_gap_s,
                                      const std::optional<double>& time_offset_s) {
  const Source truth = TakeSource(truth_given, "truth");
  const Source run = TakeSource(run_given, "run");
  if (max_gap_s && !(*max_gap_s > 0.0 && std::isfinite(*max_gap_s))) {
    throw UsageError("max_gap_s: expects a finite number above 0");
  }
  constexpr double kMostOffset_s = 1e6;
  if (time_offset_s && !(std::abs(*time_offset_s) <= kMostOffset_s)) {
    throw UsageError("time_offset_s: expects 'auto', or a number from -1e6 to 1e6");
  }
  const EvaluationOptions options = {ModeOf(align), max_gap_s};
  const TimeOffsetWish wish = {!time_offset_s, time_offset_s.value_or(0.0)};
  return RunUnlocked([&] {
    return std::make_unique<Scored>(
        Columns(ScoreSource(ReadSource(truth), run, options, wish), truth));
  });
}

// Adds a property that is a view of a vector's numbers.
template <typename Member>
void AddColumn(py::class_<Scored>& scored, const char* name, Member member) {
  scored.def_property_readonly(name, [member](const py::object& self) -> py::array {
    const auto& column = member(self.cast<const Scored&>());
    using Row = typename std::decay_t<decltype(column)>::value_type;
    const auto num_rows = static_cast<py::ssize_t>(column.size());
    constexpr auto kBytes = static_cast<py::ssize_t>(sizeof(Row));
    if constexpr (std::is_same_v<Row, Vector3>) {
      const double* first = column.empty() ? nullptr : column.front().data();
      return View(self, first, {num_rows, 3}, {kBytes, kBytes / 3});
    } else {
      return View(self, column.data(), {num_rows}, {kBytes});
    }
  });
}

}  // namespace

void AddEvaluate(py::module_& module) {
  py::class_<Scored> scored(module, "Scored");
  scored.def_readonly("json", &Scored::json).def_readonly("text", &Scored::text);
  AddColumn(
      scored, "stamps_ns", [](const Scored& s) -> auto& { return s.stamps_ns; });
  AddColumn(
      scored, "truth", [](const Scored& s) -> auto& { return s.truth_m; });
  AddColumn(
      scored, "estimate", [](const Scored& s) -> auto& { return s.estimate_m; });
  AddColumn(
      scored, "position_error_m", [](const Scored& s) -> auto& { return s.errors.position_m; });
  AddColumn(
      scored, "rotation_error_deg", [](const Scored& s) -> auto& { return s.errors.rotation_deg; });
  module.def("evaluate", &EvaluatePaths, py::arg("truth"), py::arg("run"), py::arg("align"),
             py::arg("max_gap_s"), py::arg("time_offset_s"));
}

}  // namespace lio::python
