// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/optimiser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "linkwright/core/random.h"
#include "linkwright/optimise/methods.h"
#include "linkwright/optimise/pareto.h"
#include "optimise/functions.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

constexpr Method every_method[] = {Method::differential_evolution,
                                   Method::self_adaptive_differential_evolution,
                                   Method::jade,
                                   Method::grey_wolf,
                                   Method::particle_swarm,
                                   Method::firefly,
                                   Method::cuckoo_search,
                                   Method::hybrid_cuckoo_firefly,
                                   Method::subpopulation_firefly,
                                   Method::cma_es};

TEST(Optimiser, FirstCandidatesAreUniformAndOneOfEachStream) {
  const Problem problem = test::sphere(3);
  for (const Method method : every_method) {
    const auto optimiser =
        make_optimiser(problem.variables, OptimiserOptions{.method = method}, {.seed = 9, .run = 2});
    const PopulationView first = optimiser->ask();
    for (std::size_t i = 0; i < first.size; ++i) {
      RandomStream random({9, 2, 0, static_cast<std::uint32_t>(i)});
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(first(j, i), random.uniform(-5, 3));
    }
  }
}

TEST(Optimiser, CandidatesStayInTheBoxAndFixedVariablesFixed) {
  Problem problem = test::sphere(5);
  problem.variables[1] = {"fixed", 0.7, 0.7};
  problem.variables[2] = {"thin", 1e6, 1e6 + 1e-9};
  problem.variables[3] = {"huge", -1e300, 1e300};
  for (const bool reset : {false, true})
    for (const Method method : every_method) {
      OptimiserOptions options = {.method = method};
      options.grey_wolf.reset_worst_half = reset;
      const auto optimiser = make_optimiser(problem.variables, options, {});
      while (optimiser->generation() < 60) {
        const PopulationView x = optimiser->ask();
        std::vector<double> cost(x.size), violation(x.size);
        problem.evaluate(x, cost, violation);
        // An optimum outside the box pushes against the bounds.
        for (std::size_t i = 0; i < x.size; ++i) {
          cost[i] = x(0, i) + x(4, i);
          for (std::size_t j = 0; j < 5; ++j) {
            ASSERT_GE(x(j, i), problem.variables[j].lower) << name_of(method);
            ASSERT_LE(x(j, i), problem.variables[j].upper) << name_of(method);
          }
        }
        optimiser->tell(cost, violation);
      }
      EXPECT_LT(optimiser->best_cost(), -9.9) << name_of(method);
    }
}

TEST(Optimiser, BeginsWithGivenMembers) {
  const Problem problem = test::sphere(2);  // -5 to 3
  Population given(2, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    given(0, i) = 0.1 * static_cast<double>(i);
    given(1, i) = -0.5 * static_cast<double>(i);
  }
  for (const Method method : every_method) {
    OptimiserOptions options = {.method = method};
    visit_method(options, [](auto& o) { o.population = 20; });
    const auto optimiser = make_optimiser(problem.variables, options, {});
    optimiser->begin_with(given.view());
    const PopulationView first = optimiser->ask();
    ASSERT_EQ(first.size, 20u);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(first(0, i), given(0, i));
      EXPECT_EQ(first(1, i), std::max(given(1, i), -5.0));  // moved to the bound
    }
    EXPECT_THAT(message([&] { optimiser->begin_with(given.view()); }),
                HasSubstr("members are given before the first are asked for"));
    std::vector<double> cost(20), violation(20);
    problem.evaluate(first, cost, violation);
    optimiser->tell(cost, violation);
    EXPECT_EQ(optimiser->best_cost(), 0) << name_of(method);
  }
  const auto wolves = make_optimiser(problem.variables, GreyWolfOptions{}, {});
  EXPECT_THAT(message([&] { wolves->begin_with(given.view()); }),
              HasSubstr("20 members of 2 variables for 30 of 2"));
  const auto twenty = make_optimiser(problem.variables, GreyWolfOptions{.population = 20}, {});
  given(1, 7) = NAN;
  EXPECT_THAT(message([&] { twenty->begin_with(given.view()); }),
              HasSubstr("variable 1 of member 7 is not a number"));
}

