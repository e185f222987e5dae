// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Every input that the fuzzers keep, and each that once broke something, goes through its target in
// any build.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "fuzz/targets.hpp"
#include "support/build_paths.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

class FuzzCorpus : public ::testing::TestWithParam<fuzz::Target> {};

TEST_P(FuzzCorpus, EveryInputIsReadOrRefused) {
  const std::filesystem::path folder = test::SourceDir() + "/test/fuzz/corpus";
  std::vector<std::filesystem::path> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(folder / GetParam().name)) {
    inputs.push_back(entry.path());
  }
  std::sort(inputs.begin(), inputs.end());
  EXPECT_FALSE(inputs.empty());
  for (const std::filesystem::path& input : inputs) {
    SCOPED_TRACE(input.filename());
    const std::string text = test::ReadText(input);
    // The block has exactly the input's size, so that a sanitizer sees the first byte behind it.
    const auto block = std::make_unique<std::uint8_t[]>(text.size());
    if (!text.empty()) std::memcpy(block.get(), text.data(), text.size());
    EXPECT_NO_THROW(GetParam().run(ByteView(block.get(), text.size())));
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzCorpus, ::testing::ValuesIn(fuzz::kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace lio
