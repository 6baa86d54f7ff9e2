// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/four_bar_balancing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <random>

#include "planar/balancing_studies.h"

namespace linkwright::planar {
namespace {

using test::balancing_study;
using test::replaced;

std::string with_lengths() {
  std::string text = test::four_bar_masses;
  text = replaced(text, "crank_m   = 0.1", "crank_mm = { min = 80, max = 120, initial = 100 }");
  text = replaced(text, "rocker_m  = 0.32", "rocker_m  = { min = 0.256, max = 0.384, initial = 0.32 }");
  return replaced(text, "ground_m  = 0.6", "ground_m  = { min = 0.3, max = 0.9, initial = 0.6 }");
}

TEST(BalancingFourBar, BothWaysGiveTheSameObjectives) {
  const BalancingStudy s = balancing_study(with_lengths());
  const BalancingProblem p = balancing_problem(test::task_of(s));
  const auto fast = four_bar_problem(s, p);
  ASSERT_TRUE(fast);
  constexpr std::size_t n = 40;
  optimise::Population x(p.task.variables.size(), n);
  std::mt19937_64 random(3);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < p.task.variables.size(); ++j)
      x(j, i) = std::uniform_real_distribution(p.task.variables[j].lower, p.task.variables[j].upper)(random);
  std::vector<double> a(n * fast->values()), b(n * p.problem.values());
  fast->evaluate(x.view(), a);
  p.problem.evaluate(x.view(), b);
  int there = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const double u = a[i * fast->values() + k], v = b[i * p.problem.values() + k];
      ASSERT_EQ(std::isfinite(u), std::isfinite(v)) << i;
      if (!std::isfinite(u)) continue;
      ++there;
      // Near a dead point forces amplify rounding; none of these is nearer than a thousandth.
      EXPECT_NEAR(u, v, 1e-10 * v);
    }
  EXPECT_GT(there, 20);
  EXPECT_LT(there, 2 * static_cast<int>(n));
}

// A parallelogram stays one over both its change points, in the search as in the tables of the analysis; no
// row stands at a change point.
TEST(BalancingFourBar, AParallelogramStaysOne) {
  std::string text = replaced(test::four_bar_masses, "rocker_m  = 0.32", "rocker_m  = 0.1");
  text = replaced(replaced(text, "ground_m  = 0.6", "ground_m  = 0.4"), "from_deg = 0.0", "from_deg = 10.0");
  text = replaced(text, "centre_distance_mm = 160.0", "centre_distance_mm = 50.0");
  const BalancingStudy s = balancing_study(replaced(text, "to_deg   = 360.0", "to_deg   = 370.0"));
  const BalancingProblem p = balancing_problem(test::task_of(s));
  EXPECT_FALSE(four_bar_problem(s, p));
  std::vector<double> x;
  for (const study::DesignVariable& n : s.designed.numbers) x.push_back((n.lower + n.upper) / 2);
  const std::vector<std::string> columns = {"coupler_angle_rad", "shaking_force_x_N"};
  const Table table = design_table(s, x, columns);
  const auto masses = four_bar_of(s, x).masses;
  const Column *coupler = table.find(columns[0]), *shaking = table.find(columns[1]);
  ASSERT_TRUE(masses && coupler && shaking && table.rows() == 61u);
  // The coupler goes round a circle without turning: each point of it accelerates as the crank pin.
  const double speed = 300 * 2 * pi / 60;
  const auto moment = [](const LinkMass& m) {
    return std::polar(m.mass * m.centre_distance, m.centre_angle);
  };
  for (std::size_t r = 0; r < table.rows(); ++r) {
    EXPECT_EQ(table.status[r], "done");
    EXPECT_NEAR(coupler->values[r], 0, 1e-9) << r;
    const double angle = (10 + 6.0 * static_cast<double>(r)) * pi / 180;
    const std::complex<double> turned =
        (moment(masses->crank) + masses->coupler.mass * 0.1 + moment(masses->rocker)) *
        std::polar(1.0, angle);
    EXPECT_NEAR(shaking->values[r], speed * speed * turned.real(), 1e-7) << r;
  }
}

TEST(BalancingFourBar, TheReportTellsTheCompleteForceBalance) {
  const study::Result r = test::run_text(test::four_bar_masses);
  const std::string told = test::fact(r, "complete force balance would take");
  EXPECT_THAT(told, ::testing::MatchesRegex("crank .* kg at 100 mm, .*, rocker .* kg at 320 mm, .*"));
}

TEST(BalancingFourBar, WhatItDoesNotKnowIsLeftToTheGeneralWay) {
  const auto known = [](const std::string& text) {
    const BalancingStudy s = balancing_study(text);
    return four_bar_problem(s, balancing_problem(test::task_of(s))).has_value();
  };
  EXPECT_TRUE(known(with_lengths()));
  EXPECT_FALSE(known(replaced(with_lengths(), "shaking_force_x_N", "shaking_force_N")));
  EXPECT_FALSE(known(replaced(with_lengths(), "\"rms\"", "\"range\"")));
  EXPECT_FALSE(known(
      replaced(with_lengths(), "speed_rpm = 300.0", "speed_rpm = { min = 100, max = 300, initial = 200 }")));
  EXPECT_FALSE(known(with_lengths() +
                     "[[constraint]]\nquantity = \"coupler_rocker_transmission_angle_rad\"\nmeasure "
                     "= \"minimum\"\nat_least = 0.5\n"));
}

}  // namespace
}  // namespace linkwright::planar
