// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/stephenson_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <span>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/function_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;
using linkwright::test::number_at;

StephensonGenerator some_stephenson() {
  return {std::polar(0.5, 0.4), 1.2, 0.9, {0.5, 0.4}, {0.3, 1.2}, 0.8, std::polar(0.7, 0.2), 1, 1};
}

// The stored six-bars were found, and their errors computed, by another program.
TEST(StephensonGenerators, OfThePublishedNumbersHaveTheirErrors) {
  int compared = 0;
  for (const Value& stored : at(synthesis_case("FG-minimax-best-known"), "computed.designs").as_array()) {
    if (at(stored, "type").as_string() != "steph3") continue;
    const std::vector<double> x = linkwright::test::numbers(at(stored, "parameters"));
    const StephensonGenerator g{{x[0], x[1]},
                                std::abs(x[2]),
                                std::abs(x[3]),
                                {x[4], x[5]},
                                {x[6], x[7]},
                                std::abs(x[8]),
                                {x[9], x[10]},
                                at(stored, "branch").as_array()[0].as_number(),
                                at(stored, "branch").as_array()[1].as_number()};
    const StephensonDesign d = assess(stored_function(at(stored, "function").as_string()), g, 4001);
    ASSERT_TRUE(d.assembles);
    // Numbers of eight decimals move the output by some 1e-8 rad, and these errors are 1e-6 and more.
    const double error = number_at(stored, "max_error_recomputed_deg");
    EXPECT_NEAR(d.greatest_error * 180 / pi, error, 1e-6 * error + 1e-9)
        << at(stored, "function").as_string();
    EXPECT_NEAR(d.pair_angle * 180 / pi, number_at(stored, "min_pair_angle_recomputed_deg"), 1e-3);
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

TEST(StephensonGenerators, SlopesAreThoseOfDifferences) {
  for (const double branch : {1.0, -1.0})
    for (const double side : {1.0, -1.0}) {
      StephensonGenerator g = some_stephenson();
      g.branch = branch, g.side = side;
      const auto found = slopes_at(g, 0.5);
      if (!found) continue;
      EXPECT_EQ(found->output, output_at(g, 0.5)->output);
      const auto& slopes = found->slopes;
      for (std::size_t j = 0; j < stephenson_numbers; ++j) {
        constexpr double h = 1e-6;
        const auto moved = [&](double by) {
          StephensonGenerator o = g;
          const std::complex<double> step =
              j == 0 || j == 4 || j == 6 || j == 9 ? std::complex<double>(by) : std::complex<double>(0, by);
          if (j < 2) o.a += step;
          if (j == 2) o.coupler += by;
          if (j == 3) o.rocker += by;
          if (j == 4 || j == 5) o.point += step;
          if (j == 6 || j == 7) o.pivot += step;
          if (j == 8) o.link += by;
          if (j > 8) o.b += step;
          return output_at(o, 0.5)->output;
        };
        EXPECT_NEAR(slopes[j], (moved(h) - moved(-h)) / (2 * h), 1e-7 * (1 + std::abs(slopes[j]))) << j;
      }
    }
  StephensonGenerator apart = some_stephenson();
  apart.link = 9;
  EXPECT_FALSE(output_at(apart, 0.5));
  EXPECT_FALSE(slopes_at(apart, 0.5));
}

// The solver of any linkage is the other route.
TEST(StephensonGenerators, MoveAsTheLinkageDoes) {
  int seen = 0;
  for (const double branch : {1.0, -1.0})
    for (const double side : {1.0, -1.0}) {
      StephensonGenerator g = some_stephenson();
      g.branch = branch, g.side = side;
      const PlanResult planned = plan_linkage(linkage_of(g, 0.3));
      ASSERT_TRUE(planned.problems.empty());
      LinkageMotion motion(planned.plan);
      for (const double input : {0.0, 0.3, 0.7, 1.0}) {
        const auto output = output_at(g, input);
        if (!output) continue;
        const InputMotion turned{input + std::arg(g.a), 0, 0};
        solve_position(planned.plan, std::span(&turned, 1), motion);
        ASSERT_EQ(motion.status, Status::done);
        const PartState<double> state = body_state(planned.plan, motion, 5);
        const double angle = std::atan2(state.direction.y, state.direction.x) - std::arg(g.b);
        EXPECT_NEAR(std::remainder(angle - output->output, 2 * pi), 0, 1e-12);
        ++seen;
      }
    }
  EXPECT_GE(seen, 8);
}

TEST(FindStephensonGenerators, AreFarBetterThanFourBars) {
  FunctionProblem p = stored_function("log10 1..10");
  p.max_link = 20;
  RunContext context;
  const double wanted = 30 * pi / 180;
  const StephensonAnswer answer = find_stephenson_generators(p, wanted, context);
  EXPECT_EQ(answer.status, Status::done);
  ASSERT_TRUE(answer.four_bar);
  ASSERT_FALSE(answer.designs.empty());
  const StephensonDesign& best = answer.designs[0];
  EXPECT_TRUE(best.assembles);
  EXPECT_GE(best.pair_angle, wanted);
  // Best known before: 0.00596 degrees; half as much again is allowed for another compiler.
  EXPECT_LT(best.greatest_error * 180 / pi, 1.5 * 0.00596);
  EXPECT_LT(best.greatest_error, 0.15 * answer.four_bar->greatest_error);
}

TEST(FindStephensonGenerators, RefuseWhatTheyCannotDo) {
  FunctionProblem p = stored_function("exp 0..1");
  RunContext context;
  p.fit = FunctionFit::points;
  EXPECT_THROW((void)find_stephenson_generators(p, 0, context), ContractError);
  p.fit = FunctionFit::minimax;
  context.cancel();
  EXPECT_EQ(find_stephenson_generators(p, 0, context).status, Status::cancelled);
}

}  // namespace
}  // namespace linkwright::planar
