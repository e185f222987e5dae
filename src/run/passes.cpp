// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lio/io/input_error.hpp"
#include "lio/io/run_folder.hpp"
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
  FoundByReplay found;
};

Pass RunPass(const PassesRequest& request, const fs::path& folder, const FoundByReplay* found) {
  const Options options =
      found == nullptr ? request.options : WithFound(request.options, found->sensors);
  LogInput input(request.log, request.input);
  RunWriter writer(folder, options,
                   request.settings.initial_map ? StartIn::kInitialMap : StartIn::kNewMap);
  ReplaySettings settings = request.settings;
  if (request.num_passes > 1) settings.program += found == nullptr ? ": pass 1" : ": pass 2";
  Replay replay(request.options, settings, writer, found);
  replay.Run(input);
  Pass pass;
  pass.result.verdict = replay.verdict();
  pass.result.refusal = replay.refusal();
  pass.result.complaint =
      LogComplaint(request.log.string(), input, replay.counters(), request.input);
  pass.result.failure = writer.failure().value_or("");
  pass.found = replay.found();
  return pass;
}

// Did the second pass begin with something that mends the cause?
bool IsMendedBy(const FoundSensors& found, const Cause& cause) {
  if (IsOfExtrinsic(cause)) return found.T_imu_lidar.has_value();
  if (cause.kind == CauseKind::kClockOffset) return found.clock.mean[0] != 0.0;
  return cause.kind == CauseKind::kImuAxes || cause.kind == CauseKind::kImuUnits;
}

// Faults of the rig that the first pass has found and the second one no longer has, one of a kind.
std::vector<Cause> Mended(const Pass& first, const Verdict& second) {
  const auto has = [](const std::vector<Cause>& causes, CauseKind kind) {
    return std::ranges::count(causes, kind, &Cause::kind) > 0;
  };
  std::vector<Cause> mended;
  for (const Cause& cause : first.result.verdict.causes) {
    const bool is_told = has(second.causes, cause.kind) || has(mended, cause.kind);
    if (!is_told && IsMendedBy(first.found.sensors, cause)) mended.push_back(cause);
  }
  return mended;
}

// Is there anything that a second pass could begin with?
bool IsWorthASecond(const PassesResult& first) {
  return first.refusal.empty() && first.failure.empty() && first.verdict.coverage > 0.0;
}

// A fault of the second pass leaves the first one whole.
PassesResult RunSecond(const PassesRequest& request, const Pass& first) {
  const fs::path folder = request.out / kSecondFolder;
  PassesResult second;
  try {
    second = RunPass(request, folder, &first.found).result;
    second.verdict.mended = Mended(first, second.verdict);
    WriteVerdict(folder, second.verdict);
  } catch (const std::runtime_error& error) {
    second.failure = error.what();
  }
  return second;
}

void TakeSecond(const fs::path& out) {
  try {
    ReplaceRun(out, out / kSecondFolder);
  } catch (const fs::filesystem_error& error) {
    throw WriteError(fmt::format("{}; the rest of the second pass is in {}", error.what(),
                                 (out / kSecondFolder).string()));
  }
}

}  // namespace

std::string WhyFirstIsKept(const PassesResult& first, const PassesResult& second) {
  if (!second.failure.empty()) return "the second pass could not be written: " + second.failure;
  if (!second.refusal.empty()) return "the second pass was refused: " + second.refusal;
  if (second.verdict.trust > first.verdict.trust) return "the second pass is trusted less";
  if (second.verdict.coverage < first.verdict.coverage - kMaxLessCoverage) {
    return "the second pass has fewer poses";
  }
  return {};
}

PassesResult RunPasses(const PassesRequest& request) {
  std::error_code ignored;
  fs::remove_all(request.out / kSecondFolder, ignored);  // a run that was killed left it
  Pass first = RunPass(request, request.out, nullptr);
  if (request.num_passes < 2 || !IsWorthASecond(first.result)) return std::move(first.result);
  if (request.is_mounting_assumed) {
    FoundSensors& sensors = first.found.sensors;
    sensors = InAxesOfMessages(sensors, request.options.rig);
  }
  PassesResult second = RunSecond(request, first);
  const std::string why_first = WhyFirstIsKept(first.result, second);
  if (why_first.empty()) TakeSecond(request.out);
  fs::remove_all(request.out / kSecondFolder, ignored);
  if (why_first.empty()) return second;
  fmt::print(stderr, "{}: {}; the files are those of the first pass, and whole\n",
             request.settings.program, why_first);
  first.result.failure_of_second = second.failure;
  return std::move(first.result);
}

}  // namespace lio
