// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pareto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/minimise.h"
#include "optimise/functions.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

bool wins(const std::vector<double>& a, const std::vector<double>& b) { return dominates(a, b); }

TEST(Dominates, NoneMoreAndOneLess) {
  EXPECT_TRUE(wins({1, 2, 3}, {1, 2, 4}));
  EXPECT_TRUE(wins({0, 0, 0}, {1, 2, 4}));
  EXPECT_FALSE(wins({1, 2, 3}, {1, 2, 3}));
  EXPECT_FALSE(wins({1, 2, 4}, {1, 2, 3}));
  EXPECT_FALSE(wins({0, 5}, {1, 2}));
  EXPECT_FALSE(wins({1, 2}, {0, 5}));
  EXPECT_TRUE(wins({1, infinity}, {2, infinity}));
  EXPECT_FALSE(wins({infinity, infinity}, {infinity, infinity}));
}

TEST(Dominates, ComparesAsManyObjectives) {
  EXPECT_THAT(message([] { wins({1, 2}, {1}); }), HasSubstr("2 and 1 objectives"));
}

TEST(NonDominated, LeavesTheFrontInOrder) {
  const std::vector<double> costs = {3, 3, 1, 4, 2, 2, 1, 4, 4, 1, 2, 5};
  EXPECT_THAT(non_dominated(costs, 2), ElementsAre(1, 2, 4));  // the first of the equal (1, 4)
  EXPECT_THAT(non_dominated(costs, 1), ElementsAre(2));        // twelve costs of one objective
  EXPECT_TRUE(non_dominated({}, 2).empty());
  EXPECT_THAT(message([&] { non_dominated(costs, 5); }), HasSubstr("12 costs of 5 objectives"));

  std::vector<ParetoPoint> points;
  for (std::size_t i = 0; i < 6; ++i) points.push_back({{double(i)}, {costs[2 * i], costs[2 * i + 1]}});
  const std::vector<ParetoPoint> front = non_dominated(points);
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].x[0], 1);
  EXPECT_EQ(front[1].x[0], 2);
  EXPECT_EQ(front[2].x[0], 4);
}

/// Points of three objectives, some of them equal in some; the same ones every time.
std::vector<ParetoPoint> cloud(std::size_t count) {
  RandomStream random({.seed = 8});
  std::vector<ParetoPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    ParetoPoint p = {{double(i)}, {}};
    const double a = random.below(12), b = random.below(12);
    p.costs = {a, b, 30 - a - b + random.below(6)};
    points.push_back(p);
  }
  return points;
}

TEST(ParetoArchive, KeepsTheFrontOfAllThatItWasTold) {
  const std::vector<ParetoPoint> points = cloud(400);
  ParetoArchive archive(1, 3, 400);
  for (const ParetoPoint& p : points) archive.tell(p.x, p.costs);
  const std::vector<ParetoPoint> kept = archive.points(), expected = non_dominated(points);
  ASSERT_EQ(kept.size(), expected.size());
  EXPECT_GT(kept.size(), 5u);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].x, expected[i].x);  // the first of equals
    EXPECT_EQ(kept[i].costs, expected[i].costs);
  }
}

TEST(ParetoArchive, ThinsWhereItIsCrowded) {
  // On a line from (0, 10) to (10, 0). Distances along one objective, the other doubles them all.
  ParetoArchive archive(1, 2, 4);
  const auto tell = [&](double f) { return archive.tell({&f, 1}, std::vector<double>{f, 10 - f}); };
  const auto costs = [&] {
    std::vector<double> first;
    for (const ParetoPoint& p : archive.points()) first.push_back(p.costs[0]);
    return first;
  };
  for (const double f : {0.0, 4.0, 10.0, 5.0}) EXPECT_TRUE(tell(f));
  EXPECT_FALSE(tell(4.5));  // between neighbours 1 apart
  EXPECT_THAT(costs(), ElementsAre(0, 4, 5, 10));
  EXPECT_TRUE(tell(8));  // 5 has neighbours 4 apart now, 4 and 8 have 5
  EXPECT_THAT(costs(), ElementsAre(0, 4, 8, 10));
  EXPECT_FALSE(tell(2));  // 4, against 6 of 4 and of 8
  EXPECT_THAT(costs(), ElementsAre(0, 4, 8, 10));
  EXPECT_EQ(archive.costs(3)[0], 8);  // told last
  // The ends stay whatever comes.
  for (int k = 1; k < 1000; ++k) tell(0.01 * k);
  EXPECT_EQ(archive.size(), 4u);
  EXPECT_EQ(costs().front(), 0);
  EXPECT_EQ(costs().back(), 10);
}