TEST(Optimiser, AskTwiceGivesTheSameCandidates) {
  const Problem problem = test::sphere(2);
  const auto optimiser = make_optimiser(problem.variables, GreyWolfOptions{}, {});
  std::vector<double> cost(30), violation(30);
  for (int generation = 0; generation < 3; ++generation) {
    const PopulationView x = optimiser->ask();
    const double before = x(1, 7);
    EXPECT_EQ(optimiser->ask()(1, 7), before);
    problem.evaluate(x, cost, violation);
    optimiser->tell(cost, violation);
  }
}

TEST(Optimiser, TellsWhatIsBestAndWhetherItIsNew) {
  const Problem problem = test::sphere(2);
  const auto optimiser = make_optimiser(problem.variables, DifferentialEvolutionOptions{.population = 4}, {});
  EXPECT_TRUE(optimiser->best().empty());
  double x0 = optimiser->ask()(0, 2);
  optimiser->tell(std::vector<double>{5, 6, 4, 9}, std::vector<double>{0, 0, 0, 0});
  EXPECT_TRUE(optimiser->improved());
  EXPECT_EQ(optimiser->best_candidate(), 2u);
  EXPECT_EQ(optimiser->best()[0], x0);
  optimiser->ask();
  optimiser->tell(std::vector<double>{5, 6, 4, 1}, std::vector<double>{0, 0, 0, 0.1});
  EXPECT_FALSE(optimiser->improved());  // the cheaper one violates a constraint
  EXPECT_TRUE(optimiser->equalled());
  EXPECT_EQ(optimiser->best_cost(), 4);
  optimiser->ask();
  optimiser->tell(std::vector<double>{5, 6, 7, 8}, std::vector<double>{0, 0, 0, 0});
  EXPECT_FALSE(optimiser->improved());
  EXPECT_FALSE(optimiser->equalled());
  EXPECT_EQ(optimiser->best()[0], x0);
  EXPECT_EQ(optimiser->generation(), 3u);
}

TEST(Optimiser, SeedsAndRunsAreDifferentCourses) {
  const Problem problem = test::sphere(2);
  std::set<double> firsts;
  for (const std::uint64_t seed : {1, 2})
    for (const std::uint32_t run : {0u, 1u})
      firsts.insert(make_optimiser(problem.variables, GreyWolfOptions{}, {seed, run})->ask()(0, 0));
  EXPECT_EQ(firsts.size(), 4u);
}

TEST(Optimiser, AGenerationAllocatesNothing) {
  const Problem problem = test::sphere(10);
  for (const bool reset : {false, true})
    for (const Method method : every_method) {
      OptimiserOptions options = {.method = method};
      options.grey_wolf.reset_worst_half = reset;
      if (method == Method::cma_es) continue;  // the method is pagmo's, which does allocate
      const auto optimiser = make_optimiser(problem.variables, options, {});
      const std::vector<double> violation(optimiser->population(), 0.0);
      const auto before = linkwright::test::allocations();
      while (optimiser->generation() < 50) {
        const PopulationView x = optimiser->ask();
        optimiser->tell({x.row(0), x.size}, {violation.data(), x.size});
      }
      EXPECT_EQ(linkwright::test::allocations(), before) << name_of(method);
    }
}

/// Every method, the variant of grey wolf that keeps more, and a hybrid with other options.
std::vector<OptimiserOptions> all_options() {
  std::vector<OptimiserOptions> all;
  for (const Method method : every_method) all.push_back({.method = method});
  all.push_back({.method = Method::grey_wolf});
  all.back().grey_wolf.reset_worst_half = true;
  all.push_back({.method = Method::particle_swarm});
  all.back().particle_swarm.bounds = SwarmBounds::reflect;
  for (const MutationScheme scheme : {MutationScheme::best_1, MutationScheme::target_to_best_1,
                                      MutationScheme::rand_2, MutationScheme::best_2}) {
    all.push_back({.method = Method::differential_evolution});
    all.back().differential_evolution.scheme = scheme;
  }
  for (const MutationScheme scheme : {MutationScheme::rand_1, MutationScheme::best_1}) {
    all.push_back({.method = Method::differential_evolution});
    all.back().differential_evolution.scheme = scheme;
    all.back().differential_evolution.replacement = Replacement::in_place;
    all.back().differential_evolution.bounds = MutantBounds::clip;
  }
  all.push_back({.method = Method::jade});
  all.back().jade.archive = false;
  all.push_back({.method = Method::hybrid_cuckoo_firefly});
  all.back().hybrid_cuckoo_firefly.swept = 0.25;
  all.back().hybrid_cuckoo_firefly.flight.form = LevyForm::best_difference;
  return all;
}

