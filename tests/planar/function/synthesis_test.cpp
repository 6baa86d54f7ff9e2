// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "planar/function_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;
using linkwright::test::number_at;

TEST(FunctionErrors, OfTheStoredGenerators) {
  int compared = 0;
  for (const Value& stored : at(synthesis_case("FG-minimax-best-known"), "computed.designs").as_array()) {
    if (at(stored, "type").as_string() != "four") continue;
    const std::vector<double> x = linkwright::test::numbers(at(stored, "parameters"));
    const FunctionGenerator g{
        false, {x[0], x[1]}, {x[2], x[3]}, x[4], at(stored, "branch").as_array()[0].as_number()};
    const FunctionDesign d = assess(stored_function(at(stored, "function").as_string()), g, 4001);
    ASSERT_TRUE(d.assembles);
    const double degrees = 180 / pi;
    // Printed with eight digits; of the pair angle with six.
    const double error = number_at(stored, "max_error_recomputed_deg");
    EXPECT_NEAR(d.greatest_error * degrees, error, 1e-6 * error);
    EXPECT_NEAR(d.pair_angle * degrees, number_at(stored, "min_pair_angle_recomputed_deg"), 1e-3);
    ++compared;
  }
  EXPECT_GE(compared, 12);
}

TEST(FindGenerators, TheLeastGreatestErrorsOfEightFunctions) {
  // Best known, in degrees, without a limit on the pair angle.
  const std::pair<const char*, double> known[] = {
      {"x^1.5 1..4", 0.0048603}, {"log10 1..10", 0.13891}, {"log10 1..2", 0.015204}, {"sin 0..90", 0.19057},
      {"tan 0..45", 0.038029},   {"exp 0..1", 0.025947},   {"x^2 0..1", 0.067117},   {"1/x 1..2", 0.012805}};
  for (const auto& [name, best] : known) {
    RunContext context;
    const FunctionAnswer answer = find_generators(stored_function(name), context);
    ASSERT_FALSE(answer.designs.empty()) << name;
    const FunctionDesign d = assess(stored_function(name), answer.designs[0].generator, 4001);
    EXPECT_TRUE(d.assembles) << name;
    EXPECT_LT(d.greatest_error * 180 / pi, 1.01 * best) << name;
  }
}

// Best known with pair angles of at least 30 degrees; for the decade of log10 none was known, and ours is
// listed.
TEST(FindGenerators, TheLeastGreatestErrorsWithALeastPairAngle) {
  const std::pair<const char*, double> known[] = {
      {"x^1.5 1..4", 0.0048603}, {"log10 1..10", 2.2855}, {"log10 1..2", 0.029280}, {"sin 0..90", 0.19057},
      {"tan 0..45", 0.25027},    {"exp 0..1", 0.025947},  {"x^2 0..1", 0.067117},   {"1/x 1..2", 0.17227}};
  for (const auto& [name, best] : known) {
    FunctionProblem p = stored_function(name);
    p.min_pair_angle = pi / 6;
    RunContext context;
    const FunctionAnswer answer = find_generators(p, context);
    ASSERT_FALSE(answer.designs.empty()) << name;
    const FunctionDesign d = assess(p, answer.designs[0].generator, 4001);
    EXPECT_TRUE(d.assembles) << name;
    EXPECT_GE(d.pair_angle, pi / 6) << name;
    // The condition keeps 0.1 degrees from the limit.
    EXPECT_LT(d.greatest_error * 180 / pi, 1.03 * best) << name;
  }
}

TEST(FindGenerators, LeastSquaresAreBetterOnAverageThanMinimax) {
  FunctionProblem p = stored_function("exp 0..1");
  RunContext context;
  const FunctionDesign largest = find_generators(p, context).designs[0];
  p.fit = FunctionFit::least_squares;
  const FunctionDesign squares = find_generators(p, context).designs[0];
  EXPECT_LT(squares.rms_error, largest.rms_error);
  EXPECT_GT(squares.greatest_error, largest.greatest_error);
}

TEST(FindGenerators, ExactOnesThatDoNotAssembleBetweenTheirPointsComeLast) {
  FunctionProblem p = stored_function("log10 1..10");
  p.fit = FunctionFit::points;
  p.at = chebyshev_shares(5);
  RunContext context;
  const FunctionAnswer answer = find_generators(p, context);
  ASSERT_EQ(answer.designs.size(), 1u);
  EXPECT_FALSE(answer.designs[0].assembles);
  p = stored_function("x^1.5 1..4");
  p.fit = FunctionFit::points;
  p.at = chebyshev_shares(5);
  const FunctionAnswer power = find_generators(p, context);
  ASSERT_EQ(power.designs.size(), 3u);
  EXPECT_TRUE(power.designs[0].assembles);
  EXPECT_EQ(power.designs[0].other_branch, 0);
  for (const double share : p.at)
    EXPECT_NEAR(*structural_error(p, power.designs[0].generator, share), 0, 1e-9);
}

TEST(FindGenerators, SliderCranks) {
  FunctionProblem p = stored_function("x^1.5 1..4");
  p.slider = true;
  p.input_range = pi / 3;
  const auto angle = p.output;
  p.output = [angle](double share) { return 0.08 * angle(share) / (pi / 2); };
  p.max_link = 1.6;
  RunContext context;
  const FunctionAnswer answer = find_generators(p, context);
  ASSERT_FALSE(answer.designs.empty());
  EXPECT_TRUE(answer.designs[0].assembles);
  EXPECT_LT(answer.designs[0].greatest_error, 1e-3 * 0.08);
}

TEST(FindGenerators, EndWhenTheyAreAskedTo) {
  RunContext context;
  context.cancel();
  EXPECT_EQ(find_generators(stored_function("exp 0..1"), context).status, Status::cancelled);
}

// Crank and rocker lie in line with the ground at the start: coupler and rocker then lie in line as well, and
// both branches meet. Lengths by Freudenstein's equation at the three pairs: ground / crank cos(psi) - ground
// / rocker cos(phi) + k3 = cos(phi - psi).
TEST(FindGenerators, AGeneratorMayStartWhereItsBranchesMeet) {
  FunctionProblem p;
  p.input_range = 0.6;
  p.output = [](double share) { return 0.4 * share; };
  p.at = {0, 0.5, 1};
  p.given = {.input = 0, .output = 0};
  RunContext context;
  const FunctionAnswer answer = find_generators(p, context);
  ASSERT_EQ(answer.designs.size(), 1u);
  const FunctionDesign& d = answer.designs[0];
  EXPECT_TRUE(d.assembles);
  EXPECT_EQ(d.other_branch, 0);
  EXPECT_EQ(d.generator.branch, 1);
  EXPECT_NEAR(4 * std::abs(d.generator.a), 9.949991485, 1e-8);
  EXPECT_NEAR(4 * d.generator.c, 53.253865640, 1e-8);
  EXPECT_NEAR(4 * std::abs(d.generator.b), 59.203857125, 1e-8);
  EXPECT_NEAR(d.greatest_error * 180 / pi, 3.895e-5, 5e-8);
  EXPECT_LT(d.pair_angle, 1e-4);  // a root of the rounding of the lengths
}

}  // namespace
}  // namespace linkwright::planar
