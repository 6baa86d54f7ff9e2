// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "planar/dyad_cases.h"
#include "planar/function_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;
using linkwright::test::number_at;

double distance_of(const FunctionGenerator& g, Complex a, Complex b, double c) {
  return (std::abs(g.a - a) + std::abs(g.b - b) + std::abs(g.c - c)) / (std::abs(a) + std::abs(b) + c);
}
double min_distance(const std::vector<FunctionGenerator>& all, Complex a, Complex b, double c) {
  double least = infinity;
  for (const FunctionGenerator& g : all) least = std::min(least, distance_of(g, a, b, c));
  return least;
}

// The stored pairs of a case: listed ones, or those of its function at five Chebyshev points.
std::vector<FunctionPair> stored_pairs(const Value& stored, std::string_view of) {
  std::vector<FunctionPair> out;
  if (stored.find("inputs")->find("phi_rad")) {
    const std::vector<double> input = linkwright::test::numbers(at(stored, "inputs.phi_rad")),
                              output = linkwright::test::numbers(at(stored, "inputs." + std::string(of)));
    for (std::size_t k = 0; k < input.size(); ++k) out.push_back({input[k], output[k]});
    return out;
  }
  const FunctionProblem p = stored_function(at(stored, "inputs.function").as_string());
  for (int k = 1; k <= 5; ++k) {
    const double share = 0.5 * (1 - std::cos((2 * k - 1) * pi / 10));
    out.push_back({p.input_range * share, p.output(share)});
  }
  return out;
}

TEST(ExactGenerators, FourBarsThroughTheStoredPairs) {
  for (const char* id :
       {"FG-5-anchor", "FG-5-x^1.5_1..4", "FG-5-log10_1..10", "FG-5-log10_1..2", "FG-5-sin_0..90",
        "FG-5-tan_0..45", "FG-5-exp_0..1", "FG-5-x^2_0..1", "FG-5-1/x_1..2"}) {
    const Value& stored = synthesis_case(id);
    const std::vector<FunctionPair> pairs = stored_pairs(stored, "psi_rad");
    const std::vector<FunctionGenerator> found = exact_generators(pairs, false);
    const auto& listed = at(stored, "computed.solutions").as_array();
    EXPECT_EQ(found.size(), listed.size()) << id;
    for (const Value& value : listed)
      EXPECT_LT(
          min_distance(found, complex_at(value, "a"), complex_at(value, "b"), number_at(value, "coupler")),
          1e-8)
          << id;
    for (const FunctionGenerator& g : found)
      for (const FunctionPair& p : pairs) {
        const Complex u = 1.0 + g.b * std::polar(1.0, p.output) - g.a * std::polar(1.0, p.input);
        EXPECT_NEAR(std::abs(u), g.c, 1e-9 * (g.c + std::abs(g.a))) << id;
      }
    for (const FunctionGenerator& g : found) {
      const auto first = output_at(g, pairs[0].input);
      ASSERT_TRUE(first) << id;
      EXPECT_NEAR(std::remainder(first->output - pairs[0].output, 2 * pi), 0, 1e-7) << id;
    }
  }
}

TEST(ExactGenerators, SliderCranksThroughTheStoredPairs) {
  const Value& stored = synthesis_case("FS-5-anchor");
  const std::vector<FunctionPair> pairs = stored_pairs(stored, "s_m");
  const std::vector<FunctionGenerator> found = exact_generators(pairs, true);
  const auto& listed = at(stored, "computed.solutions").as_array();
  EXPECT_EQ(found.size(), listed.size());
  for (const Value& value : listed) {
    const Complex a = std::polar(number_at(value, "crank_m"), number_at(value, "start_angle_rad"));
    const Complex b(number_at(value, "slider_zero_m"), number_at(value, "offset_m"));
    EXPECT_LT(min_distance(found, a, b, number_at(value, "rod_m")), 1e-8);
  }
  const auto first = output_at(found[0], pairs[0].input);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->output, pairs[0].output, 1e-9);
}

