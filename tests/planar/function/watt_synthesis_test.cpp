// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/watt_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <span>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {
namespace {

WattGenerator some_watt() {
  return {{false, std::polar(0.6, 0.4), std::polar(0.8, 1.1), 1.1, 1},
          {false, std::polar(0.7, 0.9), std::polar(0.9, 0.7), 1.2, 1}};
}
FunctionProblem decade_of_logarithm(FunctionFit fit) {
  FunctionProblem p;
  p.input_range = pi / 2;
  p.output = [](double share) { return pi / 2 * std::log10(1 + 9 * share); };
  p.fit = fit;
  p.max_link = 5;
  return p;
}

TEST(WattGenerators, SlopesAreThoseOfDifferences) {
  const WattGenerator g = some_watt();
  const auto at_place = output_at(g, 0.5);
  ASSERT_TRUE(at_place);
  for (std::size_t j = 0; j < 10; ++j) {
    constexpr double h = 1e-6;
    const auto moved = [&](double by) {
      WattGenerator other = g;
      FunctionGenerator& part = j < 5 ? other.first : other.second;
      const std::size_t k = j % 5;
      if (k < 2) part.a += k == 0 ? std::complex<double>(by) : std::complex<double>(0, by);
      if (k == 2 || k == 3) part.b += k == 2 ? std::complex<double>(by) : std::complex<double>(0, by);
      if (k == 4) part.c += by;
      return output_at(other, 0.5)->output;
    };
    EXPECT_NEAR(at_place->slopes[j], (moved(h) - moved(-h)) / (2 * h), 1e-7) << j;
  }
  WattGenerator apart = g;
  apart.second.c = 9;
  EXPECT_FALSE(output_at(apart, 0.5));
}

TEST(WattGenerators, MoveAsTheLinkageDoes) {
  for (const double branch : {1.0, -1.0}) {
    WattGenerator g = some_watt();
    g.second.branch = branch;
    const Linkage linkage = linkage_of(g, 0.3);
    const PlanResult planned = plan_linkage(linkage);
    ASSERT_TRUE(planned.problems.empty());
    LinkageMotion motion(planned.plan);
    for (const double input : {0.0, 0.3, 0.7, 1.0}) {
      const auto output = output_at(g, input);
      ASSERT_TRUE(output) << input;
      const InputMotion turned{input + std::arg(g.first.a), 0, 0};
      solve_position(planned.plan, std::span(&turned, 1), motion);
      ASSERT_EQ(motion.status, Status::done);
      const PartState<double> state = body_state(planned.plan, motion, 5);
      const double angle = std::atan2(state.direction.y, state.direction.x) - std::arg(g.second.b);
      EXPECT_NEAR(math::wrap_angle(angle - output->output), 0, 1e-12);
    }
  }
}

TEST(WattGenerators, AParallelogramBehindChangesNothing) {
  const FunctionGenerator four_bar = some_watt().first;
  const std::complex<double> pin = std::polar(0.8, 0.5);
  const WattGenerator g{four_bar, {false, pin, pin, 1, 1}};
  for (const double input : {0.0, 0.4, 0.9})
    EXPECT_NEAR(output_at(g, input)->output, output_at(four_bar, input)->output, 1e-12);
}

TEST(FindWattGenerators, AreFarBetterThanFourBars) {
  for (const FunctionFit fit : {FunctionFit::least_squares, FunctionFit::minimax}) {
    RunContext context;
    const double wanted = 20 * pi / 180;
    const WattAnswer answer = find_watt_generators(decade_of_logarithm(fit), wanted, context);
    EXPECT_EQ(answer.status, Status::done);
    ASSERT_TRUE(answer.four_bar);
    ASSERT_FALSE(answer.designs.empty());
    const WattDesign& best = answer.designs[0];
    EXPECT_LT(best.greatest_error, 0.15 * answer.four_bar->greatest_error);
    EXPECT_GE(best.pair_angle, wanted);
    EXPECT_TRUE(best.assembles);
    for (const FunctionGenerator& g : {best.generator.first, best.generator.second})
      for (const double length : {std::abs(g.a), std::abs(g.b), g.c}) EXPECT_LE(length, 5 + 1e-12);
  }
}

TEST(FindWattGenerators, RefuseWhatTheyCannotDo) {
  RunContext context;
  EXPECT_THROW((void)find_watt_generators(decade_of_logarithm(FunctionFit::points), 0, context),
               ContractError);
  FunctionProblem slider = decade_of_logarithm(FunctionFit::minimax);
  slider.slider = true;
  EXPECT_THROW((void)find_watt_generators(slider, 0, context), ContractError);
  context.cancel();
  EXPECT_EQ(find_watt_generators(decade_of_logarithm(FunctionFit::minimax), 0, context).status,
            Status::cancelled);
}

}  // namespace
}  // namespace linkwright::planar
