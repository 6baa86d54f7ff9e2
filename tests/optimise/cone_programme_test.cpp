// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cone_programme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/optimise/nlopt_bridge.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

Cone at_least(std::size_t variable, double limit) {
  return {.bound = {{variable}, {1}, -limit}, .parts = {}};
}
Cone at_most(std::size_t variable, double limit) { return {.bound = {{variable}, {-1}, limit}, .parts = {}}; }

ConeReport run(const ConeProgramme& programme) {
  RunContext context;
  return solve(programme, {}, context);
}

// The conditions of Karush, Kuhn and Tucker with the numbers of the report alone: cones met, multipliers in
// their cones, cost the weighted sum of the cones, products of slack and multiplier zero. `tolerance`
// relative to the largest multiplier and slack.
void expect_optimal(const ConeProgramme& programme, const ConeReport& r, double tolerance) {
  ASSERT_EQ(r.status, Status::done) << name_of(r.end);
  std::vector<double> residual = programme.cost;
  double largest = 1, product = 0;
  for (std::size_t k = 0; k < programme.cones.size(); ++k) {
    const Cone& cone = programme.cones[k];
    const ConeMultiplier& m = r.multipliers[k];
    const auto take = [&](const Affine& form, double z) {
      for (std::size_t i = 0; i < form.variables.size(); ++i)
        residual[form.variables[i]] -= z * form.factors[i];
    };
    take(cone.bound, m.bound);
    double parts = 0, norm = 0, dot = m.bound * value(cone.bound, r.x);
    for (std::size_t i = 0; i < cone.parts.size(); ++i) {
      take(cone.parts[i], m.parts[i]);
      const double v = value(cone.parts[i], r.x);
      parts += v * v, norm += m.parts[i] * m.parts[i], dot += m.parts[i] * v;
    }
    largest = std::max({largest, m.bound, std::abs(value(cone.bound, r.x))});
    EXPECT_LE(std::sqrt(parts), value(cone.bound, r.x) + tolerance * largest) << "cone " << k;
    EXPECT_LE(std::sqrt(norm), m.bound + tolerance * largest) << "multiplier " << k;
    product = std::max(product, std::abs(dot));
  }
  for (std::size_t j = 0; j < residual.size(); ++j)
    EXPECT_NEAR(residual[j], 0, tolerance * largest) << "variable " << j;
  EXPECT_LE(product, tolerance * largest * std::max(1.0, std::abs(r.cost)));
  EXPECT_NEAR(r.cost, r.lower_bound, tolerance * std::max(1.0, std::abs(r.cost)));
  EXPECT_LE(r.gap, 1e-9);
}

TEST(ConeProgramme, LinearProgrammeOfTwoProducts) {
  // The textbook factory of Hillier and Lieberman: 3 x + 5 y, x <= 4, 2 y <= 12, 3 x + 2 y <= 18; 36 at (2,
  // 6), prices 0, 3/2, 1.
  const ConeProgramme p{.cost = {-3, -5},
                        .cones = {at_least(0, 0),
                                  at_least(1, 0),
                                  at_most(0, 4),
                                  {.bound = {{1}, {-2}, 12}, .parts = {}},
                                  {.bound = {{0, 1}, {-3, -2}, 18}, .parts = {}}}};
  const ConeReport r = run(p);
  expect_optimal(p, r, 1e-8);
  EXPECT_NEAR(r.cost, -36, 1e-8);
  EXPECT_NEAR(r.x[0], 2, 1e-8);
  EXPECT_NEAR(r.x[1], 6, 1e-8);
  EXPECT_NEAR(r.multipliers[2].bound, 0, 1e-8);
  EXPECT_NEAR(r.multipliers[3].bound, 1.5, 1e-8);
  EXPECT_NEAR(r.multipliers[4].bound, 1, 1e-8);
}

TEST(ConeProgramme, ProjectionOntoABall) {
  // The nearest point of the ball of radius 2 about 0 to (3, 0, 4): (6/5, 0, 8/5), 3 away.
  const ConeProgramme p{
      .cost = {0, 0, 0, 1},
      .cones = {{.bound = {{3}, {1}, 0}, .parts = {{{0}, {1}, -3}, {{1}, {1}, 0}, {{2}, {1}, -4}}},
                {.bound = {{}, {}, 2}, .parts = {{{0}, {1}, 0}, {{1}, {1}, 0}, {{2}, {1}, 0}}}}};
  const ConeReport r = run(p);
  expect_optimal(p, r, 1e-8);
  EXPECT_NEAR(r.cost, 3, 1e-9);
  EXPECT_NEAR(r.x[0], 1.2, 1e-8);
  EXPECT_NEAR(r.x[1], 0, 1e-8);
  EXPECT_NEAR(r.x[2], 1.6, 1e-8);
  EXPECT_NEAR(r.multipliers[1].bound, 1, 1e-8);  // a ball larger by d is nearer by d
}

