// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lio/io/input_guard.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/io/verdict_report.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

// The second pass is written here, in the folder of the run, until it is whole.
constexpr const char* kSecondFolder = ".pass_2";
// Share of the time with poses. Chosen: a start may be some sweeps later.
constexpr double kMaxLessCoverage = 0.01;

struct Pass {
  PassesResult result;
  SensorKnowledge knowledge;
};

Pass RunPass(const PassesRequest& request, const fs::path& folder, const SensorKnowledge* known) {
  const Options options =
      known == nullptr ? request.options : WithFound(request.options, known->sensors);
  LogInput input(request.log, request.input);
  RunWriter writer(folder, options,
                   request.settings.initial_map ? StartIn::kInitialMap : StartIn::kNewMap);
  ReplaySettings settings = request.settings;
  if (request.num_passes > 1) settings.program += known == nullptr ? ": pass 1" : ": pass 2";
  Replay replay(request.options, settings, writer, known);
  replay.Run(input);
  return {{replay.verdict(), replay.refusal(),
           LogComplaint(request.log.string(), input, replay.counters(), request.input),
           writer.failure().value_or("")},
          replay.Knowledge()};
}

bool IsOfRig(const Cause& cause) {
  return IsOfExtrinsic(cause) || cause.kind == CauseKind::kClockOffset ||
         cause.kind == CauseKind::kImuAxes || cause.kind == CauseKind::kImuUnits;
}

// Faults of the rig that the first pass has found and the second one has no more, one of a kind.
std::vector<Cause> Mended(const Verdict& first, const Verdict& second) {
  const auto has = [](const std::vector<Cause>& causes, CauseKind kind) {
    return std::ranges::count(causes, kind, &Cause::kind) > 0;
  };
  std::vector<Cause> mended;
  for (const Cause& cause : first.causes) {
    const bool is_told = has(second.causes, cause.kind) || has(mended, cause.kind);
    if (IsOfRig(cause) && !is_told) mended.push_back(cause);
  }
  return mended;
}

// Puts the files of a whole run into the place of another one.
void Replace(const fs::path& folder, const fs::path& by) {
  for (const fs::path& file : FilesOfRun(folder)) fs::remove(file);
  fs::remove(folder / "beams.yaml");
  for (const fs::directory_entry& entry : fs::directory_iterator(by)) {
    const fs::path target = folder / entry.path().filename();
    if (entry.is_directory()) fs::remove_all(target);  // it is a segment's
    fs::rename(entry.path(), target);
  }
}

}  // namespace

std::string WhyFirstIsKept(const PassesResult& first, const PassesResult& second) {
  if (!second.failure.empty()) return "the second pass could not be written";
  if (!second.refusal.empty() || second.verdict.trust > first.verdict.trust) {
    return "the second pass is trusted less";
  }
  if (second.verdict.coverage < first.verdict.coverage - kMaxLessCoverage) {
    return "the second pass has fewer poses";
  }
  return {};
}

PassesResult RunPasses(const PassesRequest& request) {
  const fs::path second_folder = request.out / kSecondFolder;
  fs::remove_all(second_folder);  // a run that was killed left it
  Pass first = RunPass(request, request.out, nullptr);
  if (request.num_passes < 2 || !first.result.refusal.empty() || !first.result.failure.empty())
    return std::move(first.result);
  if (request.is_rig_drafted) {
    FoundSensors& sensors = first.knowledge.sensors;
    sensors = InAxesOfMessages(sensors, request.options.rig);
  }
  Pass second = RunPass(request, second_folder, &first.knowledge);
  const std::string why_first = WhyFirstIsKept(first.result, second.result);
  if (why_first.empty()) {
    Replace(request.out, second_folder);
    second.result.verdict.mended = Mended(first.result.verdict, second.result.verdict);
    WriteVerdict(request.out, second.result.verdict);
  } else {
    fmt::print(stderr, "{}: {}, so the files are those of the first\n", request.settings.program,
               why_first);
  }
  fs::remove_all(second_folder);
  if (why_first.empty()) return std::move(second.result);
  first.result.failure = second.result.failure;
  return std::move(first.result);
}

}  // namespace lio
