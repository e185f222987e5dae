// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/finish_run.hpp"

#include <fmt/format.h>

#include "lio/eval/report.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

void WriteText(const fs::path& path, const std::string& text) {
  OutputFile file = OpenOutput(path);
  file.stream << text;
  Close(file);
}

}  // namespace

Score ScoreRun(const fs::path& folder, const fs::path& truth) {
  const fs::path path = PathOfRun(folder);
  Evaluation evaluation;
  try {
    evaluation = Evaluate(ReadTrajectory(truth), ReadTrajectory(path), {});
  } catch (const std::runtime_error& error) {
    return {error.what(), false};
  }
  const ReportedFiles files = {truth.string(), path.string()};
  WriteText(folder / "eval.json", EvaluationJson(evaluation, files).dump(2) + "\n");
  WriteText(folder / "eval.txt", EvaluationText(evaluation, files));
  const ErrorStats& position = evaluation.ape.position_m;
  return {fmt::format("position error {:.3f} m rmse, {:.3f} m at most, over {:.1f} m of path",
                      position.rmse, position.max, evaluation.path_length_m),
          true};
}

void RemoveStaleFiles(const fs::path& folder, const std::optional<fs::path>& kept) {
  std::error_code ignored;
  for (const char* name : {"eval.json", "eval.txt", "conversion.txt", "truth.tum"}) {
    const fs::path file = folder / name;
    if (kept && fs::equivalent(file, *kept, ignored)) continue;
    fs::remove(file, ignored);
  }
}

}  // namespace lio