TEST(ExactGenerators, ThreePairsWithBothStartAnglesAreFreudensteins) {
  const Value& stored = linkwright::test::published_case("path-synthesis.json", "FG-3-exact");
  const std::vector<double> phi = linkwright::test::numbers(at(stored, "inputs.phi_rad")),
                            psi = linkwright::test::numbers(at(stored, "computed.psi_rad"));
  std::vector<FunctionPair> pairs;
  for (std::size_t k = 0; k < 3; ++k) pairs.push_back({phi[k], psi[k]});
  const std::vector<FunctionGenerator> found = exact_generators(pairs, false, {0.0, 0.0});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(distance_of(found[0], 0.45, 0.8, 1.1), 1e-10);
  EXPECT_EQ(found[0].branch, 1);
  EXPECT_THROW((void)exact_generators(pairs, false), ContractError);
}

TEST(ExactGenerators, ThePublishedPowerFunction) {
  const Value& stored = linkwright::test::published_case("path-synthesis.json", "FG-power-1.5");
  const std::vector<double> x = linkwright::test::numbers(at(stored, "inputs.chebyshev_points_x"));
  // Angles from the ground link: the start angles are those at the beginning of the ranges.
  const auto phi = [](double at_x) { return (40 + 60 * (at_x - 1)) * pi / 180; };
  const auto psi = [](double at_x) {
    return (60 + 70 * (std::pow(at_x, 1.5) - 1) / (std::pow(2, 1.5) - 1)) * pi / 180;
  };
  std::vector<FunctionPair> pairs;
  for (const double at_x : x) pairs.push_back({phi(at_x), psi(at_x)});
  const std::vector<FunctionGenerator> found = exact_generators(pairs, false, {0.0, 0.0});
  ASSERT_EQ(found.size(), 1u);
  // Its b is the coupler and its c the rocker.
  EXPECT_NEAR(found[0].a.real(), number_at(stored, "computed.a_m"), 1e-9);
  EXPECT_NEAR(found[0].b.real(), number_at(stored, "computed.c_m"), 1e-9);
  EXPECT_NEAR(found[0].c, number_at(stored, "computed.b_m"), 1e-9);
  double most = 0;
  for (int k = 0; k <= 4000; ++k) {
    const double at_x = 1 + k / 4000.0;
    const auto out = output_at(found[0], phi(at_x));
    ASSERT_TRUE(out);
    most = std::max(most, std::abs(std::remainder(out->output - psi(at_x), 2 * pi)));
  }
  EXPECT_NEAR(most, number_at(stored, "computed.max_structural_error_rad"), 1e-9);
}

// Freudenstein's equation over fifteen pairs, by the normal equations: a start next to which least squares of
// the angles end, at no more than its error.
TEST(ExactGenerators, FifteenPairsByFreudensteinsEquation) {
  const Value& stored = linkwright::test::published_case("path-synthesis.json", "FG-15-least-squares");
  const std::vector<double> phi = linkwright::test::numbers(at(stored, "inputs.phi_rad")),
                            psi = linkwright::test::numbers(at(stored, "inputs.psi_rad"));
  const std::vector<double> k = linkwright::test::numbers(at(stored, "computed.K"));
  std::array<double, 3> gradient{};
  for (std::size_t j = 0; j < phi.size(); ++j) {
    const double off = k[0] * std::cos(psi[j]) - k[1] * std::cos(phi[j]) + k[2] - std::cos(phi[j] - psi[j]);
    gradient[0] += off * std::cos(psi[j]), gradient[1] -= off * std::cos(phi[j]), gradient[2] += off;
  }
  for (const double slope : gradient) EXPECT_NEAR(slope, 0, 1e-10);
  // K1 = ground / crank, K2 = ground / rocker, and K3 gives the coupler.
  const double crank = 1 / k[0], rocker = 1 / k[1],
               coupler = std::sqrt(crank * crank + rocker * rocker + 1 - 2 * crank * rocker * k[2]);
  EXPECT_NEAR(crank, number_at(stored, "computed.crank_m"), 1e-10);
  EXPECT_NEAR(rocker, number_at(stored, "computed.rocker_m"), 1e-10);
  EXPECT_NEAR(coupler, number_at(stored, "computed.coupler_m"), 1e-10);
  const FunctionGenerator g{false, crank, rocker, coupler, 1};
  for (std::size_t j = 0; j < phi.size(); ++j) {
    const auto out = output_at(g, phi[j]);
    ASSERT_TRUE(out);
    // The pairs are those of crank 0.45, coupler 1.1, rocker 0.8 with an error of some 1e-3 rad.
    EXPECT_NEAR(out->output, psi[j], 5e-3);
  }
}

