// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/yaml_documents.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(YamlDocuments, OneIsRead) {
  const YamlDocument document = LoadYamlDocument("a: 1\n");
  EXPECT_EQ(document.first["a"].as<int>(), 1);
  EXPECT_FALSE(document.second_at);
}

TEST(YamlDocuments, NoneIsNull) {
  EXPECT_TRUE(LoadYamlDocument("").first.IsNull());
  EXPECT_FALSE(LoadYamlDocument("# a comment\n").second_at);
}

TEST(YamlDocuments, ASecondOneIsFound) {
  const YamlDocument document = LoadYamlDocument("a: 1\n---\nb: 2\n");
  EXPECT_EQ(document.first["a"].as<int>(), 1);
  ASSERT_TRUE(document.second_at);
  EXPECT_EQ(document.second_at->line, 1);
}

TEST(YamlDocuments, TextThatBeginsWithACommaComesToAnEnd) {
  EXPECT_TRUE(LoadYamlDocument(", a: 1\n").second_at);
}

TEST(YamlDocuments, BadSyntaxThrows) {
  EXPECT_THROW((void)LoadYamlDocument("a: [1"), YAML::Exception);
  EXPECT_THROW((void)LoadYamlDocument("a: 1\n---\nb: [1"), YAML::Exception);
}

}  // namespace
}  // namespace lio
