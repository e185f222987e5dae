// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <regex>

#include "lio/report/run_report.hpp"
#include "report/run_folder.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ReportPageTest = test::RunFolder;

std::string DataOf(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return page.substr(at, page.find("</script>", at) - at);
}

TEST_F(ReportPageTest, IsOneFileThatAsksForNoOther) {
  WriteReport(out_, {"drive.bag", WriteTruth(), {}});
  const std::string page = test::ReadText(out_ / "report.html");
  EXPECT_THAT(page, HasSubstr("uPlot"));
  EXPECT_THAT(page, HasSubstr("Leon Sorokin")) << "the library's licence asks for this";
  for (const char* mark : {"@DATA@", "@PLOT_JS@", "@PAGE_JS@", "@PLOT_CSS@", "@PAGE_CSS@"}) {
    EXPECT_THAT(page, Not(HasSubstr(mark)));
  }
  const std::regex fetches("(src|href)\\s*=|url\\(|@import|fetch\\(|XMLHttpRequest|import\\(");
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("var uPlot")), fetches));
}

TEST_F(ReportPageTest, SeveralRunsAreComparedOnOnePage) {
  const auto page = folder_.path() / "compared.html";
  WriteComparison(page, {{out_, {"first", WriteTruth(), {}}}, {out_, {"second", {}, {}}}});
  const auto data = nlohmann::ordered_json::parse(DataOf(test::ReadText(page)));
  ASSERT_EQ(data["runs"].size(), 2U);
  EXPECT_EQ(data["runs"][0]["input"], "first");
  EXPECT_EQ(data["runs"][1]["begin"], data["runs"][0]["begin"]);
  EXPECT_FALSE(data["runs"][1].contains("truth"));
}

TEST_F(ReportPageTest, TheTruthSaysHowItWasLaidIntoTheFrameOfTheRun) {
  const auto data = ReportData(out_, {"drive.bag", WriteTruth(), {}});
  const auto& joined = data["truth"]["joined"];
  EXPECT_NEAR(joined["yaw_rad"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(joined["shift_m"][0].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(joined["shift_m"][1].get<double>(), -0.1, 1e-6) << "the truth is 0.1 m to the left";
}

TEST(ReportPage, TextsOfTheRunCannotEndTheScript) {
  const nlohmann::ordered_json data = {{"input", "</script><script>alert(1)</script><!-- @DATA@"}};
  const std::string page = ReportPage(data);
  const std::string text = DataOf(page);
  EXPECT_THAT(text, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::ordered_json::parse(text), data);
}

TEST(ReportPage, NamesThatAreNoUtf8AreWrittenAllTheSame) {
  const std::string page = ReportPage({{"input", "drive\xff.bag"}});
  EXPECT_THAT(DataOf(page), HasSubstr("drive"));
}

}  // namespace
}  // namespace lio
