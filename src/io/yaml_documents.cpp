// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/yaml_documents.hpp"

#include <yaml-cpp/eventhandler.h>

#include <sstream>

namespace lio {
namespace {

// Keeps the place where a document begins, and nothing else.
class StartOfDocument final : public YAML::EventHandler {
 public:
  [[nodiscard]] const YAML::Mark& mark() const { return mark_; }

  void OnDocumentStart(const YAML::Mark& mark) override { mark_ = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

 private:
  YAML::Mark mark_;
};

}  // namespace

YamlDocument LoadYamlDocument(const std::string& text) {
  YamlDocument document{YAML::Load(text), std::nullopt};
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  StartOfDocument start;
  if (parser.HandleNextDocument(start) && parser.HandleNextDocument(start)) {
    document.second_at = start.mark();
  }
  return document;
}

}  // namespace lio