TEST(ConeProgramme, SmallestBallAroundPoints) {
  // An obtuse triangle is enclosed by the circle over its longest side; the third point has no price.
  const double points[][2] = {{0, 0}, {4, 0}, {1, 1}};
  ConeProgramme p{.cost = {0, 0, 1}, .cones = {}};
  for (const auto& q : points)
    p.cones.push_back({.bound = {{2}, {1}, 0}, .parts = {{{0}, {1}, -q[0]}, {{1}, {1}, -q[1]}}});
  const ConeReport r = run(p);
  expect_optimal(p, r, 1e-8);
  EXPECT_NEAR(r.cost, 2, 1e-9);
  EXPECT_NEAR(r.x[0], 2, 1e-8);
  EXPECT_NEAR(r.x[1], 0, 3e-5);  // to the side, the radius grows with the square only: root of the gap
  EXPECT_NEAR(r.multipliers[0].bound, 0.5, 1e-7);
  EXPECT_NEAR(r.multipliers[1].bound, 0.5, 1e-7);
  EXPECT_NEAR(r.multipliers[2].bound, 0, 1e-8);
}

TEST(ConeProgramme, PointOfLeastSumOfDistances) {
  // Fermat's point of an equilateral triangle of side 1 sees its sides under 120 degrees: sum sqrt(3). And
  // where one angle exceeds 120 degrees it is the corner: the cone of that distance ends in its tip.
  const auto fermat = [](std::vector<std::vector<double>> corners) {
    ConeProgramme p{.cost = {0, 0, 1, 1, 1}, .cones = {}};
    for (std::size_t k = 0; k < 3; ++k)
      p.cones.push_back(
          {.bound = {{2 + k}, {1}, 0}, .parts = {{{0}, {1}, -corners[k][0]}, {{1}, {1}, -corners[k][1]}}});
    const ConeReport r = run(p);
    expect_optimal(p, r, 1e-8);
    return r;
  };
  EXPECT_NEAR(fermat({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}).cost, std::sqrt(3), 1e-9);
  const ConeReport corner = fermat({{-3, 0}, {3, 0}, {0, 0.5}});
  EXPECT_NEAR(corner.cost, 2 * std::hypot(3, 0.5), 1e-8);
  EXPECT_NEAR(corner.x[1], 0.5, 1e-7);
}

TEST(ConeProgramme, RotatedConeIsAProduct) {
  // Least x + y with x y >= 4: 2 and 2.
  const ConeProgramme p{.cost = {1, 1}, .cones = {rotated_cone({{{}, {}, 2}}, {{0}, {1}, 0}, {{1}, {1}, 0})}};
  const ConeReport r = run(p);
  expect_optimal(p, r, 1e-8);
  EXPECT_NEAR(r.cost, 4, 1e-9);
  EXPECT_NEAR(r.x[0], 2, 1e-6);  // the cost is flat along the hyperbola
}

TEST(ConeProgramme, AnInfeasibleOneIsProvedSo) {
  // A ball of radius 1 about 0 and the half-plane x >= 2; then two half-lines.
  ConeProgramme ball{
      .cost = {1, 1},
      .cones = {{.bound = {{}, {}, 1}, .parts = {{{0}, {1}, 0}, {{1}, {1}, 0}}}, at_least(0, 2)}};
  ConeProgramme lines{.cost = {1}, .cones = {at_most(0, -1), at_least(0, 1e-3)}};
  for (const ConeProgramme& p : {ball, lines}) {
    const ConeReport r = run(p);
    EXPECT_EQ(r.status, Status::infeasible);
    EXPECT_EQ(r.end, ConeEnd::infeasible);
    EXPECT_TRUE(r.x.empty());
    EXPECT_EQ(r.lower_bound, HUGE_VAL);
    // Multipliers in their cones whose sum of the cones is no function of x, but a negative number.
    std::vector<double> sum(p.cost.size());
    double constant = 0;
    for (std::size_t k = 0; k < p.cones.size(); ++k) {
      const auto add = [&](const Affine& form, double z) {
        for (std::size_t i = 0; i < form.variables.size(); ++i) sum[form.variables[i]] += z * form.factors[i];
        constant += z * form.constant;
      };
      add(p.cones[k].bound, r.multipliers[k].bound);
      double norm = 0;
      for (std::size_t i = 0; i < p.cones[k].parts.size(); ++i) {
        add(p.cones[k].parts[i], r.multipliers[k].parts[i]);
        norm = std::hypot(norm, r.multipliers[k].parts[i]);
      }
      EXPECT_GE(r.multipliers[k].bound, norm * (1 - 1e-9));
    }
    EXPECT_LT(constant, 0);
    for (const double s : sum) EXPECT_NEAR(s, 0, 1e-7 * -constant);
  }
}

