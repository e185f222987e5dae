// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/diagnosis_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "lio/io/options_yaml.hpp"
#include "lio/io/printable.hpp"
#include "lio/io/verdict_report.hpp"

namespace lio {
namespace {

using Json = nlohmann::ordered_json;

std::string WithPrefix(const std::string& text, const std::string& prefix) {
  std::istringstream stream(text);
  std::string lines;
  for (std::string line; std::getline(stream, line);) lines += fmt::format("{}{}\n", prefix, line);
  return lines;
}

std::string_view Meaning(Trust trust) {
  switch (trust) {
    case Trust::kYes:
      return "the result may be used";
    case Trust::kDoubtful:
      return "look at the causes before the result is used";
    case Trust::kNo:
      return "the result must not be used";
  }
  return "";
}

std::string TrustText(const Verdict& verdict) {
  return fmt::format("{} ({}); poses for {:.0f} % of the time", Name(verdict.trust),
                     Meaning(verdict.trust), 100.0 * verdict.coverage);
}

std::string CauseText(const Cause& cause, std::size_t number) {
  const std::string sigma =
      cause.sigma > 0.0 ? fmt::format("{:.1f} sigma", cause.sigma) : "counted, not estimated";
  std::string text = fmt::format("{}. {} ({}; leaves trust: {})\n", number, Name(cause.kind), sigma,
                                 Name(cause.leaves));
  text += "   evidence: " + cause.evidence + "\n";
  if (cause.fix.empty()) return text + "   fix: no entry of its own\n";
  return text + "   fix:\n" + WithPrefix(cause.fix, "     ");
}

std::string TreatedText(const Diagnosis& diagnosis) {
  std::vector<std::string_view> kinds;
  for (const Cause& cause : diagnosis.treated) kinds.push_back(Name(cause.kind));
  const std::string outcome = diagnosis.is_checked
                                  ? fmt::format("trust: {}", TrustText(diagnosis.with_fixes))
                                  : "no replay has looked at what it gives";
  return fmt::format("with the fix of {}: {}", fmt::join(kinds, ", "), outcome);
}

}  // namespace

std::string DiagnosisText(const Diagnosis& diagnosis, const std::string& input) {
  std::string text = fmt::format("input: {} ({})\n", input, diagnosis.recording.kind);
  for (const std::string& said : diagnosis.recording.assumptions) {
    text += "assumed: " + said + "\n";
  }
  if (!diagnosis.refusal.empty()) text += "refused: " + diagnosis.refusal + "\n";
  text += "trust: " + TrustText(diagnosis.verdict) + "\n";
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  if (causes.empty()) {
    const bool is_well = diagnosis.verdict.trust == Trust::kYes;
    text += is_well ? "nothing was found to be wrong\n" : "no cause of this was found\n";
  }
  for (std::size_t i = 0; i < causes.size(); ++i)
    text += fmt::format("\n{}", CauseText(causes[i], i + 1));
  if (diagnosis.treated.empty()) return text;
  text += fmt::format("\n{}\n", TreatedText(diagnosis));
  for (const Cause& cause : diagnosis.with_fixes.causes) {
    if (diagnosis.is_checked) text += fmt::format("  {}: {}\n", Name(cause.kind), cause.evidence);
  }
  return text;
}

std::string DiagnosisJson(const Diagnosis& diagnosis, const std::string& input) {
  Json json;
  json["input"] = Printable(input);
  json["kind"] = diagnosis.recording.kind;
  json["assumptions"] = diagnosis.recording.assumptions;
  json["refusal"] = diagnosis.refusal;
  json.update(Json::parse(VerdictJson(diagnosis.verdict)));
  json["treated"] = Json::array();
  for (const Cause& cause : diagnosis.treated) json["treated"].push_back(Name(cause.kind));
  const bool has_look = diagnosis.is_checked && !diagnosis.treated.empty();
  json["with_fixes"] = has_look ? Json::parse(VerdictJson(diagnosis.with_fixes)) : Json();
  return json.dump(2) + "\n";
}

std::string DiagnosedRigYaml(const Diagnosis& diagnosis, const std::string& input) {
  std::string about = fmt::format("The rig of {}, by lio-log doctor. Give it as --config or --rig.",
                                  Printable(input));
  for (const std::string& said : diagnosis.recording.assumptions) about += "\nAssumed: " + said;
  for (const Cause& cause : diagnosis.treated) {
    about += fmt::format("\nChanged for {}: {}", Name(cause.kind), cause.evidence);
  }
  about += diagnosis.treated.empty()
               ? fmt::format("\nNothing was changed; trust: {}", TrustText(diagnosis.verdict))
               : fmt::format("\nReplayed {}", TreatedText(diagnosis));
  // The rig is the first group, up to an empty line.
  const std::string options = PrintOptions(diagnosis.options);
  const std::size_t begin = options.find("rig:");
  std::string text =
      WithPrefix(about, "# ") + options.substr(begin, options.find("\n\n", begin) - begin) + "\n";
  if (!diagnosis.options.pipeline.use_imu) text += "pipeline:\n  use_imu: false\n";
  return text;
}

}  // namespace lio
