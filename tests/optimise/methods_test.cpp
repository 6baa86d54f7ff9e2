// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/methods.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "optimise/functions.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

std::vector<std::string> keys(const OptimiserOptions& options) { return test::keys(options); }

TEST(Methods, NamesAreFullAndJdeIsAnAlias) {
  EXPECT_EQ(name_of(Method::differential_evolution), "differential_evolution");
  EXPECT_EQ(name_of(Method::self_adaptive_differential_evolution), "self_adaptive_differential_evolution");
  EXPECT_EQ(name_of(Method::grey_wolf), "grey_wolf");
  EXPECT_EQ(name_of(Method::particle_swarm), "particle_swarm");
  EXPECT_EQ(name_of(Method::jade), "jade");
  EXPECT_EQ(names(Method{}).back().name, "jde");
  EXPECT_EQ(names(Method{}).back().value, Method::self_adaptive_differential_evolution);
}

TEST(Methods, FieldsAreThoseOfTheChosenMethod) {
  EXPECT_EQ(keys({.method = Method::differential_evolution}),
            (std::vector<std::string>{"method", "population", "generations", "scale", "crossover", "scheme",
                                      "replacement", "bounds"}));
  EXPECT_EQ(keys({.method = Method::grey_wolf}),
            (std::vector<std::string>{"method", "population", "generations", "reset_worst_half",
                                      "absolute_value"}));
  EXPECT_EQ(keys({.method = Method::self_adaptive_differential_evolution}).size(), 9u);
  EXPECT_EQ(keys({.method = Method::firefly}),
            (std::vector<std::string>{"method", "population", "generations", "randomness", "absorption",
                                      "attraction", "attraction_least"}));
  EXPECT_EQ(keys({.method = Method::cuckoo_search}),
            (std::vector<std::string>{"method", "population", "generations", "discovery", "levy_exponent",
                                      "levy_step", "levy"}));
  EXPECT_EQ(keys({.method = Method::hybrid_cuckoo_firefly}).size(), 11u);
  EXPECT_EQ(keys({.method = Method::subpopulation_firefly}).size(), 11u);
  EXPECT_EQ(keys({.method = Method::cma_es}),
            (std::vector<std::string>{"method", "population", "generations", "initial_step"}));
}

TEST(Methods, TheMethodReadFirstDecidesAboutTheKeysAfterIt) {
  OptimiserOptions options;
  std::vector<std::string> found;
  fields(
      [&](const Field& field, auto& value) {
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(value)>, Method>)
          value = Method::grey_wolf;
        found.emplace_back(field.key);
      },
      options);
  EXPECT_EQ(found.back(), "absolute_value");
}

TEST(Methods, MakeTheChosenOptimiserWithItsDefaults) {
  const Problem problem = test::sphere(4);
  EXPECT_EQ(make_optimiser(problem.variables, OptimiserOptions{}, {})->population(), 20u);
  EXPECT_EQ(
      make_optimiser(problem.variables, OptimiserOptions{.method = Method::grey_wolf}, {})->population(),
      30u);
  EXPECT_EQ(make_optimiser(problem.variables,
                           OptimiserOptions{.method = Method::self_adaptive_differential_evolution}, {})
                ->population(),
            100u);
  EXPECT_EQ(
      make_optimiser(problem.variables, OptimiserOptions{.method = Method::particle_swarm}, {})->population(),
      40u);
  EXPECT_EQ(make_optimiser(problem.variables, OptimiserOptions{.method = Method::jade}, {})->population(),
            100u);
  EXPECT_EQ(generations({.method = Method::jade}), 1500);
  EXPECT_EQ(generations({.method = Method::grey_wolf}), 50);
  EXPECT_EQ(generations({.method = Method::particle_swarm}), 500);
  EXPECT_EQ(generations({}), 10000);
  // Table 2.5 of Boskovic 2018, and the first population.
  for (const auto& [method, population] : {std::pair{Method::firefly, 40u},
                                           {Method::cuckoo_search, 25u},
                                           {Method::hybrid_cuckoo_firefly, 25u},
                                           {Method::subpopulation_firefly, 40u}}) {
    EXPECT_EQ(make_optimiser(problem.variables, OptimiserOptions{.method = method}, {})->population(),
              population);
    EXPECT_EQ(generations({.method = method}), 501);
  }
}

TEST(Methods, TellWhichTakeSeveralObjectives) {
  const Problem problem = test::schaffer(2);
  for (const EnumName<Method>& entry : names(Method{})) {
    const OptimiserOptions options = {.method = entry.value};
    if (takes_several_objectives(entry.value))
      EXPECT_EQ(make_optimiser(problem.variables, options, {}, 2)->objectives(), 2u);
    else
      EXPECT_THAT(message([&] { make_optimiser(problem.variables, options, {}, 2); }),
                  HasSubstr(fmt::format("{}: minimises one objective; with several use firefly, "
                                        "cuckoo_search, hybrid_cuckoo_firefly or subpopulation_firefly, or "
                                        "combine them, see combine.h",
                                        name_of(entry.value))));
    EXPECT_EQ(make_optimiser(problem.variables, options, {})->objectives(), 1u);
  }
  EXPECT_TRUE(takes_several_objectives(Method::hybrid_cuckoo_firefly));
  EXPECT_FALSE(takes_several_objectives(Method::jade));
}

}  // namespace
}  // namespace linkwright::optimise
