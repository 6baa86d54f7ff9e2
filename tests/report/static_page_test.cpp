// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/static_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/sample_result.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string page(const study::Result& result) {
  return static_page({.result = result,
                      .study_toml = "schema = 1\n",
                      .title = "Title",
                      .source = "Source",
                      .tool = "tool",
                      .command = "linkwright run a.toml",
                      .result_json = {}});
}

TEST(StaticPage, HasEverySectionAndIsWellFormed) {
  auto result = test::sample_result();
  result.headline = test::hostile;
  const std::string text = page(result);
  EXPECT_EQ(test::fault_of_xml(text), "");
  for (const char* section :
       {"<svg", "Checks", "Solutions", "Parameters of the best solution", "Published and ours", "Statistics",
        "Diagrams", "Runs", "Remarks", "motion of solution-1", "How to reproduce", "linkwright run a.toml",
        "schema = 1"})
    EXPECT_THAT(text, HasSubstr(section));
}

TEST(StaticPage, BannerCountsChecks) {
  auto result = test::sample_result();
  EXPECT_THAT(page(result), HasSubstr("class=\"verdict doubtful\"")) << "a bad transmission angle";
  EXPECT_THAT(page(result), HasSubstr("2 of 2 checks passed"));
  result.facts.clear();
  EXPECT_THAT(page(result), HasSubstr("class=\"verdict passed\""));
  result.checks[0].passed = false;
  EXPECT_THAT(page(result), HasSubstr("class=\"verdict failed\""));
  EXPECT_THAT(page(result), HasSubstr("1 of 2 checks passed"));
}

TEST(StaticPage, FactsBeginWithTheirFigure) {
  EXPECT_THAT(
      page(test::sample_result()),
      HasSubstr("<dt>largest distance</dt><dd>40.1\u202fmm<small> at point 7; root mean square of all points "
                "22.4\u202fmm</small></dd>"));
}

TEST(StaticPage, LongTablesAreThinnedAndSaySo) {
  EXPECT_THAT(page(test::sample_result()), HasSubstr("One row in 10, of 361 in all."));
}

TEST(StaticPage, FixedAndUnboundedParameters) {
  auto result = test::sample_result();
  result.solutions[0].parameters = {{"a_m", "a", 1, 1, 1}, {"b_m", "b", 2, -INFINITY, INFINITY}};
  const std::string text = page(result);
  EXPECT_THAT(text, HasSubstr("<td>a_m</td><td>1</td><td>fixed</td><td>fixed</td>"));
  EXPECT_THAT(text, HasSubstr("<td>b_m</td><td>2</td><td>none</td><td>none</td>"));
}

TEST(StaticPage, EmptyResultStillMakesAPage) {
  const std::string text = page(study::Result());
  EXPECT_EQ(test::fault_of_xml(text), "");
  EXPECT_THAT(text, Not(HasSubstr("Solutions")));
}

}  // namespace
}  // namespace linkwright::report
