// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/sweep.h"
#include "planar/linkage_cases.h"

// Pins of several links: which pairs of links their joints name changes nothing.
namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::UnorderedElementsAre;

using Pairs = std::vector<std::pair<std::string, std::string>>;

// A press whose pin C holds the rod, the upper link, the lower link with its ram, and a link to a second ram.
Linkage press(const Pairs& at_c) {
  Linkage l = grounded({{"A", {0, 0}}, {"D", {0.15, 0.1}}, {"E", {0.15, -0.1}}, {"F", {0.3, 0}}});
  add_bar(l, "crank", "A", "B", 0.036);
  add_bar(l, "rod", "B", "C", 0.12);
  add_bar(l, "upper", "D", "C", 0.1);
  add_bar(l, "lower", "C", "E", 0.1);
  add_body(l, "ram", {{"E", {0, 0}}});
  add_bar(l, "side", "C", "F", 0.16);
  add_body(l, "slider", {{"F", {0, 0}}});
  add_pin(l, "A", "ground.A", "crank.A");
  add_pin(l, "B", "crank.B", "rod.B");
  int k = 0;
  for (const auto& [first, second] : at_c) add_pin(l, "C" + std::to_string(++k), first + ".C", second + ".C");
  add_pin(l, "D", "ground.D", "upper.D");
  add_pin(l, "E", "lower.E", "ram.E");
  add_slide(l, "guide", "ground.E", "ram.E", pi / 2, pi / 2);
  add_pin(l, "F", "side.F", "slider.F");
  add_slide(l, "rail", "ground.F", "slider.F", 0, 0);
  add_drive(l, "A");
  set_mode(l, "rod", "upper", AssemblyMode::minus);
  set_mode(l, "lower", "ram", AssemblyMode::minus);
  set_mode(l, "side", "slider", AssemblyMode::plus);
  set_uniform_all(l, 5);
  set_uniform(l, "ram", 2);
  return l;
}

// All sixteen trees over four links.
std::vector<Pairs> trees() {
  const std::array<std::string, 4> links{"rod", "upper", "lower", "side"};
  std::vector<Pairs> out;
  for (int i = 0; i < 4; ++i)  // by their Pruefer sequences
    for (int k = 0; k < 4; ++k) {
      std::array<int, 4> degree{1, 1, 1, 1};
      ++degree[at(i)], ++degree[at(k)];
      Pairs pairs;
      for (const int inner : {i, k})
        for (int leaf = 0; leaf < 4; ++leaf)
          if (degree[at(leaf)] == 1) {
            pairs.emplace_back(links[at(inner)], links[at(leaf)]);
            --degree[at(leaf)], --degree[at(inner)];
            break;
          }
      std::vector<std::string> last;
      for (int n = 0; n < 4; ++n)
        if (degree[at(n)] == 1) last.push_back(links[at(n)]);
      pairs.emplace_back(last.at(0), last.at(1));
      out.push_back(std::move(pairs));
    }
  return out;
}

std::vector<std::string> names_of(const LinkagePlan& plan) {
  std::vector<std::string> out;
  for (const Group& g : plan.groups) out.push_back(g.name + " " + std::string(traits_of(g).name));
  return out;
}

TEST(SharedPins, AreFoundAsDyadsHoweverTheyAreWritten) {
  for (const Pairs& pairs : trees()) {
    const LinkagePlan plan = planned(press(pairs));
    EXPECT_TRUE(plan.closed_form());
    EXPECT_THAT(names_of(plan), UnorderedElementsAre("crank driver", "rod + upper RRR", "lower + ram RRP",
                                                     "side + slider RRP"));
    EXPECT_EQ(input_limits(plan, std::vector<double>{0}, 0, -pi, pi).circuits,
              input_limits(planned(press(trees()[0])), std::vector<double>{0}, 0, -pi, pi).circuits);
  }
  // Pairs that need no other are kept.
  EXPECT_TRUE(planned(press({{"rod", "upper"}, {"upper", "lower"}, {"rod", "side"}})).shared_pins.empty());
}

