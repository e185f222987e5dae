// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <report/page_parts.hpp>  // made by lio_embed_text
#include <string_view>
#include <utility>

#include "lio/io/json_text.hpp"
#include "lio/io/output_file.hpp"
#include "lio/report/run_report.hpp"

namespace lio {
namespace {

// Inside a script element "</" and "<!--" have a meaning of their own. In JSON "<" stands in texts
// alone, where it may be written by its number.
std::string ForScript(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

// Puts each part in the place of its mark. The page is written once, so that a part which holds a
// mark itself is left alone.
std::string Filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string text;
  while (!page.empty()) {
    std::size_t first = page.size();
    const std::pair<std::string_view, std::string>* next = nullptr;
    for (const auto& part : parts) {
      const std::size_t at = page.find(part.first);
      if (at < first) {
        first = at;
        next = &part;
      }
    }
    text += page.substr(0, first);
    if (next == nullptr) break;
    text += next->second;
    page.remove_prefix(first + next->first.size());
  }
  return text;
}

// The parts of the script share one scope, and the last of them starts the page.
std::string PageScript() {
  std::string script;
  for (const std::string_view part : {kRunsJs, kTextsJs, kTimePlotsJs, kChartsJs, kPathJs, kMainJs})
    script += part;
  return script;
}

}  // namespace

std::string ReportPage(const nlohmann::ordered_json& data) {
  return Filled(kPageHtml, {{"@PLOT_LICENCE@", std::string(kPlotLicence)},
                            {"@PLOT_CSS@", std::string(kPlotCss)},
                            {"@PAGE_CSS@", std::string(kPageCss)},
                            {"@DATA@", ForScript(TextOf(data))},
                            {"@PLOT_JS@", std::string(kPlotJs)},
                            {"@PAGE_JS@", PageScript()}});
}

void WriteReport(const std::filesystem::path& folder, const ReportInputs& inputs) {
  WriteText(folder / kReportFile, ReportPage(ReportData(folder, inputs)));
}

void WriteComparison(const std::filesystem::path& page, const std::vector<ComparedRun>& runs) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ComparedRun& run : runs) all.push_back(ReportData(run.folder, run.inputs));
  WriteText(page, ReportPage({{"runs", std::move(all)}}));
}

}  // namespace lio