TEST(ConeProgramme, AnUnboundedOneIsToldSo) {
  const ConeReport r = run({.cost = {-1, 0}, .cones = {at_least(0, 0), at_least(1, 0), at_most(1, 1)}});
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_EQ(r.end, ConeEnd::unbounded);
  EXPECT_GT(r.x[0], 0);
  EXPECT_EQ(r.cost, -HUGE_VAL);
}

// Random norms over a box, a cap among them: the largest of two minimised.
ConeProgramme random_programme(std::uint64_t seed, std::size_t n) {
  RandomStream random({.seed = seed});
  ConeProgramme p;
  p.cost.assign(n + 1, 0.0);
  p.cost[n] = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    Cone cone{.bound = k < 3 ? Affine{{n}, {1}, 0} : Affine{{}, {}, 0}, .parts = {}};
    double at_zero = 0;
    for (std::size_t i = 0; i < n + 3; ++i) {
      Affine part{.variables = {}, .factors = {}, .constant = random.normal()};
      for (std::size_t j = 0; j < n; ++j) {
        part.variables.push_back(j);
        part.factors.push_back(random.normal());
      }
      at_zero += part.constant * part.constant;
      cone.parts.push_back(part);
    }
    if (k == 3) cone.bound.constant = std::sqrt(at_zero);  // 0 is feasible
    p.cones.push_back(cone);
  }
  for (std::size_t j = 0; j < n; ++j) {
    p.cones.push_back(at_least(j, -0.1));
    p.cones.push_back(at_most(j, 0.15));
  }
  return p;
}

TEST(ConeProgramme, AgreesWithSequentialQuadraticProgramming) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::size_t n = 3 + seed % 10;
    const ConeProgramme p = random_programme(seed, n);
    const ConeReport r = run(p);
    expect_optimal(p, r, 1e-8);
    EXPECT_LE(r.iterations, 25) << seed;

    const auto norm = [&](std::size_t k, std::span<const double> x, double* gradient) {
      double square = 0;
      for (const Affine& part : p.cones[k].parts) square += std::pow(value(part, x), 2);
      const double length = std::sqrt(square);
      if (gradient) {
        std::fill(gradient, gradient + n + 1, 0.0);
        for (const Affine& part : p.cones[k].parts)
          for (std::size_t j = 0; j < n; ++j) gradient[j] += value(part, x) * part.factors[j] / length;
      }
      return length;
    };
    std::vector<double> x(n + 1, 0.0), low(n + 1, -0.1), high(n + 1, 0.15);
    low[n] = 0, high[n] = 1e3, x[n] = 100;
    RunContext context;
    const LocalReport local = minimise_local(
        [&](std::span<const double> at, std::span<double> gradient) {
          std::fill(gradient.begin(), gradient.end(), 0.0);
          if (!gradient.empty()) gradient[n] = 1;
          return at[n];
        },
        4,
        [&](std::span<const double> at, std::span<double> values, std::span<double> jacobian) {
          for (std::size_t k = 0; k < 4; ++k) {
            double* row = jacobian.empty() ? nullptr : jacobian.data() + k * (n + 1);
            values[k] = norm(k, at, row) - value(p.cones[k].bound, at);
            if (row && k < 3) row[n] = -1;
          }
        },
        x, low, high, {}, context);
    ASSERT_EQ(local.status, Status::done);
    // Tolerances of SLSQP leave this gap; never below the lower bound by more than its constraints may be
    // off.
    EXPECT_NEAR(local.cost, r.cost, 1e-7 * r.cost) << seed;
    EXPECT_GE(local.cost, r.lower_bound - 1e-8) << seed;
  }
}