void round(const Problem& problem, Optimiser& optimiser) {
  const PopulationView x = optimiser.ask();
  std::vector<double> cost(x.size * problem.objectives), violation(x.size);
  problem.evaluate(x, cost, violation);
  optimiser.tell(cost, violation);
}

void generation(const Problem& problem, Optimiser& optimiser) {
  for (const auto now = optimiser.generation(); optimiser.generation() == now;) round(problem, optimiser);
}

TEST(Optimiser, ARestoredStateGoesOnWithTheSameBits) {
  // A problem with constraints, so that violations matter, and with infinite costs.
  const Problem g06 = test::g06();
  const Problem rare = test::make_problem(3, -1, 1, [](std::span<const double> x) {
    return x[0] > 0.9 ? test::Value{x[1] * x[2]} : test::Value{HUGE_VAL, 1 - x[0]};
  });
  for (const Problem* problem : {&g06, &rare})
    for (const OptimiserOptions& options : all_options()) {
      const auto whole = make_optimiser(problem->variables, options, {.seed = 5, .run = 3});
      for (int k = 0; k < 7; ++k) generation(*problem, *whole);
      const OptimiserState state = whole->state();
      const auto restored = make_optimiser(problem->variables, options, {.seed = 5, .run = 3});
      ASSERT_TRUE(restored->restore(state)) << name_of(options.method);
      EXPECT_EQ(restored->state(), state);
      EXPECT_EQ(restored->generation(), 7u);
      for (int k = 0; k < 20; ++k) {
        generation(*problem, *whole);
        generation(*problem, *restored);
        EXPECT_EQ(restored->improved(), whole->improved());
        EXPECT_EQ(restored->equalled(), whole->equalled());
        ASSERT_EQ(restored->state(), whole->state()) << name_of(options.method) << " generation " << 8 + k;
      }
      EXPECT_TRUE(std::equal(whole->best().begin(), whole->best().end(), restored->best().begin()));
    }
}

TEST(Optimiser, RefusesStatesThatItCannotHaveReached) {
  const Problem problem = test::g06();
  for (const OptimiserOptions& options : all_options()) {
    const auto optimiser = make_optimiser(problem.variables, options, {});
    generation(problem, *optimiser);
    const OptimiserState good = optimiser->state();
    const auto accepts = [&](const OptimiserState& state) {
      return make_optimiser(problem.variables, options, {})->restore(state);
    };
    EXPECT_TRUE(accepts(good));
    OptimiserState longer = good, shorter = good, unborn = good;
    longer.numbers.push_back(0);
    shorter.numbers.pop_back();
    unborn.generation = 0;
    EXPECT_FALSE(accepts(longer));
    EXPECT_FALSE(accepts(shorter));
    EXPECT_FALSE(accepts({.generation = 1}));
    EXPECT_FALSE(accepts(unborn));
    for (std::size_t k = 0; k < good.numbers.size(); ++k) {
      OptimiserState bad = good;
      bad.numbers[k] = std::nan("");
      EXPECT_FALSE(accepts(bad)) << name_of(options.method) << " " << k;
    }
    // Best cost, best violation, best candidate; x0 lies in [13, 100].
    OptimiserState negative = good, outside = good;
    negative.numbers[1] = -1;
    outside.numbers[2] = 12.9;
    EXPECT_FALSE(accepts(negative));
    EXPECT_FALSE(accepts(outside));
  }
  const auto asked = make_optimiser(problem.variables, GreyWolfOptions{}, {});
  EXPECT_THAT(message([&] { asked->state(); }), HasSubstr("no state within a generation"));
  generation(problem, *asked);
  asked->ask();
  EXPECT_THAT(message([&] { asked->state(); }), HasSubstr("no state within a generation"));
  // Between two rounds of one generation, too.
  const auto firefly = make_optimiser(problem.variables, FireflyOptions{.population = 5}, {});
  generation(problem, *firefly);
  const OptimiserState state = firefly->state();
  round(problem, *firefly);
  EXPECT_EQ(firefly->generation(), 1u);
  EXPECT_THAT(message([&] { firefly->state(); }), HasSubstr("no state within a generation"));
  EXPECT_THAT(message([&] { firefly->restore(state); }),
              HasSubstr("a state cannot be restored within a generation"));
}

