// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/transition.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "support/build_paths.hpp"

namespace lio {
namespace {

// Returns the lines with an arrow between the marks of docs/design.md, without indentation.
std::multiset<std::string> DrawnTransitions() {
  std::ifstream page(test::SourceDir() + "/docs/design.md");
  std::multiset<std::string> drawn;
  bool is_inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line == "<!-- transitions:begin -->") is_inside = true;
    if (line == "<!-- transitions:end -->") is_inside = false;
    if (!is_inside || line.find("-->") == std::string::npos || line.starts_with("<!--")) continue;
    if (line.find("[*]") != std::string::npos) continue;  // begin or end of the diagram
    drawn.insert(line.substr(line.find_first_not_of(' ')));
  }
  return drawn;
}

std::string LineOf(const TransitionRule& rule) {
  std::ostringstream line;
  line << NameOf(rule.from) << " --> " << NameOf(rule.to) << ": " << NameOf(rule.trigger);
  return line.str();
}

TEST(Transitions, DiagramOfTheDesignDrawsTheTable) {
  std::multiset<std::string> table;
  for (const TransitionRule& rule : kTransitions) table.insert(LineOf(rule));
  EXPECT_EQ(DrawnTransitions(), table);
}

TEST(Transitions, EachRuleIsFoundByModeAndTrigger) {
  for (const TransitionRule& rule : kTransitions) {
    const auto found = FindRule(rule.from, rule.trigger);
    ASSERT_TRUE(found) << LineOf(rule);
    EXPECT_EQ(found->to, rule.to) << LineOf(rule);
  }
}

TEST(Transitions, TriggerLeadsFromAModeToOneOtherOnly) {
  std::set<std::pair<ModeKind, Trigger>> seen;
  for (const TransitionRule& rule : kTransitions) {
    EXPECT_TRUE(seen.emplace(rule.from, rule.trigger).second) << LineOf(rule);
  }
}

TEST(Transitions, NothingFollowsARejection) {
  for (const TransitionRule& rule : kTransitions) {
    EXPECT_NE(rule.from, ModeKind::kRejected) << LineOf(rule);
    EXPECT_FALSE(FindRule(ModeKind::kRejected, rule.trigger)) << LineOf(rule);
  }
}

TEST(Transitions, TriggerThatAModeDoesNotKnowHasNoTarget) {
  EXPECT_FALSE(FindRule(ModeKind::kTracking, Trigger::kStarted));
  EXPECT_FALSE(FindRule(ModeKind::kLidarOnly, Trigger::kConventionDoubted));
}

}  // namespace
}  // namespace lio