TEST(ConeProgramme, UnitsDoNotMatter) {
  // The same in variables of other units and with cones multiplied through.
  const ConeProgramme p = random_programme(3, 6);
  ConeProgramme q = p;
  const auto unit = [](std::size_t j) { return std::pow(10.0, static_cast<double>(j % 5) - 3); };
  for (std::size_t k = 0; k < q.cones.size(); ++k) {
    const double factor = std::pow(10.0, static_cast<double>(k % 3) * 2 - 2);
    const auto change = [&](Affine& form) {
      form.constant *= factor;
      for (std::size_t i = 0; i < form.variables.size(); ++i)
        form.factors[i] *= factor / unit(form.variables[i]);
    };
    change(q.cones[k].bound);
    for (Affine& part : q.cones[k].parts) change(part);
  }
  for (std::size_t j = 0; j < q.cost.size(); ++j) q.cost[j] /= unit(j);
  const ConeReport a = run(p), b = run(q);
  EXPECT_EQ(b.status, Status::done);
  EXPECT_NEAR(a.cost, b.cost, 1e-8 * a.cost);
  // Root of the gap where the cost is smooth.
  for (std::size_t j = 0; j < q.cost.size(); ++j) EXPECT_NEAR(b.x[j] / unit(j), a.x[j], 1e-5);
}

TEST(ConeProgramme, LongChainsOfCheapVariables) {
  // Least sum of |x - a_i|: the median. Partial sums y_i with |x - a_i| <= y_i - y_(i-1) keep the equations
  // sparse.
  constexpr std::size_t n = 2001;
  ConeProgramme p;
  p.cost.assign(n + 1, 0.0);
  p.cost[n] = 1;
  std::vector<double> a;
  for (std::size_t i = 0; i < n; ++i) {
    a.push_back(std::cos(static_cast<double>(i * i)));
    Cone cone{.bound = {{i + 1}, {1}, 0}, .parts = {{{0}, {1}, -a[i]}}};
    if (i > 0) {
      cone.bound.variables.push_back(i);
      cone.bound.factors.push_back(-1);
    }
    p.cones.push_back(cone);
  }
  const ConeReport r = run(p);
  ASSERT_EQ(r.status, Status::done) << name_of(r.end);
  std::nth_element(a.begin(), a.begin() + n / 2, a.end());
  EXPECT_NEAR(r.x[0], a[n / 2], 1e-6);
  double sum = 0;
  for (const double v : a) sum += std::abs(v - a[n / 2]);
  EXPECT_NEAR(r.cost, sum, 1e-8 * sum);
}

TEST(ConeProgramme, AnOptimumOfZero) {
  // A point that all norms vanish at: no relative gap can be met, an absolute one is.
  const ConeProgramme p{
      .cost = {0, 0, 1},
      .cones = {{.bound = {{2}, {1}, 0}, .parts = {{{0}, {1}, -3}, {{0, 1}, {1, 2}, 1}}}, at_most(0, 100)}};
  RunContext context;
  const ConeReport r = solve(p, {.absolute_gap = 1e-10}, context);
  EXPECT_EQ(r.status, Status::done) << name_of(r.end);
  EXPECT_NEAR(r.cost, 0, 1e-9);
  EXPECT_NEAR(r.x[0], 3, 1e-8);
  EXPECT_NEAR(r.x[1], -2, 1e-8);
}

TEST(ConeProgramme, TheSameBitsEveryTime) {
  const ConeProgramme p = random_programme(7, 8);
  EXPECT_EQ(run(p).x, run(p).x);
}

TEST(ConeProgramme, StopsWhenAsked) {
  RunContext context;
  context.cancel();
  EXPECT_EQ(solve(random_programme(7, 8), {}, context).status, Status::cancelled);
  RunContext free;
  const ConeReport r = solve(random_programme(7, 8), {.max_iterations = 3}, free);
  EXPECT_EQ(r.status, Status::not_converged);
  EXPECT_EQ(r.end, ConeEnd::iterations);
  EXPECT_GT(r.gap, 1e-10);
}

TEST(ConeProgramme, TellsWhatIsWrong) {
  EXPECT_THAT(message([] { run({}); }), HasSubstr("a cone programme needs variables"));
  EXPECT_THAT(message([] { run({.cost = {1, NAN}, .cones = {}}); }), HasSubstr("cost nan of variable 1"));
  EXPECT_THAT(message([] {
                run({.cost = {1, 2}, .cones = {at_least(0, 0)}});
              }),
              HasSubstr("variable 1 is in no cone"));
  EXPECT_THAT(message([] { run({.cost = {1}, .cones = {at_least(2, 0)}}); }),
              HasSubstr("variable 2 of 1 in cone 0"));
  EXPECT_THAT(message([] {
                run({.cost = {1}, .cones = {{.bound = {{0, 0}, {1, 1}, 0}, .parts = {}}}});
              }),
              HasSubstr("variable 0 occurs twice in an expression of cone 0"));
  EXPECT_THAT(message([] {
                RunContext context;
                solve({.cost = {1}, .cones = {at_least(0, 0)}}, {.gap = 0}, context);
              }),
              HasSubstr("tolerances 0 and 1e-10 must be more than 0"));
}

}  // namespace
}  // namespace linkwright::optimise
