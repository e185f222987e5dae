// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "page_commands.hpp"

#include <fmt/format.h>

#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/report/run_report.hpp"
#include "lio/run/finish_run.hpp"
#include "lio/run/run_pages.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

ExitCode OnePage(const PageArguments& arguments) {
  const fs::path folder = arguments.inputs.front();
  if (!arguments.out.empty() && !fs::equivalent(arguments.out, folder)) {
    throw UsageError(folder.string() +
                     " is the folder of a run: its report is written there, leave out --out");
  }
  const std::optional<fs::path> truth = arguments.truth ? arguments.truth : TruthOfRun(folder);
  if (truth) {
    const Score score = ScoreRun(folder, *truth);
    fmt::print("{}{}\n", score.is_scored ? "score       " : "no score    ", score.line);
  }
  WriteReport(folder, {folder.string(), truth, {}});
  fmt::print("report      {}\n", (folder / kReportFile).string());
  return kExitDone;
}

ExitCode OnePageOfAll(const PageArguments& arguments) {
  for (const std::string& input : arguments.inputs) {
    if (KindOf(input) == FileKind::kRunFolder) continue;
    throw UsageError(input +
                     ": is no folder of a finished run; several INPUTs are compared, and each "
                     "must be one");
  }
  if (arguments.out.empty()) {
    throw UsageError("--out is required: name a folder for the page of all runs (see --help)");
  }
  const std::vector<fs::path> folders(arguments.inputs.begin(), arguments.inputs.end());
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (!fs::equivalent(folder, arguments.out, ignored)) continue;
    throw UsageError(folder.string() + " has a page of its own; name another folder with --out");
  }
  const fs::path page = CompareRuns(folders, arguments.truth, arguments.out, arguments.overwrites);
  fmt::print("report      {}\n", page.string());
  return kExitDone;
}

}  // namespace

std::optional<ExitCode> WritePages(const PageArguments& arguments) {
  if (arguments.inputs.size() > 1) return OnePageOfAll(arguments);
  if (KindOf(arguments.inputs.front()) != FileKind::kRunFolder) return std::nullopt;
  return OnePage(arguments);
}

}  // namespace lio
