// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/finish_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lio/eval/report.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/trajectory_file.hpp"
#include "lio/run/rig_draft.hpp"

namespace lio {

namespace fs = std::filesystem;

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

std::optional<fs::path> WriteCorrectedRig(const fs::path& folder,
                                          const std::vector<fs::path>& files,
                                          const Verdict& verdict) {
  std::vector<Cause> causes = verdict.causes;
  causes.insert(causes.end(), verdict.mended.begin(), verdict.mended.end());
  const auto cause = std::ranges::find_if(causes, [](const Cause& c) { return !c.fix.empty(); });
  if (cause == causes.end()) return std::nullopt;
  const fs::path corrected = folder / "rig_corrected.yaml";
  WriteText(corrected, cause->fix);
  std::vector<fs::path> with_fix = files;
  with_fix.push_back(corrected);
  const LoadResult loaded = LoadOptions(with_fix, {});
  if (!loaded.faults.empty()) {
    fs::remove(corrected);
    return std::nullopt;
  }
  const std::string reason =
      fmt::format("As the run in {} shows: {}.", folder.string(), Name(cause->kind));
  RigDraft draft;
  draft.rig = loaded.options.rig;
  draft.use_imu = loaded.options.pipeline.use_imu;
  draft.input = folder.string();
  draft.command = "lio-run INPUT --rig " + corrected.string() + " --out DIR";
  draft.about.push_back(cause->evidence);
  for (std::string* text :
       {&draft.extrinsic_reason, &draft.lidar_reason, &draft.units_reason, &draft.gravity_reason}) {
    *text = reason;
  }
  draft.noise_reason = "The filter learns more noise than this by itself.";
  WriteText(corrected, RigDraftYaml(draft));
  return corrected;
}

void RemoveStaleFiles(const fs::path& folder, const std::vector<fs::path>& kept) {
  std::error_code ignored;
  for (const char* name :
       {"eval.json", "eval.txt", "conversion.txt", "truth.tum", "rig_corrected.yaml"}) {
    const fs::path file = folder / name;
    const bool is_kept = std::any_of(kept.begin(), kept.end(), [&](const fs::path& other) {
      return fs::equivalent(file, other, ignored);
    });
    if (!is_kept) fs::remove(file, ignored);
  }
}

}  // namespace lio