TEST(Optimiser, AnEarlierStateCanBeTakenUpAgain) {
  const Problem problem = test::g06();
  for (const OptimiserOptions& options : all_options()) {
    const auto optimiser = make_optimiser(problem.variables, options, {});
    for (int k = 0; k < 3; ++k) generation(problem, *optimiser);
    const OptimiserState early = optimiser->state();
    for (int k = 0; k < 3; ++k) generation(problem, *optimiser);
    const OptimiserState late = optimiser->state();
    ASSERT_TRUE(optimiser->restore(early));
    for (int k = 0; k < 3; ++k) generation(problem, *optimiser);
    EXPECT_EQ(optimiser->state(), late) << name_of(options.method);
  }
}

TEST(Optimiser, SaysWhatIsWrong) {
  const Problem problem = test::sphere(2);
  const auto optimiser = make_optimiser(problem.variables, GreyWolfOptions{.population = 3}, {});
  const std::vector<double> three = {1, 2, 3}, two = {1, 2}, zero = {0, 0, 0};
  EXPECT_THAT(message([&] { optimiser->tell(three, zero); }), HasSubstr("nothing was asked"));
  optimiser->ask();
  EXPECT_THAT(message([&] { optimiser->tell(two, zero); }),
              HasSubstr("2 costs and 3 violations for 3 candidates"));
  EXPECT_THAT(message([&] {
                optimiser->tell(std::vector<double>{1, std::nan(""), 2}, zero);
              }),
              HasSubstr("candidate 1: cost nan, violation 0"));
  EXPECT_THAT(message([&] {
                optimiser->tell(three, std::vector<double>{0, 0, -1});
              }),
              HasSubstr("candidate 2: cost 3, violation -1"));
  EXPECT_THAT(message([&] { make_optimiser({}, GreyWolfOptions{}, {}); }),
              HasSubstr("a problem needs variables"));
  const std::vector<Variable> reversed = {{"crank_m", 2, 1}};
  EXPECT_THAT(message([&] { make_optimiser(reversed, GreyWolfOptions{}, {}); }),
              HasSubstr("bounds of 'crank_m': 2 to 1"));
  const std::vector<Variable> unbounded = {{"crank_m", 0, HUGE_VAL}};
  EXPECT_THAT(message([&] { make_optimiser(unbounded, GreyWolfOptions{}, {}); }),
              HasSubstr("bounds of 'crank_m': 0 to inf"));
}

// Several objectives.

constexpr Method methods_of_several_objectives[] = {
    Method::firefly, Method::cuckoo_search, Method::hybrid_cuckoo_firefly, Method::subpopulation_firefly};

OptimiserOptions four(Method method) {
  OptimiserOptions options = {.method = method};
  options.firefly.population = options.cuckoo_search.population = options.hybrid_cuckoo_firefly.population =
      options.subpopulation_firefly.population = 4;
  return options;
}

