// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/stamped_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class StampedCsv : public ::testing::Test {
 protected:
  StampedTable Read(const std::string& text, const std::vector<std::string>& wanted = {}) {
    return ReadStampedCsv(dir_.Write("table.csv", text), wanted);
  }
  void ExpectFault(const std::string& text, const std::string& part) {
    EXPECT_THAT([&] { Read(text, {"b"}); }, ThrowsMessage<std::runtime_error>(HasSubstr(part)));
  }

  test::TempDir dir_;
};

TEST_F(StampedCsv, WantedColumnsComeInTheirOrder) {
  const StampedTable table = Read("t_s,a,name,b\n1.000000001,1,x,2\r\n2,3,y,4e-1\n", {"b", "a"});
  ASSERT_EQ(table.stamps.size(), 2u);
  EXPECT_EQ(table.stamps[0].ns, 1'000'000'001);
  EXPECT_THAT(table.rows[0], ElementsAre(2, 1));
  EXPECT_THAT(table.rows[1], ElementsAre(0.4, 3));
}

TEST_F(StampedCsv, AllColumnsWithoutNames) {
  EXPECT_THAT(Read("t_s,a,b\n1,2,3\n").columns, ElementsAre("a", "b"));
}

TEST_F(StampedCsv, FaultsNameTheLine) {
  ExpectFault("", "table.csv:1: has no header");
  ExpectFault("time,b\n", "table.csv:1: the first column must be t_s");
  ExpectFault("t_s,a\n", "table.csv:1: has no column b");
  ExpectFault("t_s,b\n1,2\n1,2,3\n", "table.csv:3: has 3 cells, the header 2");
  ExpectFault("t_s,b\n1,nan\n", "table.csv:2: b ('nan') is no finite number");
  ExpectFault("t_s,b\nx,1\n", "table.csv:2: t_s ('x') is no stamp");
  EXPECT_THROW((void)ReadStampedCsv(dir_.path() / "missing.csv"), std::runtime_error);
}

TEST_F(StampedCsv, ALastRowThatIsCutIsLeftOut) {
  for (const char* cut : {"2", "2,", "2,4", "2,4e", "2,4,"}) {
    const StampedTable table = Read(std::string("t_s,a,b\n1,2,3\n") + cut);
    EXPECT_EQ(table.stamps.size(), 1u) << cut;
    EXPECT_EQ(table.rows.size(), 1u) << cut;
  }
  EXPECT_EQ(Read("t_s,a,b\n1,2,3\n2,3,4").rows.size(), 2u) << "whole, but without a line feed";
}

}  // namespace
}  // namespace lio
