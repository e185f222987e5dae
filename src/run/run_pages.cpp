// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/run_pages.hpp"

#include <fstream>

#include "lio/io/input_error.hpp"
#include "lio/report/run_report.hpp"

namespace lio {

namespace fs = std::filesystem;

std::optional<fs::path> TruthOfRun(const fs::path& folder) {
  std::error_code error;
  if (fs::is_regular_file(folder / "truth.tum", error)) return folder / "truth.tum";
  std::ifstream stream(folder / "eval.json");
  const auto score = nlohmann::json::parse(stream, nullptr, false);
  if (!score.is_object() || !score.contains("truth")) return std::nullopt;
  if (!score["truth"].is_string()) return std::nullopt;
  const fs::path named = score["truth"].get<std::string>();
  if (!fs::is_regular_file(named, error)) return std::nullopt;
  return named;
}

fs::path CompareRuns(const std::vector<fs::path>& folders, const std::optional<fs::path>& truth,
                     const fs::path& out, bool overwrites) {
  const fs::path page = out / kReportFile;
  if (fs::exists(page) && !overwrites) {
    throw UsageError(page.string() + ": exists; name another folder or add --overwrite");
  }
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw UsageError("--out: cannot create " + out.string() + ": " + error.message());
  std::vector<ComparedRun> runs;
  runs.reserve(folders.size());
  for (const fs::path& folder : folders) {
    runs.push_back({folder, {folder.string(), truth ? truth : TruthOfRun(folder), {}}});
  }
  WriteComparison(page, runs);
  return page;
}

}  // namespace lio