TEST(ExactGenerators, FourPairsWithOneStartAngle) {
  const FunctionGenerator known{false, std::polar(0.4, 0.3), std::polar(0.7, 1.1), 0.9, 1};
  std::vector<FunctionPair> pairs;
  for (const double input : {0.1, 0.6, 1.1, 1.5}) pairs.push_back({input, output_at(known, input)->output});
  for (const StartAngles given : {StartAngles{0.3, {}}, StartAngles{{}, 1.1}}) {
    const std::vector<FunctionGenerator> found = exact_generators(pairs, false, given);
    EXPECT_LE(found.size(), 3u);
    EXPECT_LT(min_distance(found, known.a, known.b, known.c), 1e-9);
  }
}

TEST(OutputAt, SlopesAreThoseOfDifferences) {
  for (const bool slider : {false, true})
    for (const double branch : {1.0, -1.0}) {
      const FunctionGenerator g{slider, std::polar(0.4, 0.3), {0.5, 0.2}, 0.9, branch};
      const auto at_place = output_at(g, 0.7);
      ASSERT_TRUE(at_place);
      for (std::size_t j = 0; j < 5; ++j) {
        constexpr double h = 1e-6;
        const auto moved = [&](double by) {
          FunctionGenerator other = g;
          if (j < 2) other.a += j == 0 ? Complex(by) : Complex(0, by);
          if (j == 2 || j == 3) other.b += j == 2 ? Complex(by) : Complex(0, by);
          if (j == 4) other.c += by;
          return output_at(other, 0.7)->output;
        };
        EXPECT_NEAR(at_place->slopes[j], (moved(h) - moved(-h)) / (2 * h),
                    1e-7 * (1 + std::abs(at_place->slopes[j])));
      }
    }
  EXPECT_FALSE(output_at({false, 3, 0.5, 0.4, 1}, 0.5));
  EXPECT_FALSE(output_at({true, 3, {0, 5}, 1, 1}, 0.5));
}

TEST(FunctionGenerator, BelongsToBothBranchesWhereTheyMeet) {
  // Stretched: crank pin at 0.5, coupler 1, rocker 0.5 to the left; folded: coupler 2 over a rocker of 1.5.
  for (const FunctionGenerator& g :
       {FunctionGenerator{false, {0.5, 0}, {-0.2, 0}, 0.3, 1},
        FunctionGenerator{false, {0.5, 0}, {1.5, 0}, 2, 1}, FunctionGenerator{false, {3, 0}, {-1, 0}, 3, 1},
        FunctionGenerator{false, {3, 0}, {0.5, 0}, 1.5, 1},
        FunctionGenerator{true, {0, 1}, {0, 1.75}, 0.75, 1}}) {
    for (const double longer : {1.0, 1 + 1e-12, 1 - 1e-12}) {
      FunctionGenerator near = g;
      near.c *= longer;
      const auto place = place_at(near, 0);
      ASSERT_TRUE(place);
      EXPECT_TRUE(place->on_both_branches);
      // A root of what the coupler is too long by.
      EXPECT_NEAR(g.slider ? place->output : std::remainder(place->output, 2 * pi), 0, 1e-5);
      EXPECT_LE(place->sine, 1e-5);
    }
    FunctionGenerator apart = g;
    apart.c *= g.slider || g.c == 0.3 || g.c == 1.5 ? 1 - 1e-6 : 1 + 1e-6;
    EXPECT_FALSE(place_at(apart, 0));
  }
}

}  // namespace
}  // namespace linkwright::planar
