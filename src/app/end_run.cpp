// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/end_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <sstream>

#include "lio/io/input_error.hpp"
#include "lio/io/verdict_report.hpp"
#include "lio/report/run_report.hpp"

namespace lio {
namespace {

// Returns what could not be written in full; empty when all is well.
std::string WriteRunReport(const std::filesystem::path& folder) {
  try {
    WriteReport(folder, {folder.string(), std::nullopt, {}});
  } catch (const WriteError& error) {
    return error.what();
  } catch (const std::exception& error) {  // the rows themselves are sound
    spdlog::warn("no report: {}", error.what());
  }
  return {};
}

}  // namespace

void TellVerdict(const Verdict& verdict) {
  std::istringstream lines(VerdictSummary(verdict));
  for (std::string line; std::getline(lines, line);) spdlog::info("{}", line);
}

bool IsOver(const LiveRunner& runner) {
  return runner.has_ended() || runner.fault().has_value();
}

ExitCode EndRun(LiveRunner& runner, const std::string& lcm_url) {
  const bool is_connection_lost = runner.has_ended() && !lcm_url.starts_with("file:");
  std::string unfinished;
  try {
    runner.Stop();
  } catch (const WriteError& error) {
    unfinished = error.what();
  }
  if (const auto fault = runner.fault()) {
    spdlog::error("{}{}{}; the run ends here, please report this fault", *fault,
                  unfinished.empty() ? "" : "; ", unfinished);
    return kExitInternalFault;
  }
  if (runner.verdict()) TellVerdict(*runner.verdict());
  if (unfinished.empty() && runner.verdict() && runner.out()) {
    unfinished = WriteRunReport(*runner.out());
  }
  if (!unfinished.empty()) {
    spdlog::error("{}: the files are not complete", unfinished);
    return kExitWriteFailed;
  }
  const bool is_distrusted = runner.verdict() && runner.verdict()->trust == Trust::kNo;
  if (!is_connection_lost) {
    return is_distrusted && runner.writes_files() ? kExitNoTrust : kExitDone;
  }
  spdlog::error("the connection to {} broke: start its server, then liod", lcm_url);
  return kExitNoTransport;
}

}  // namespace lio
