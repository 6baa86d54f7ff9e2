// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/nine_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "planar/exact_cases.h"
#include "planar/exact_targets.h"

namespace linkwright::planar {
namespace {

using Points = std::vector<std::complex<double>>;

NinePointSolutions solve(const Points& points, int threads = 2, bool certify = true) {
  RunContext context;
  context.set_threads(threads);
  return solve_nine_points(points, {.cache = test::starts_folder(), .certify = certify}, context);
}

// Wampler, Morgan and Sommese 1992, problem 3; the data of a demonstration of homotopy software,
// ill-conditioned; points of a known four-bar.
TEST(NinePoints, AllClassesOfPublishedTargetsAreCertified) {
  for (const char* id : {"NP-WMS-3", "NP-demo", "NP-known-four-bar"}) {
    const Value& known = test::exact_case(id);
    const auto found = solve(test::exact_points(id));
    EXPECT_EQ(found.status, Status::done) << id;
    EXPECT_EQ(found.completeness, Completeness::complete) << id;
    EXPECT_EQ(found.classes.size(), 1442U) << id;
    EXPECT_EQ(found.certified, 1442) << id;
    EXPECT_EQ(found.real, linkwright::test::number_at(known, "computed.real_classes")) << id;
    EXPECT_EQ(found.infinite + found.singular + found.lost, 0) << id;
    EXPECT_TRUE(std::is_partitioned(found.classes.begin(), found.classes.end(),
                                    [](const CurveClass& c) { return c.real; }));
  }
}

// A sample of what bench/exact_statistics.cpp looks at. The paths that are lost at first are 2e-4 on average,
// and a target has 1442.
TEST(NinePoints, AllClassesOfRandomTargets) {
  for (const auto kind :
       {test::NinePointTarget::scattered, test::NinePointTarget::curve, test::NinePointTarget::crank_rocker})
    for (std::uint32_t number = 100; number < 107; ++number) {
      const test::RandomTarget target = test::random_target(kind, number);
      const auto found = solve(target.points);
      EXPECT_EQ(found.completeness, Completeness::complete) << static_cast<int>(kind) << ' ' << number;
      if (target.drawn_by) {
        EXPECT_TRUE(test::has(found, *target.drawn_by, target.points[0])) << number;
      }
    }
}

// Links of a million times the size, and classes near each other: by identities in doubles they were counted
// twice, and in one scale of all unknowns not certified.
TEST(NinePoints, LongLinksAreOneClassEachAndCertified) {
  using test::NinePointTarget;
  for (const auto& [kind, number] : {std::pair{NinePointTarget::scattered, 39u},
                                     {NinePointTarget::scattered, 67u},
                                     {NinePointTarget::curve, 0u},
                                     {NinePointTarget::curve, 32u},
                                     {NinePointTarget::crank_rocker, 13u},
                                     {NinePointTarget::crank_rocker, 16u}}) {
    const auto found = solve(test::random_target(kind, number).points);
    EXPECT_EQ(found.classes.size(), 1442u) << number;
    EXPECT_EQ(found.certified, 1442) << number;
  }
}

// Points near each other, the nearest by 2e-5 of the size: some classes are so far out that doubles stop
// before their ends and would call them infinite, others so near to each other that paths come to one twice.
// The last but three has a link of 4e7 times the size, which settles with twice the digits to 3e-18 of it;
// each of the last three has classes that take four times the digits for a certificate.
TEST(NinePoints, AllClassesOfCrowdedTargets) {
  using test::NinePointTarget;
  for (const auto& [kind, number] : {std::pair{NinePointTarget::curve, 26u},
                                     {NinePointTarget::curve, 43u},
                                     {NinePointTarget::crank_rocker, 70u},
                                     {NinePointTarget::crank_rocker, 97u},
                                     {NinePointTarget::crank_rocker_spread, 32u},
                                     {NinePointTarget::curve, 110u},
                                     {NinePointTarget::crank_rocker, 133u},
                                     {NinePointTarget::crank_rocker, 160u}}) {
    const auto found = solve(test::random_target(kind, number).points);
    EXPECT_EQ(found.completeness, Completeness::complete) << static_cast<int>(kind) << ' ' << number;
    EXPECT_EQ(found.certified, 1442) << number;
    EXPECT_EQ(found.infinite + found.singular + found.lost, 0) << number;
  }
}

// Along a short, nearly straight arc paths end so near to families of degenerate solutions that Newton's
// method comes to these.
TEST(NinePoints, AllClassesOfAShortArc) {
  Points points;
  for (int i = 0; i < 9; ++i) {
    const double t = 0.02 * i;
    points.emplace_back(t + 0.3 * t * t, 0.5 * t * t + 0.7 * t * t * t + 3 * t * t * t * t);
  }
  const auto found = solve(points);
  EXPECT_EQ(found.completeness, Completeness::complete);
  EXPECT_EQ(found.certified, 1442);
}

TEST(NinePoints, TheSameBitsOnAnyNumberOfThreads) {
  const Points points = test::exact_points("NP-demo");
  const auto one = solve(points, 1);
  for (const int threads : {2, 3}) {
    const auto more = solve(points, threads);
    ASSERT_EQ(one.classes.size(), more.classes.size());
    for (std::size_t i = 0; i < one.classes.size(); ++i) {
      EXPECT_EQ(one.classes[i].four_bar, more.classes[i].four_bar);
      EXPECT_EQ(one.classes[i].real, more.classes[i].real);
      EXPECT_EQ(one.classes[i].certified, more.classes[i].certified);
    }
  }
}

TEST(NinePoints, PointsInAnotherOrderAndPlaceHaveTheSameClasses) {
  Points points = test::exact_points("NP-WMS-3");
  std::swap(points[0], points[5]);
  std::swap(points[2], points[7]);
  const std::complex<double> turned = std::polar(0.013, 2.1);
  for (auto& point : points) point = turned * point + std::complex<double>(4, -2);
  const auto found = solve(points);
  EXPECT_EQ(found.completeness, Completeness::complete);
  EXPECT_EQ(found.real, 64);
}

TEST(NinePoints, LargeAndSmallUnitsGiveTheSameNumbers) {
  const Points points = test::exact_points("NP-WMS-3");
  const auto found = solve(points, 2, false);
  EXPECT_EQ(found.completeness, Completeness::complete_uncertified);
  for (const double unit : {0x1p-20, 0x1p20}) {
    Points scaled = points;
    for (auto& point : scaled) point *= unit;
    const auto other = solve(scaled, 2, false);
    ASSERT_EQ(found.classes.size(), other.classes.size());
    for (std::size_t i = 0; i < found.classes.size(); ++i)
      EXPECT_EQ(unit * found.classes[i].four_bar[0], other.classes[i].four_bar[0]);
  }
}

// Every real class has three linkages whose coupler point is at every point in one of its two positions.
TEST(NinePoints, CognatesOfARealClassShareTheirCurve) {
  const Points points = test::exact_points("NP-known-four-bar");
  const auto found = solve(points, 2, false);
  int linkages = 0;
  for (const CurveClass& curve : found.classes) {
    if (!curve.real) break;
    for (const TracingFourBar& bars : cognates_of(curve, points[0])) {
      ++linkages;
      // Both links turn about their pivots and carry the point from the first to each other one.
      EXPECT_GT(std::abs(bars.crank_pin - bars.crank_pivot), 0);
      EXPECT_TRUE(std::isfinite(std::abs(bars.rocker_pin) + std::abs(bars.rocker_pivot)));
    }
  }
  EXPECT_EQ(linkages, 3 * 72);
}

TEST(NinePoints, SpecialTargetsAreNeverComplete) {
  for (const char* id : {"NP-special-mirror", "NP-special-grid"}) {
    const Value& known = test::exact_case(id);
    const auto found = solve(test::exact_points(id));
    EXPECT_NE(found.completeness, Completeness::complete) << id;
    EXPECT_NE(found.completeness, Completeness::complete_uncertified) << id;
    EXPECT_EQ(found.status, Status::done) << id;
    EXPECT_EQ(found.certified, static_cast<int>(found.classes.size())) << id;
    EXPECT_NEAR(found.certified,
                linkwright::test::number_at(known, "computed.certified_regular_classes_about"), 10)
        << id;
    EXPECT_EQ(found.real, linkwright::test::number_at(known, "computed.real_classes")) << id;
    EXPECT_EQ(static_cast<int>(found.classes.size()) + found.infinite + found.singular + found.lost, 1442)
        << id;
    EXPECT_GE(std::min(found.infinite, found.singular), 0) << id;
  }
}

TEST(NinePoints, WhatHasNoSolutionIsKnownBeforehand) {
  const auto line = obstacle(test::exact_points("NP-special-seven-on-a-line"));
  EXPECT_EQ(line.kind, PointObstacle::collinear);
  EXPECT_EQ(line.points, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  const auto circle = obstacle(test::exact_points("NP-special-circle"));
  EXPECT_EQ(circle.kind, PointObstacle::concyclic);
  EXPECT_EQ(circle.points.size(), 9U);
  Points points = test::exact_points("NP-WMS-3");
  EXPECT_EQ(obstacle(points).kind, PointObstacle::none);
  points[7] = points[2];
  EXPECT_EQ(obstacle(points).kind, PointObstacle::repeated);
  EXPECT_EQ(obstacle(points).points, (std::vector<int>{2, 7}));
  EXPECT_THROW(solve(points), ContractError);
  // Six of nine may be on a line or on a circle.
  points = test::exact_points("NP-special-seven-on-a-line");
  points[3] += std::complex<double>(0, 0.2);
  EXPECT_EQ(obstacle(points).kind, PointObstacle::none);
  points = test::exact_points("NP-special-circle");
  for (std::size_t i : {1, 4, 8}) points[i] *= 1.1 + 0.1 * static_cast<double>(i);
  EXPECT_EQ(obstacle(points).kind, PointObstacle::none);
}

TEST(NinePoints, AnInterruptedRunIsNeverComplete) {
  const Points points = test::exact_points("NP-WMS-3");
  solve(points, 2, false);  // the start set is there
  RunContext cancelled;
  cancelled.cancel();
  const auto none = solve_nine_points(points, {.cache = test::starts_folder()}, cancelled);
  EXPECT_EQ(none.status, Status::cancelled);
  EXPECT_EQ(none.completeness, Completeness::incomplete);
  RunContext hurried;
  hurried.set_threads(1);
  hurried.set_time_limit(std::chrono::milliseconds(30));
  const auto some = solve_nine_points(points, {.cache = test::starts_folder()}, hurried);
  EXPECT_EQ(some.status, Status::deadline);
  EXPECT_EQ(some.completeness, Completeness::incomplete);
}

TEST(NinePoints, ReportsProgress) {
  RunContext context;
  std::vector<std::string> stages;
  double last = 0;
  context.set_progress([&](const Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage), last = 0;
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
  });
  solve_nine_points(test::exact_points("NP-WMS-3"), {.cache = test::starts_folder()}, context);
  ASSERT_GE(stages.size(), 2U);
  EXPECT_EQ(stages[stages.size() - 2], "paths");
  EXPECT_EQ(stages.back(), "certificates");
}

TEST(NinePoints, NeedsNineFinitePoints) {
  Points points = test::exact_points("NP-WMS-3");
  points.pop_back();
  EXPECT_THROW(solve(points), ContractError);
  points.emplace_back(NAN, 0);
  EXPECT_THROW(solve(points), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
