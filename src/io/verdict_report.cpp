// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/verdict_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "lio/io/output_file.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

// Rounded to so many steps a unit: the file does not show the last bits of a processor.
Json Rounded(std::optional<double> value, double steps) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return std::round(*value * steps) / steps;
}

Json CausesJson(const std::vector<Cause>& causes) {
  Json json = Json::array();
  for (const Cause& cause : causes) {
    json.push_back({{"kind", Name(cause.kind)},
                    {"leaves", Name(cause.leaves)},
                    {"sigma", Rounded(cause.sigma, 10.0)},
                    {"evidence", cause.evidence},
                    {"fix", cause.fix}});
  }
  return json;
}

std::string Indented(const std::string& text) {
  std::istringstream stream(text);
  std::string indented;
  for (std::string line; std::getline(stream, line);) indented += "      " + line + "\n";
  return indented;
}

}  // namespace

std::string VerdictJson(const Verdict& verdict) {
  Json json;
  json["trust"] = Name(verdict.trust);
  json["coverage"] = Rounded(verdict.coverage, 1e4);
  json["claimed"] = {
      {"position_std_m_per_100m", Rounded(verdict.claimed.position_std_m_per_100m, 1e4)},
      {"tilt_std_deg", Rounded(verdict.claimed.tilt_std_deg, 1e4)}};
  json["causes"] = CausesJson(verdict.causes);
  if (!verdict.mended.empty()) json["mended"] = CausesJson(verdict.mended);
  return json.dump(2) + "\n";
}

void WriteVerdict(const std::filesystem::path& folder, const Verdict& verdict) {
  WriteText(folder / "verdict.json", VerdictJson(verdict));
}

std::string VerdictSummary(const Verdict& verdict) {
  std::string text = fmt::format("trust: {}; poses for {:.0f} % of the time", Name(verdict.trust),
                                 100.0 * verdict.coverage);
  if (const auto& position = verdict.claimed.position_std_m_per_100m) {
    text += fmt::format("; claimed: {:.2f} m per 100 m", *position);
  }
  if (const auto& tilt = verdict.claimed.tilt_std_deg) {
    text += fmt::format("{}{:.2f} deg of tilt (1 sigma)",
                        verdict.claimed.position_std_m_per_100m ? ", " : "; claimed: ", *tilt);
  }
  text += "\n";
  for (const Cause& cause : verdict.causes) {
    text += fmt::format("  {}: {}\n", Name(cause.kind), cause.evidence);
    if (!cause.fix.empty()) text += "    put into the configuration:\n" + Indented(cause.fix);
  }
  std::string told_fix;  // several causes may have the same
  for (const Cause& cause : verdict.mended) {
    text += fmt::format("  mended by the first pass: {}: {}\n", Name(cause.kind), cause.evidence);
    if (cause.fix.empty() || cause.fix == told_fix) continue;
    told_fix = cause.fix;
    text += "    for liod and other drives put into the configuration:\n" + Indented(told_fix);
  }
  return text;
}

}  // namespace lio
