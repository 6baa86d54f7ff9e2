// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/dexterity.h"

#include <gmock/gmock.h>

#include "linkwright/core/memory.h"
#include "parallel/studies.h"
#include "support/resumed.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::example;
using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string head =
    "schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = \"parallel.delta\"\nradius_difference_mm = { min "
    "= 0, max = 600 }\n"
    "arm_mm = { min = 100, max = 1000 }\nrod_mm = { min = 200, max = 1600 }\noffset_mm = { min = 50, max = "
    "1500 }\n"
    "[target]\ntype = \"region\"\nshape = \"cylinder\"\nwidth_mm = 800\nheight_mm = 250\n";
const std::string smallest = head +
                             "goal = \"size\"\n[target.limits]\nconditioning = 0.4\ninput = "
                             "0.5\narm_travel_deg = 120\nside_swing_deg = 40\n";

TEST(DexterityStudy, FindsTheSmallestDelta) {
  const auto result = run_text(smallest);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_LE(result.solutions.at(0).objectives.find("size_m")->as_number(), 1.0755939);
  EXPECT_THAT(fact(result, "held back by"), HasSubstr("constraint"));
  EXPECT_EQ(fact(result, "minimum constraint index"), "0.200000");
  EXPECT_EQ(fact(result, "whole region free of singularities"), "proven, also between the nodes");
  // All of the rim is reached.
  ASSERT_EQ(result.scenes.size(), 1u);
  for (const std::string& status : result.scenes[0].status) EXPECT_EQ(status, "done");
}

TEST(DexterityStudy, PopulationMethodsWorkOnTheSameTask) {
  const auto result = run_text(
      smallest + "[optimiser]\nmethod = \"differential_evolution\"\npopulation = 30\ngenerations = 60\n");
  EXPECT_EQ(result.status, Status::done);
  const double size = result.solutions.at(0).objectives.find("size_m")->as_number();
  EXPECT_GT(size, 1.0755);
  EXPECT_LT(size, 1.3);
  EXPECT_EQ(result.statistics.find("method")->as_string(), "differential_evolution");
}

// Each goal, looked at between the nodes or not, and a population method.
TEST(DexterityStudy, GoesOnFromACheckpointWithTheSameBits) {
  const std::string few = "[optimiser]\nstarts = 2\nseeds = { first = 1, count = 2 }\n";
  for (const char* goal : {"size", "worst", "mean"})
    for (const char* between : {"", "between_nodes = true\n"})
      ::linkwright::test::expect_resumed_alike(
          test::kinds(), replaced(smallest, "\"size\"", std::string("\"") + goal + "\"") + few + between, 2);
  ::linkwright::test::expect_resumed_alike(
      test::kinds(),
      smallest +
          "[optimiser]\nmethod = \"differential_evolution\"\npopulation = 30\ngenerations = 10\n"
          "seeds = { first = 1, count = 2 }\n",
      2);
}

// Without limits the smallest robot is singular: a limit is put in, and reported.
TEST(DexterityStudy, PutsALimitInWhereTheSmallestWouldBeSingular) {
  const auto result = run_text(head + "goal = \"size\"\n");
  EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_THAT(fact(result, "limit put in"), HasSubstr("transmission index at least 0.3"));
  const Table& limits = test::table(result, "limits");
  const auto& bound = column(result, "limits", "bound");
  int input = 0;
  for (std::size_t k = 0; k < limits.names.size(); ++k)
    if (limits.names[k].starts_with("input transmission") ||
        limits.names[k].starts_with("output transmission")) {
      EXPECT_EQ(bound[k], 0.3);
      ++input;
    }
  EXPECT_EQ(input, 2);
  EXPECT_EQ(fact(run_text(smallest), "limit put in"), "no fact");
}

TEST(DexterityStudy, TheConstraintIsAChoice) {
  const auto free = run_text(smallest + "constraint = 0\n");
  EXPECT_NEAR(free.solutions.at(0).objectives.find("size_m")->as_number(), 1.0362, 2e-4);
  EXPECT_THAT(problems_of(test::replaced(example("synthesis/parallel.five_bar/region"), "size_mm = 900",
                                         "size_mm = 900\nconstraint = 0.2")),
              HasSubstr("only the legs of a DELTA are parallelograms"));
}

TEST(DexterityStudy, SaysWhatCannotBe) {
  const auto result = run_text(replaced(smallest, "conditioning = 0.4", "conditioning = 0.99"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_THAT(to_string(result.headline), HasSubstr("No design meets every limit"));
}

TEST(DexterityStudy, RefusesMorePointsThanThereIsMemoryFor) {
  const MemoryLimit limit(2e9);
  for (const char* key : {"nodes", "cells"})
    EXPECT_THAT(problems_of(replaced(smallest, "height_mm = 250\n",
                                     std::string("height_mm = 250\n") + key + " = [1000, 1000, 1000]\n")),
                AllOf(HasSubstr(std::string("target.") + key + ": 1000000000 " + key + " would take 2"),
                      HasSubstr(" GB of memory, at most 2 GB may be taken; take fewer " + std::string(key) +
                                ", or allow more with the environment variable LINKWRIGHT_MEMORY_MB")));
}

TEST(DexterityStudy, TellsWhatIsWrong) {
  EXPECT_THAT(problems_of(replaced(smallest, "arm_mm = { min = 100, max = 1000 }\n", "")),
              HasSubstr("mechanism.arm_m: this key is missing"));
  EXPECT_THAT(problems_of(replaced(smallest, "height_mm = 250\n", "height_mm = 0\n")),
              HasSubstr("target.type: region: height = 0 m"));
  EXPECT_THAT(problems_of(replaced(smallest, "height_mm = 250\n", "height_mm = 250\nnodes = [5]\n")),
              HasSubstr("1 numbers for 3 coordinates"));
  EXPECT_THAT(problems_of(replaced(smallest, "width_mm = 800", "width_mm = 800\nlenght_mm = 3")),
              HasSubstr("target.lenght_mm: unknown key; did you mean 'length_mm'?"));
}

}  // namespace
}  // namespace linkwright::parallel