TEST(ParetoArchive, OneThatDominatesTakesThePlaceOfMany) {
  ParetoArchive archive(1, 2, 4);
  for (const double f : {1.0, 2.0, 3.0, 4.0}) archive.tell({&f, 1}, std::vector<double>{f, 5 - f});
  const double best = 9;
  EXPECT_TRUE(
      archive.tell({&best, 1}, std::vector<double>{1, 2}));  // better than those at 2, 3; not than (1, 4)
  EXPECT_EQ(archive.size(), 2u);
  EXPECT_FALSE(archive.tell({&best, 1}, std::vector<double>{1, 2}));
  EXPECT_FALSE(archive.tell({&best, 1}, std::vector<double>{2, 2}));
  EXPECT_FALSE(archive.tell({&best, 1}, std::vector<double>{-HUGE_VAL, 2}));
  EXPECT_EQ(archive.costs(1)[0], 1);
  EXPECT_EQ(archive.x(1)[0], 9);
}

TEST(ParetoArchive, IsAFunctionOfWhatItWasToldAndAllocatesNothing) {
  const std::vector<ParetoPoint> points = cloud(500);
  ParetoArchive a(1, 3, 8), b(1, 3, 8);
  const auto before = linkwright::test::allocations();
  for (const ParetoPoint& p : points) a.tell(p.x, p.costs);
  EXPECT_EQ(linkwright::test::allocations(), before);
  for (const ParetoPoint& p : points) b.tell(p.x, p.costs);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.x(i)[0], b.x(i)[0]);
}

TEST(ParetoArchive, MinimiseLeavesTheFrontOfASwarm) {
  const Problem problem = test::binh_korn();
  RunContext context;
  MinimiseOptions options = {.front = 20};
  options.stop.generations = 60;
  const Report report =
      minimise(problem, {.method = Method::subpopulation_firefly}, options, {.seed = 2}, context);
  EXPECT_EQ(report.front.size(), 20u);
  for (const ParetoPoint& p : report.front) {
    Population one(2, 1);
    one.set(0, p.x);
    std::vector<double> costs(2), violation(1);
    problem.evaluate(one.view(), costs, violation);
    EXPECT_EQ(costs, p.costs);
    EXPECT_EQ(violation[0], 0);
    EXPECT_FALSE(dominates(p.costs, report.costs));
  }
  // It spreads over a good part of the true front, which goes from (0, 50) to (136, 4).
  EXPECT_LT(report.front.front().costs[0], 15);
  EXPECT_GT(report.front.back().costs[0], 80);
  options.front = 0;
  EXPECT_TRUE(minimise(problem, {.method = Method::cuckoo_search}, options, {}, context).front.empty());
}

TEST(ParetoArchive, SaysWhatIsWrong) {
  EXPECT_THAT(message([] { ParetoArchive(2, 3, 5); }),
              HasSubstr("a front of 3 objectives needs room for 6, got 5"));
  EXPECT_THAT(message([] { ParetoArchive(0, 3, 6); }), HasSubstr("0 variables, 3 objectives"));
  ParetoArchive archive(1, 2, 4);
  const std::vector<double> one = {1}, two = {1, NAN};
  EXPECT_THAT(message([&] { archive.tell(one, one); }),
              HasSubstr("1 values for 1 variables, 1 costs for 2 objectives"));
  EXPECT_THAT(message([&] { archive.tell(one, two); }), HasSubstr("tell: cost 1: nan"));
}

}  // namespace
}  // namespace linkwright::optimise