TEST(Incumbent, GivesWayToWhatDominatesItOnly) {
  const Problem problem = test::schaffer(2);
  for (const Method method : methods_of_several_objectives) {
    const auto optimiser = make_optimiser(problem.variables, four(method), {}, 2);
    const double known[] = {-9, 7};  // outside the bounds
    const double known_costs[] = {1, 1};
    optimiser->start_from(known, known_costs);
    EXPECT_EQ(optimiser->best()[0], -9);
    const PopulationView x = optimiser->ask();
    const double second = x(0, 1);
    // Worse in the second objective; better in the first, equal in the second; not compared with the
    // reference but with the one before; cheap but infeasible.
    optimiser->tell(std::vector<double>{0.1, 1.5, 0.9, 1, 0.95, 0.5, 0.1, 0.1},
                    std::vector<double>{0, 0, 0, 2});
    EXPECT_TRUE(optimiser->improved()) << name_of(method);
    EXPECT_EQ(optimiser->best_candidate(), 1u);
    EXPECT_EQ(optimiser->best()[0], second);
    EXPECT_EQ(optimiser->best_costs()[0], 0.9);
    EXPECT_EQ(optimiser->best_costs()[1], 1);
    EXPECT_EQ(optimiser->best_violation(), 0);
  }
  const auto optimiser = make_optimiser(problem.variables, four(Method::firefly), {}, 2);
  optimiser->start_from(std::vector<double>{0, 0}, std::vector<double>{1, 1});
  optimiser->ask();
  // Two in a row within one round: the second dominates the first.
  optimiser->tell(std::vector<double>{0.9, 0.9, 1, 1, 0.8, 0.9, 0.8, 0.95}, std::vector<double>(4));
  EXPECT_EQ(optimiser->best_candidate(), 2u);
  EXPECT_TRUE(optimiser->equalled());
}

TEST(Incumbent, IsWithoutAReferenceTheLeastSumOverMedians) {
  const Problem problem = test::schaffer(2);
  const auto first = [&](const std::vector<double>& costs, const std::vector<double>& violations) {
    const auto optimiser = make_optimiser(problem.variables, four(Method::cuckoo_search), {}, 2);
    optimiser->ask();
    optimiser->tell(costs, violations);
    EXPECT_TRUE(optimiser->improved());
    EXPECT_EQ(optimiser->best_costs()[1], costs[2 * optimiser->best_candidate() + 1]);
    return optimiser->best_candidate();
  };
  // Medians of the feasible ones 2 and 300: sums 2.17, 1.83, 3; by plain sums the first would win.
  EXPECT_EQ(first({3, 200, 1, 400, 2, 600, 0.1, 0.1}, {0, 0, 0, 1}), 1u);
  // Medians between two members: 2.5 and 250; sums 2, 2.4, 1.6, 4.
  EXPECT_EQ(first({1, 400, 2, 400, 3, 100, 9, 100}, {0, 0, 0, 0}), 2u);
  // A median of zero counts as 1.
  EXPECT_EQ(first({0, 5, 0, 4, 0, 3, 0, 9}, {0, 0, 0, 0}), 2u);
  // The first of equals counts; with nothing feasible the least violated.
  EXPECT_EQ(first({1, 1, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0}), 0u);
  EXPECT_EQ(first({1, 1, 1, 1, 1, 1, 1, 1}, {4, 3, 2, 3}), 2u);
  // Cheaper than the chosen one, but not for the sum: it may stay, as nothing dominates it.
  const auto optimiser = make_optimiser(problem.variables, four(Method::cuckoo_search), {}, 2);
  optimiser->ask();
  optimiser->tell(std::vector<double>{1, 9, 2, 2, 9, 1, 4, 4}, std::vector<double>(4));
  EXPECT_EQ(optimiser->best_candidate(), 1u);
}

