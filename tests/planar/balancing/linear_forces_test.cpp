// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/linear_forces.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/serial_arm/serial_arm.h"
#include "planar/reactions_cases.h"
#include "planar/serial_arm_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using linkwright::test::message;
using test::any_angle;
using test::at;
using test::between;
using test::dynamics_case;
using ::testing::HasSubstr;

std::vector<BaseParameters> bases(const std::vector<LinkMass>& links) {
  std::vector<BaseParameters> out;
  for (const LinkMass& m : links) out.push_back(base_parameters(m));
  return out;
}

// Superposition of other masses on the published four-bar, to 1e-9 N of some 400 N.
TEST(LinearForces, OfAFourBarSuperpose) {
  const test::Machine m = test::machine(at(dynamics_case("published-case3-H-CS-FA"), "inputs"));
  std::vector<double> angle;
  for (int i = 0; i <= 200; ++i) angle.push_back(2 * pi * i / 200);
  const double speed[] = {10 * pi}, acceleration[] = {30};
  const LinearForces forces =
      linear_forces({m.linkage, {}}, 9.81, {.value = angle, .rate = speed, .acceleration = acceleration});
  ASSERT_EQ(forces.status, Status::done);
  const std::vector<BaseParameters> links = bases({m.masses.crank, m.masses.coupler, m.masses.rocker});
  const std::size_t order[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 11};  // order of `quantities`
  for (std::size_t c = 0; c < forces.components.size(); ++c) {
    const std::vector<double> got = values(forces, forces.components[c].name, links);
    for (std::size_t i = 0; i < angle.size(); i += 7) {
      const FourBarReactions r =
          reactions(m.linkage, m.masses, rates(m.linkage, angle[i], speed[0], acceleration[0]), 9.81);
      EXPECT_NEAR(got[i], test::quantities(r)[order[c]], 1e-9) << forces.components[c].name << " " << i;
    }
  }
  // The magnitude of a joint force.
  const std::vector<double> size = values(forces, "O1_N", links);
  const FourBarReactions first = reactions(m.linkage, m.masses, rates(m.linkage, 0, 10 * pi, 30), 9.81);
  EXPECT_NEAR(size[0], std::abs(first.ground_on_crank), 1e-9);
}

RC_GTEST_PROP(LinearForcesProperty, OfAnArmEqualItsReactions, ()) {
  const std::size_t n = *rc::gen::inRange<std::size_t>(1, 5);
  const SerialArm arm = test::any_arm(n);
  std::vector<math::Motion> motion = test::any_motion(n);
  const std::vector<math::Motion> second = test::any_motion(n);
  motion.insert(motion.end(), second.begin(), second.end());
  const LinearForces forces = linear_forces(arm, motion, 9.81);
  const auto all = elements(arm);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<ArmLinkRates> r(n);
    std::vector<ArmJointLoads> loads(n);
    rates(all, arm.base, std::span(motion).subspan(i * n, n), r);
    reactions(all, r, 9.81, loads);
    double size = 1;
    for (const ArmJointLoads& l : loads) size = std::max({size, std::abs(l.force), std::abs(l.joint_torque)});
    for (std::size_t k = 0; k < n; ++k) {
      const auto value = [&](const std::string& key) {
        const std::string of = (key.ends_with("_N") ? "O" : "link") + std::to_string(k + 1);
        return values(forces, of + key, bases(forces.initial))[i];
      };
      // Some hundred roundings, columns of lengths and masses that differ by two orders.
      RC_ASSERT(std::abs(value("_x_N") - loads[k].force.real()) <= 1e-11 * size);
      RC_ASSERT(std::abs(value("_y_N") - loads[k].force.imag()) <= 1e-11 * size);
      RC_ASSERT(std::abs(value("_torque_absolute_N_m") - loads[k].absolute_torque) <= 1e-11 * size);
      RC_ASSERT(std::abs(value("_torque_joint_N_m") - loads[k].joint_torque) <= 1e-11 * size);
    }
  }
}

