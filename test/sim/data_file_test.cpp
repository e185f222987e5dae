// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/data_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "support/temp_dir.hpp"

namespace lio::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Makes a configuration folder for the test.
class DataFile : public ::testing::Test {
 protected:
  DataFile() {
    dir_.Write("imus/cheap.yaml", "x: 1");
    dir_.Write("imus/good.yaml", "x: 2");
    dir_.Write("imus/notes.txt", "not a model");
    if (const char* given = std::getenv("LIO_CONFIG_DIR")) before_ = given;
    ::setenv("LIO_CONFIG_DIR", dir_.path().c_str(), 1);
  }
  ~DataFile() override {
    before_ ? ::setenv("LIO_CONFIG_DIR", before_->c_str(), 1) : ::unsetenv("LIO_CONFIG_DIR");
  }
  test::TempDir dir_;
  std::optional<std::string> before_;
};

TEST_F(DataFile, ModelsAreListedInOrder) {
  EXPECT_THAT(ListDataFiles("imus"), ElementsAre("cheap", "good"));
  EXPECT_THAT(ListDataFiles("no_such_folder"), IsEmpty());
}

TEST_F(DataFile, IsFoundByTheModelsName) {
  EXPECT_EQ(test::ReadText(FindDataFile("imus", "good")), "x: 2");
}

TEST_F(DataFile, MayBeAFileOfTheUsers) {
  const auto own = dir_.Write("own.yaml", "x: 3");
  EXPECT_EQ(FindDataFile("imus", own.string()), own);
}

TEST_F(DataFile, WhatIsNotThereIsToldWithWhatIs) {
  for (const std::string name : {"best", "notes", "notes.txt", "missing.yaml", ""}) {
    try {
      (void)FindDataFile("imus", name);
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "no model '" + name + "' in imus; there are: cheap good");
    }
  }
}

}  // namespace
}  // namespace lio::sim
