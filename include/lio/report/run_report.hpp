// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the page that shows a run: report.html, one file that needs neither a network nor other
// files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lio {

inline constexpr const char* kReportFile = "report.html";

struct ReportInputs {
  std::string input;                           // the recording, for the title
  std::optional<std::filesystem::path> truth;  // a TUM file
  std::vector<std::string> assumptions;        // sentences that a reader must know
};

// Collects what the page shows from the files that RunWriter left in `folder`; docs/report.md names
// the parts. A file that is missing leaves its part out. Throws std::runtime_error that names file
// and line where a file is damaged.
[[nodiscard]] nlohmann::ordered_json ReportData(const std::filesystem::path& folder,
                                                const ReportInputs& inputs);

// Returns the whole page as text: of ReportData, or of {"runs": [ReportData, ...]} for several runs
// on one page.
[[nodiscard]] std::string ReportPage(const nlohmann::ordered_json& data);

// Writes folder/report.html. Throws std::runtime_error as ReportData does, and when the file cannot
// be written.
void WriteReport(const std::filesystem::path& folder, const ReportInputs& inputs);

struct ComparedRun {
  std::filesystem::path folder;
  ReportInputs inputs;
};

// Writes a page with all of the runs on it. Throws as WriteReport does.
void WriteComparison(const std::filesystem::path& page, const std::vector<ComparedRun>& runs);

}  // namespace lio
