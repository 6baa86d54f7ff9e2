// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/pivot_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/planar/exact/given_pivots.h"
#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

const FourBar linkage_on_the_map{.ground = 1,
                                 .crank = 0.4,
                                 .coupler = 0.9,
                                 .rocker = 0.8,
                                 .coupler_u = 0.5,
                                 .coupler_v = 0.6,
                                 .pivot_x = 0.2,
                                 .pivot_y = -0.3};

PathProblem five_of_the_linkage() {
  std::vector<std::complex<double>> points;
  for (const double angle : {0.3, 1.0, 1.8, 2.9, 4.5})
    points.push_back(position(linkage_on_the_map, angle).coupler_point);
  return test::exact_problem(points);
}

PivotMap map_of(const PathProblem& problem, const PivotRanges& ranges, int threads = 2) {
  RunContext context;
  context.set_threads(threads);
  return map_pivots(problem, ranges, context);
}

// The rocker's pivot of the linkage, (1.2, -0.3), is one of the places.
const PivotRanges square = {{{0.2, 0.2}, {-0.3, -0.3}, {0.7, 1.7}, {-0.8, 0.2}}};

TEST(PivotMap, EachPlaceHasWhatFivePointsHaveThere) {
  const PathProblem problem = five_of_the_linkage();
  const PivotMap map = map_of(problem, square);
  EXPECT_EQ(map.steps, (std::array<std::size_t, 4>{1, 1, 21, 21}));
  ASSERT_EQ(map.places.size(), 441U);
  EXPECT_EQ(map.lost, 0);
  RunContext context;
  std::vector<std::complex<double>> points;
  for (std::size_t k = 0; k < 5; ++k) points.emplace_back(problem.x[k], problem.y[k]);
  for (const std::size_t which : {std::size_t{0}, std::size_t{100}, std::size_t{220}, std::size_t{440}}) {
    const PivotMapPlace& place = map.places[which];
    EXPECT_NEAR(place.pivots[1].real(), 0.7 + 0.05 * static_cast<double>(which / 21), 1e-12);
    EXPECT_NEAR(place.pivots[1].imag(), -0.8 + 0.05 * static_cast<double>(which % 21), 1e-12);
    const auto alone = solve_five_points(std::span(points).first<5>(), place.pivots, context);
    EXPECT_EQ(static_cast<std::size_t>(place.real), alone.real.size());
    const auto designs = exact_designs(problem, alone);
    EXPECT_EQ(place.answers, std::count_if(designs.begin(), designs.end(), [](const ExactDesign& d) {
                return d.defects.empty() && d.design.violations.empty();
              }));
  }
  // There the linkage itself stands.
  EXPECT_GT(map.places[220].answers, 0);
  EXPECT_FALSE(std::isnan(map.places[220].transmission));
}

TEST(PivotMap, TheBestComesFirst) {
  const PivotMap map = map_of(five_of_the_linkage(), square);
  ASSERT_GT(map.designs.size(), 3U);
  double largest = 0;
  for (const PivotMapPlace& place : map.places)
    if (!std::isnan(place.transmission)) largest = std::max(largest, place.transmission);
  const auto of_first = std::find_if(map.places.begin(), map.places.end(), [&](const PivotMapPlace& place) {
    return std::abs(place.pivots[1] - rocker_pivot(map.designs[0].design.linkage)) < 1e-9;
  });
  ASSERT_NE(of_first, map.places.end());
  EXPECT_EQ(of_first->transmission, largest);
}

TEST(PivotMap, DoesNotDependOnThreads) {
  const PivotMap one = map_of(five_of_the_linkage(), square, 1),
                 three = map_of(five_of_the_linkage(), square, 3);
  ASSERT_EQ(one.places.size(), three.places.size());
  for (std::size_t i = 0; i < one.places.size(); ++i) {
    EXPECT_EQ(one.places[i].real, three.places[i].real);
    if (!std::isnan(one.places[i].transmission)) {
      EXPECT_EQ(one.places[i].transmission, three.places[i].transmission);
    }
  }
}

TEST(PivotMap, FreeRangesShareThePlaces) {
  EXPECT_EQ(places_of_range(0), 1U);
  EXPECT_EQ(places_of_range(1), 401U);
  for (const std::size_t free : {2U, 3U, 4U}) {
    const double all = std::pow(places_of_range(free), free);
    EXPECT_GE(all, 400);
    EXPECT_LE(all, 625);
  }
}

TEST(PivotMap, PivotsThatCoincideHaveNoFourBar) {
  const PivotMap map = map_of(five_of_the_linkage(), {{{0, 0}, {0, 0}, {-1, 1}, {0, 0}}});
  ASSERT_EQ(map.places.size(), 401U);
  EXPECT_EQ(map.places[200].pivots[0], map.places[200].pivots[1]);
  EXPECT_EQ(map.places[200].real, 0);
}

TEST(PivotMap, ACancelledRunSaysSo) {
  RunContext context;
  context.cancel();
  const PivotMap map = map_pivots(five_of_the_linkage(), square, context);
  EXPECT_EQ(map.status, Status::cancelled);
  EXPECT_TRUE(map.places.empty());
}

}  // namespace
}  // namespace linkwright::planar