// The forces in the joints as they are written, beside those of all bodies at once, which know no pairs.
TEST(SharedPins, CarryTheForcesOfTheJointsAsTheyAreWritten) {
  int other = 0;
  for (const Pairs& pairs : trees()) {
    const Linkage l = press(pairs);
    const LinkagePlan plan = planned(l), whole = plan_linkage(l, PlanRoute::all_at_once).plan;
    other += !plan.shared_pins.empty();
    for (const double angle : {0.4, 1.9, 3.3, 5.1}) {
      const std::vector<InputMotion> in{{angle, 7, -3}};
      LinkageMotion m(plan), n(whole);
      solve_motion(plan, in, m);
      ASSERT_EQ(m.status, Status::done);
      n.parts = m.parts;
      solve_position(whole, in, n);
      solve_velocity(whole, in, n);
      solve_acceleration(whole, in, n);
      LinkageForces f, g;
      solve_forces(l, plan, m, 0, angle, f);
      solve_forces(l, whole, n, 0, angle, g);
      ASSERT_EQ(f.status, Status::done);
      ASSERT_EQ(g.status, Status::done);
      double largest = 0;
      for (const JointReaction& r : g.joints) largest = std::max(largest, norm(r.force));
      for (std::size_t j = 0; j < l.joints.size(); ++j) {
        EXPECT_NEAR(f.joints[j].force.x, g.joints[j].force.x, 1e-10 * largest) << l.joints[j].name;
        EXPECT_NEAR(f.joints[j].force.y, g.joints[j].force.y, 1e-10 * largest) << l.joints[j].name;
        EXPECT_NEAR(f.joints[j].moment, g.joints[j].moment, 1e-10 * largest) << l.joints[j].name;
      }
    }
  }
  EXPECT_GT(other, 5);
}

TEST(SharedPins, AreTheSameInSweepsOfManySamples) {
  for (const Pairs& pairs : trees()) {
    const Linkage l = press(pairs);
    const LinkagePlan plan = planned(l);
    std::vector<double> angle;
    for (int i = 0; i < 37; ++i) angle.push_back(0.17 * i);
    const double rate[] = {7}, acceleration[] = {-3};
    LinkageSweep sweep(l, plan, {.rates = true, .forces = true});
    const SweepInput input{angle, rate, acceleration};
    sweep.run(std::span(&input, 1));
    for (std::size_t i = 0; i < angle.size(); ++i) {
      LinkageMotion m(plan);
      LinkageForces f;
      solve_motion(plan, std::vector<InputMotion>{{angle[i], 7, -3}}, m);
      solve_forces(l, plan, m, 0, angle[i], f);
      for (std::size_t j = 0; j < l.joints.size(); ++j) {
        EXPECT_NEAR(sweep.joint(static_cast<int>(j), JointRow::force_x)[i], f.joints[j].force.x, 1e-8);
        EXPECT_NEAR(sweep.joint(static_cast<int>(j), JointRow::force_y)[i], f.joints[j].force.y, 1e-8);
      }
    }
  }
}

// Two links hang on a pin of a link that has its place, and nothing else holds them: the plan says so and
// ends.
TEST(SharedPins, OfLinksThatNothingElseHoldsAreLeftAlone) {
  Linkage l = grounded({{"A", {0, 0}}, {"D", {1, 0}}});
  add_bar(l, "crank", "A", "B", 0.3);
  add_bar(l, "first", "B", "C", 0.5);
  add_bar(l, "second", "B", "C", 0.5);
  add_pin(l, "A", "ground.A", "crank.A");
  add_pin(l, "B1", "crank.B", "first.B");
  add_pin(l, "B2", "first.B", "second.B");
  add_drive(l, "A");
  EXPECT_FALSE(plan_linkage(l).problems.empty());
}

}  // namespace
}  // namespace linkwright::planar
