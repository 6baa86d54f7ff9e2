// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::study {
namespace {
using ::testing::HasSubstr;

Result sample() {
  Result result;
  Solution best;
  best.objectives["path_error_sum_sq_m2"] = 0.009;
  best.parameters = {{"crank_m", "crank length", 0.42, 0, 50}};
  best.classification["transmission_angle_min_rad"] = pi / 4;
  best.classification["type"] = "crank-rocker";
  result.solutions.push_back(best);
  result.statistics["success_rate"] = 1.0;
  Table sweep{.name = "sweep", .columns = {}, .status = {"done", "done", "done", "no_assembly"}};
  sweep.add("travel_m", "travel (m)", {-0.1, 0.05, 0.05, 0.1});
  sweep.add("rack_m", "rack (m)", {0, 0, 0.03, 0});
  sweep.add("toe_rad", "toe (rad)", {-0.01, 0.02, 0.03, std::nan("")});
  result.tables.push_back(sweep);
  Table counts{.name = "counts", .columns = {}, .status = {"done"}};
  counts.add("classes", "classes", {1442});
  result.tables.push_back(counts);
  return result;
}

Check check(std::string quantity, std::vector<std::pair<std::string, double>> at = {}) {
  CheckRequest request;
  request.quantity = std::move(quantity);
  request.at_most = 1e9;
  request.at = std::move(at);
  return evaluate(request, sample());
}

TEST(Checks, QuantitiesOfTheBestSolutionAndTheStatistics) {
  EXPECT_EQ(check("best.path_error_sum_sq_m2").value, 0.009);
  EXPECT_EQ(check("best.crank_m").value, 0.42);
  EXPECT_DOUBLE_EQ(check("best.crank_mm").value, 420);
  EXPECT_DOUBLE_EQ(check("best.transmission_angle_min_deg").value, 45);
  EXPECT_EQ(check("statistics.success_rate").value, 1.0);
}

TEST(Checks, StatisticsOfColumnsSkipMissingValues) {
  EXPECT_EQ(check("sweep.toe_rad.max").value, 0.03);
  EXPECT_EQ(check("sweep.toe_rad.min").value, -0.01);
  EXPECT_EQ(check("sweep.toe_rad.max_abs").value, 0.03);
  EXPECT_EQ(check("sweep.toe_rad.first").value, -0.01);
  EXPECT_EQ(check("sweep.toe_rad.last").value, 0.03);
  EXPECT_NEAR(check("sweep.toe_rad.mean").value, 0.04 / 3, 1e-17);
  EXPECT_NEAR(check("sweep.toe_rad.rms").value, std::sqrt(0.0014 / 3), 1e-17);
  EXPECT_DOUBLE_EQ(check("sweep.toe_deg.max").value, 0.03 * 180 / pi);
}

TEST(Checks, ATableWithOneRowNeedsNoStatistic) {
  EXPECT_EQ(check("counts.classes").value, 1442);
  EXPECT_EQ(check("counts.classes.max").value, 1442);
}

TEST(Checks, RowsAreChosenByColumnsInAnyUnit) {
  const Check c = check("sweep.toe_deg", {{"travel_mm", 50.0}, {"rack_mm", 0.0}});
  EXPECT_DOUBLE_EQ(c.value, 0.02 * 180 / pi);
  EXPECT_EQ(c.at, "travel_mm = 50, rack_mm = 0");
  EXPECT_DOUBLE_EQ(check("sweep.toe_rad", {{"travel_m", 0.05}, {"rack_mm", 30.0}}).value, 0.03);
  EXPECT_THAT(check("sweep.toe_deg", {{"travel_mm", 40.0}, {"rack_mm", 0.0}}).message,
              HasSubstr("has no such row; the nearest is travel_m = 0.05, rack_m = 0"));
  EXPECT_THAT(check("sweep.toe_deg", {{"travel_mm", 100.0}, {"rack_mm", 0.0}}).message,
              HasSubstr("has no value there: no_assembly"));
  EXPECT_THAT(check("sweep.toe_deg", {{"travl_mm", 100.0}}).message,
              HasSubstr("there is no column of 'sweep' 'travl_mm'; did you mean 'travel_m'?"));
}

TEST(Checks, WhatCannotBeFoundFailsAndSaysWhy) {
  const auto message = [](std::string quantity, std::vector<std::pair<std::string, double>> at = {}) {
    const Check c = check(std::move(quantity), std::move(at));
    EXPECT_FALSE(c.passed);
    EXPECT_TRUE(std::isnan(c.value));
    return c.message;
  };
  EXPECT_THAT(message("best.path_error_sum_m2"),
              HasSubstr("there is no number of the best solution 'path_error_sum_m2'; did you mean "
                        "'path_error_sum_sq_m2'?"));
  EXPECT_THAT(message("best.type"), HasSubstr("'type' is not a number"));
  EXPECT_THAT(message("swep.toe_rad.max"), HasSubstr("there is no table 'swep'; did you mean 'sweep'?"));
  EXPECT_THAT(message("sweep.toe_mm.max"), HasSubstr("there is no column of 'sweep' 'toe_mm'"));
  EXPECT_THAT(message("sweep.toe_rad.maximum"), HasSubstr("there is no statistic 'maximum'"));
  EXPECT_THAT(message("sweep.toe_rad"), HasSubstr("add a statistic"));
  EXPECT_THAT(message("sweep.toe_rad.max", {{"travel_m", 0.05}}), HasSubstr("a row (`at`) has no statistic"));
  EXPECT_THAT(message("best.crank_m", {{"travel_m", 0.05}}), HasSubstr("only rows of tables"));
  EXPECT_THAT(message("statistics"), HasSubstr("there is no number in the statistics"));
  EXPECT_EQ(
      evaluate({.quantity = "best.x", .at_most = 1, .at_least = {}, .equals = {}, .tolerance = {}, .at = {}},
               Result())
          .message,
      "the study found no solution");
}

TEST(Checks, LimitsAreInclusive) {
  const auto passed = [](CheckRequest request) {
    request.quantity = "best.crank_m";
    return evaluate(request, sample()).passed;
  };
  CheckRequest most, least, equal;
  most.at_most = least.at_least = 0.42;
  EXPECT_TRUE(passed(most));
  EXPECT_TRUE(passed(least));
  most.at_most = 0.4199;
  least.at_least = 0.4201;
  EXPECT_FALSE(passed(most));
  EXPECT_FALSE(passed(least));
  equal.equals = 0.41;
  equal.tolerance = 0.011;
  EXPECT_TRUE(passed(equal));
  equal.tolerance = 0.009;
  EXPECT_FALSE(passed(equal));
  equal.quantity = "best.crank_m";
  EXPECT_EQ(evaluate(equal, sample()).limit, "equals 0.41 within 0.009");
}

TEST(Checks, ReadingRefusesLimitsThatDoNotFit) {
  const auto messages = [](std::string_view text) {
    Diagnostics diagnostics;
    const Value document = read_text(text, Syntax::toml, "s.toml", diagnostics);
    DocumentReader reader(document, "s.toml", diagnostics);
    ObjectReader root = reader.root();
    read_checks(root);
    reader.finish();
    return test::lines_of(diagnostics);
  };
  EXPECT_EQ(messages("[[check]]\nquantity = 'a.b'\nat_most = 1\nat = { travel_mm = 50.0 }\n"), "");
  EXPECT_THAT(messages("[[check]]\nquantity = 'a.b'\n"),
              HasSubstr("s.toml:2:12: error: check[0].quantity: this check has no limit; add at_most, "
                        "at_least, or equals"));
  EXPECT_THAT(messages("[[check]]\nquantity = 'a'\nequals = 1\n"),
              HasSubstr("check[0].equals: needs a tolerance"));
  EXPECT_THAT(messages("[[check]]\nquantity = 'a'\nequals = 1\ntolerance = 0.1\nat_most = 2\n"),
              HasSubstr("check[0].equals: cannot be combined with at_most or at_least"));
  EXPECT_THAT(messages("[[check]]\nquantity = 'a'\nat_most = 1\ntolerance = 1\n"),
              HasSubstr("check[0].tolerance: needs equals"));
  EXPECT_THAT(messages("[[check]]\nquantity = 'a'\nat_most = 1\nat_least = 2\n"),
              HasSubstr("at_least: is 2, larger than at_most, which is 1"));
  EXPECT_THAT(messages("[[check]]\nquantity = 'a'\nat_most = 1\nat = { x = 'y' }\n"),
              HasSubstr("check[0].at.x: must be a finite number"));
  EXPECT_THAT(messages("[[check]]\nquantiy = 'a'\nat_most = 1\n"),
              HasSubstr("check[0].quantiy: unknown key; did you mean 'quantity'?"));
}

}  // namespace
}  // namespace linkwright::study