TEST(Incumbent, DominatesAllThatWereBestBefore) {
  // A poor design to begin with leaves them a way to go.
  struct Case {
    Problem problem;
    std::vector<double> x, costs;
  };
  for (const auto& [problem, x0, costs0] :
       {Case{test::schaffer(3), {-5, -5, -5}, {25, 49}}, Case{test::binh_korn(), {5, 0}, {100, 25}}})
    for (const Method method : methods_of_several_objectives) {
      const auto optimiser = make_optimiser(problem.variables, OptimiserOptions{.method = method}, {}, 2);
      optimiser->start_from(x0, costs0);
      std::vector<std::vector<double>> incumbents = {costs0};
      while (optimiser->generation() < 30) {
        round(problem, *optimiser);
        const std::vector<double> costs(optimiser->best_costs().begin(), optimiser->best_costs().end());
        ASSERT_EQ(optimiser->best_violation(), 0);
        EXPECT_EQ(optimiser->improved(), incumbents.back() != costs);
        if (optimiser->improved()) incumbents.push_back(costs);
        // It is one design, with its own costs.
        const std::vector<double> x(optimiser->best().begin(), optimiser->best().end());
        Population one(x.size(), 1);
        one.set(0, x);
        std::vector<double> again(2), violation(1);
        problem.evaluate(one.view(), again, violation);
        ASSERT_EQ(again, costs);
      }
      EXPECT_GE(incumbents.size(), 3u) << name_of(method);
      for (std::size_t a = 0; a < incumbents.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          EXPECT_TRUE(dominates(incumbents[a], incumbents[b])) << name_of(method) << " " << a << " " << b;
    }
}

TEST(Incumbent, AReferenceOutsideTheBoundsIsPartOfTheState) {
  const Problem problem = test::schaffer(2);
  const auto make = [&](Method method, double x) {
    OptimiserOptions options = four(method);
    options.cuckoo_search.flight.form = LevyForm::best_difference;  // flights relative to the best
    auto optimiser = make_optimiser(problem.variables, options, {.seed = 3}, 2);
    optimiser->start_from(std::vector<double>{x, 0}, std::vector<double>{1e-9, 1e-9});  // nobody's equal
    return optimiser;
  };
  for (const Method method : methods_of_several_objectives) {
    const auto whole = make(method, 11), restored = make(method, 11), other = make(method, 10);
    for (int k = 0; k < 4; ++k) generation(problem, *whole);
    EXPECT_EQ(whole->best()[0], 11);
    ASSERT_TRUE(restored->restore(whole->state()));
    EXPECT_FALSE(other->restore(whole->state()));
    for (int k = 0; k < 9; ++k) {
      generation(problem, *whole);
      generation(problem, *restored);
      ASSERT_EQ(restored->state(), whole->state()) << name_of(method);
    }
  }
}

TEST(Incumbent, OneObjectiveCanStartFromAReferenceToo) {
  const Problem problem = test::sphere(2);
  for (OptimiserOptions options : all_options()) {
    const auto optimiser = make_optimiser(problem.variables, options, {});
    optimiser->start_from(std::vector<double>{40, -40}, std::vector<double>{0.5});
    while (optimiser->generation() < 30) {
      const PopulationView x = optimiser->ask();
      for (std::size_t i = 0; i < x.size; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          ASSERT_TRUE(x(j, i) >= -5 && x(j, i) <= 3) << name_of(options.method);
      round(problem, *optimiser);
      ASSERT_LE(optimiser->best_cost(), 0.5);
      EXPECT_EQ(optimiser->best_cost() == 0.5, optimiser->best()[0] == 40);
    }
  }
}

TEST(Incumbent, SaysWhatIsWrong) {
  const Problem problem = test::schaffer(2);
  const auto optimiser = make_optimiser(problem.variables, four(Method::firefly), {}, 2);
  const auto start = [&](const std::vector<double>& x, const std::vector<double>& costs) {
    return message([&] { optimiser->start_from(x, costs); });
  };
  EXPECT_THAT(start({1}, {1, 1}), HasSubstr("a design to start from has 1 values for 2 variables and 2 costs "
                                            "for 2 objectives"));
  EXPECT_THAT(start({1, 2}, {1}), HasSubstr("1 costs for 2 objectives"));
  EXPECT_THAT(start({1, HUGE_VAL}, {1, 1}), HasSubstr("a design to start from: values 1, inf"));
  EXPECT_THAT(start({1, 2}, {1, NAN}), HasSubstr("a design to start from: costs 1, nan"));
  optimiser->ask();
  EXPECT_THAT(start({1, 2}, {1, 1}), HasSubstr("a design to start from comes before the first candidates"));
  EXPECT_THAT(message([&] { optimiser->tell(std::vector<double>(4), std::vector<double>(4)); }),
              HasSubstr("4 costs and 4 violations for 4 candidates of 2 objectives"));
  EXPECT_THAT(message([&] {
                optimiser->tell(std::vector<double>{1, 2, 3, NAN, 5, 6, 7, 8}, std::vector<double>(4));
              }),
              HasSubstr("candidate 1: cost 3, nan, violation 0"));
  EXPECT_THAT(message([&] { make_optimiser(problem.variables, FireflyOptions{}, {}, 0); }),
              HasSubstr("a problem needs objectives"));
}

}  // namespace
}  // namespace linkwright::optimise
