// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/mass_balancing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "planar/balancing_studies.h"

namespace linkwright::planar {
namespace {

using test::balancing_study;
using ::testing::HasSubstr;

const std::vector<std::string>& loads(std::string_view type) {
  static const std::vector<std::string> four_bar = {"O1_x_N",
                                                    "O3_y_N",
                                                    "O4_N",
                                                    "O1_drive_torque_N_m",
                                                    "shaking_force_N",
                                                    "shaking_moment_with_drive_N_m"},
                                        linkage = {"O_x_N", "O_N", "O_drive_torque_N_m", "shaking_force_x_N",
                                                   "shaking_moment_N_m"},
                                        arm = {"O1_N", "O2_x_N", "link2_torque_absolute_N_m",
                                               "link1_torque_joint_N_m"};
  return type == "planar.four_bar" ? four_bar : type == "planar.serial_arm" ? arm : linkage;
}

// The two ways to evaluate a design must agree: through the file and the motion, and linearly in the masses.
void expect_same_tables(const BalancingStudy& s) {
  std::string why;
  const auto masses = mass_study(s, why);
  ASSERT_TRUE(masses) << why;
  const auto& columns = loads(s.mechanism->type);
  const auto table = mass_table(masses, columns);
  ASSERT_TRUE(table);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<double> x;
    for (const study::DesignVariable& n : s.designed.numbers)
      x.push_back(std::uniform_real_distribution(n.lower, n.upper)(random));
    const Table fast = table(x), slow = design_table(s, x, columns);
    for (const std::string& key : columns) {
      const Column *a = fast.find(key), *b = slow.find(key);
      ASSERT_TRUE(a && b) << key;
      double size = 0;
      for (double v : b->values) size = std::max(size, std::abs(v));
      for (std::size_t i = 0; i < a->values.size(); ++i)
        // Sums of some ten terms of this size.
        EXPECT_NEAR(a->values[i], b->values[i], 1e-12 * size) << key << " row " << i;
    }
  }
}

TEST(BalancingMasses, TablesOfAFourBar) { expect_same_tables(balancing_study(test::four_bar_masses)); }
TEST(BalancingMasses, TablesOfALinkage) { expect_same_tables(balancing_study(test::linkage_weights)); }
TEST(BalancingMasses, TablesOfASliderCrank) { expect_same_tables(balancing_study(test::engine)); }
TEST(BalancingMasses, TablesOfAnArm) { expect_same_tables(balancing_study(test::arm_weights)); }

TEST(BalancingMasses, WhatIsNoMassIsSaid) {
  std::string why;
  EXPECT_FALSE(
      mass_study(balancing_study(test::replaced(test::four_bar_masses, "crank_m   = 0.1",
                                                "crank_m = { min = 0.1, max = 0.2, initial = 0.1 }")),
                 why));
  EXPECT_EQ(why, "'parameters.crank_m' is not a mass");
  EXPECT_FALSE(
      mass_study(balancing_study(test::replaced(test::linkage_weights, "mass_kg   = 0.36",
                                                "mass_kg   = { min = 0.1, max = 1.0, initial = 0.36 }")),
                 why));
  EXPECT_EQ(why, "the inertia of 'crank' follows from its mass; give it as a number");
  EXPECT_FALSE(
      mass_study(balancing_study(test::replaced(test::linkage_weights, "second = \"crank.O\"",
                                                "second = \"crank.O\"\nfriction = 0.1\npin_radius_mm = 5")),
                 why));
  EXPECT_EQ(why, "joint 'O' has friction, which is not linear in the masses");
}

std::string why_not_convex(const std::string& text) {
  const BalancingStudy s = balancing_study(text);
  std::string why;
  const auto masses = mass_study(s, why);
  if (!masses) return why;
  const BalancingProblem p = balancing_problem(test::task_of(s));
  return exact_balancing(masses, p, why) ? "convex" : why;
}

TEST(BalancingMasses, WhatIsNotConvexIsSaid) {
  using test::replaced;
  EXPECT_EQ(why_not_convex(test::four_bar_masses), "convex");
  EXPECT_EQ(why_not_convex(test::arm_weights), "convex");
  EXPECT_EQ(why_not_convex(test::engine),
            "the angle of 'crank mass 1' is limited; only a fixed one or a full "
            "turn is convex");
  const std::string rectangle = replaced(test::linkage_weights, "at_mm   = [-80, 0]",
                                         "at_mm = [{ min = -80, max = 0, initial = -80 }, "
                                         "{ min = -20, max = 20, initial = 0 }]");
  EXPECT_EQ(why_not_convex(rectangle), "convex");
  EXPECT_EQ(why_not_convex(replaced(test::four_bar_masses, "measure  = \"rms\"", "measure = \"range\"")),
            "range is not convex");
  EXPECT_EQ(
      why_not_convex(
          test::four_bar_masses +
          "[[constraint]]\nquantity = \"O1_drive_torque_N_m\"\nmeasure = \"max_abs\"\nat_most = 99.0\n"),
      "constraints beyond caps on the objectives are not part of the cone programme");
}

TEST(BalancingMasses, TheProgrammeAndTheGradientComeToTheSame) {
  using test::replaced;
  const std::string rectangle = replaced(test::linkage_weights, "at_mm   = [-80, 0]",
                                         "at_mm = [{ min = -80, max = 20, initial = -80 }, "
                                         "{ min = -20, max = 20, initial = 0 }]");
  for (const std::string& text :
       {test::four_bar_masses, test::arm_weights, test::linkage_weights, rectangle}) {
    BalancingStudy s = balancing_study(text);
    std::string why;
    const auto masses = mass_study(s, why);
    const BalancingProblem p = balancing_problem(test::task_of(s));
    const ExactBalancing exact = exact_balancing(masses, p, why);
    ASSERT_TRUE(exact) << why;
    for (Combine combine : {Combine::mean, Combine::largest}) {
      s.optimiser.combine = combine;
      RunContext context;
      s.optimiser.method = RecommendedBalancing();
      const BalancingRun convex = balance(p, s.optimiser, exact, 1, "", false, context);
      s.optimiser.method = GradientBalancing();
      const BalancingRun gradient = balance(p, s.optimiser, exact, 1, "", false, context);
      ASSERT_EQ(convex.designs.size(), 1u);
      ASSERT_EQ(gradient.designs.size(), 1u);
      EXPECT_THAT(convex.designs[0].proof, HasSubstr("global optimum")) << text;
      EXPECT_EQ(convex.evaluations, 1);
      // The arm ends at a kink, where a gradient search stops a little above.
      EXPECT_NEAR(gradient.designs[0].cost / convex.designs[0].cost, 1, 1e-5);
      EXPECT_GE(gradient.designs[0].cost, convex.designs[0].cost * (1 - 1e-9));
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