// Any linkage with springs, loads, welded bodies and attached masses: the same as solving for the forces of
// the masses themselves.
void expect_linkage(const Linkage& linkage, const std::vector<int>& bodies, std::vector<InputMotion> inputs) {
  const PlanResult planned = plan_linkage(linkage);
  ASSERT_TRUE(planned.problems.empty());
  const LinearForces forces = linear_forces(linkage, planned.plan, bodies, inputs);
  ASSERT_EQ(forces.status, Status::done);
  // Other masses than those that the columns were made with.
  Linkage other = linkage;
  std::vector<BaseParameters> links;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const LinkMass m{1.5 + static_cast<double>(k), 0.3, 0.2, 0.7 * static_cast<double>(k)};
    links.push_back(base_parameters(m));
    other.bodies[static_cast<std::size_t>(bodies[k])].mass =
        BodyMass{m.mass, m.inertia, std::polar(m.centre_distance, m.centre_angle)};
  }
  const LinkagePlan with = plan_linkage(other).plan;
  LinkageMotion motion(with);
  LinkageForces f;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    solve_motion(with, std::span(inputs).subspan(i, 1), motion);
    solve_forces(other, with, motion, 0, inputs[i].value, f);
    double size = 1;
    for (const JointReaction& r : f.joints) size = std::max({size, norm(r.force), std::abs(r.moment)});
    const auto expect = [&](const std::string& name, double expected) {
      EXPECT_NEAR(values(forces, name, links)[i], expected, 1e-10 * size) << name << " at " << i;
    };
    for (std::size_t j = 0; j < linkage.joints.size(); ++j) {
      expect(identifier(linkage.joints[j].name) + "_x_N", f.joints[j].force.x);
      expect(identifier(linkage.joints[j].name) + "_y_N", f.joints[j].force.y);
      expect(identifier(linkage.joints[j].name) + "_moment_N_m", f.joints[j].moment);
    }
    expect("shaking_force_x_N", f.shaking_force.x);
    expect("shaking_force_N", norm(f.shaking_force));
    expect("shaking_moment_N_m", f.shaking_moment);
    expect("shaking_moment_with_drive_N_m", f.shaking_moment_with_drive);
    expect(identifier(linkage.joints[static_cast<std::size_t>(linkage.driven[0])].name) +
               (with.rotary[0] ? "_drive_torque_N_m" : "_drive_force_N"),
           f.drives[0]);
  }
}

TEST(LinearForces, OfAnyLinkageEqualItsReactions) {
  for (const char* name : {"toggle_press", "jansen_leg", "slider_crank", "triad"}) {
    SCOPED_TRACE(name);
    const LinkageSample& sample = linkage_sample(name);
    Linkage linkage = sample.linkage;
    linkage.springs.push_back({"spring", {0, 0}, {1, 0}, 300, 0.01, 2});
    linkage.bodies[1].attached.push_back({"weight", 0.7, {0.03, -0.02}});
    std::vector<InputMotion> inputs;
    for (int i = 0; i < 5; ++i)
      inputs.push_back({sample.from[0] + (sample.to[0] - sample.from[0]) * 0.02 * i, sample.speed, 3});
    expect_linkage(linkage, {1, static_cast<int>(linkage.bodies.size()) - 1}, inputs);
  }
}

TEST(LinearForces, OfWeldedBodies) {
  Linkage linkage = grounded({{"O", {0, 0}}});
  add_bar(linkage, "arm", "O", "E", 0.4);
  add_body(linkage, "head", {{"E", {0.1, 0}}});
  add_pin(linkage, "O", "ground.O", "arm.O");
  add_weld(linkage, "E", "arm.E", "head.E", 0.4);
  add_drive(linkage, "O");
  set_uniform(linkage, "arm", 2);
  expect_linkage(linkage, {1, 2}, {{0.3, 2, 5}, {1.3, 4, -5}});
}

TEST(LinearForces, TellWhereThereIsNoMotion) {
  const double angle[] = {0, 1, 2}, speed[] = {1};
  const FourBar stuck{.ground = 1, .crank = 0.7, .coupler = 0.5, .rocker = 0.6};
  const LinearForces forces = linear_forces({stuck, {}}, 9.81, {.value = angle, .rate = speed});
  EXPECT_EQ(forces.status, Status::no_assembly);
  EXPECT_EQ(forces.failed_sample, 2U);
}

TEST(LinearForces, TellWhatIsWrong) {
  const double angle[] = {0}, speed[] = {1};
  const LinearForces forces = linear_forces({FourBar{}, {}}, 0, {.value = angle, .rate = speed});
  EXPECT_THAT(message([&] { quantity(forces, "O5_x_N"); }),
              HasSubstr("there is no quantity 'O5_x_N'; there are O1_x_N, O1_y_N"));
  EXPECT_THAT(message([&] { values(forces, "O1_N", {}); }), HasSubstr("0 base parameters for 3 links"));
  Linkage linkage = linkage_sample("slider_crank").linkage;
  const LinkagePlan p = plan_linkage(linkage).plan;
  const InputMotion input[] = {{0.1, 1, 0}};
  const int ground[] = {0}, twice[] = {1, 1};
  EXPECT_THAT(message([&] { linear_forces(linkage, p, ground, input); }),
              HasSubstr("body 0 of 4 has no mass to choose"));
  EXPECT_THAT(message([&] { linear_forces(linkage, p, twice, input); }), HasSubstr("is given twice"));
  linkage.joints[0].friction = 0.1;
  EXPECT_THAT(message([&] { linear_forces(linkage, p, {}, input); }),
              HasSubstr("has friction, with which forces are not linear in the masses"));
}

}  // namespace
}  // namespace linkwright::planar
