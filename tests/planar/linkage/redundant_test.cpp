// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/redundant.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace test;
using math::Vec2;
using std::complex;
using testing::HasSubstr;

// Three wheels on one line that rods couple, with their cranks at an angle; every rod 90 deg behind the one
// before.
Linkage wheels(double angle, int rods, double error = 0) {
  const double place[] = {0, 1.0, 2.3};
  Linkage l = grounded({{"A1", place[0]}, {"A2", place[1]}, {"A3", place[2]}});
  const complex<double> turn = std::polar(1.0, angle);
  for (int w = 0; w < 3; ++w) {
    const std::string i = std::to_string(w + 1);
    std::vector<LinkagePoint> points{{"A", {0, 0}}};
    for (int r = 0; r < rods; ++r)
      points.push_back({"P" + std::to_string(r), 0.2 * std::polar(1.0, r * pi / 2)});
    add_body(l, "w" + i, points);
    add_pin(l, "axle w" + i, "ground.A" + i, "w" + i + ".A");
    set_start(l, "w" + i, place[w], angle);
  }
  for (int r = 0; r < rods; ++r) {
    const std::string rod = "rod " + std::to_string(r);
    add_body(l, rod, {{"Q1", place[0]}, {"Q2", place[1]}, {"Q3", place[2] + error}});
    set_start(l, rod, 0.2 * std::polar(1.0, r * pi / 2) * turn, 0);
    for (int w = 1; w <= 3; ++w)
      add_pin(l, "pin " + std::to_string(r) + " w" + std::to_string(w),
              "w" + std::to_string(w) + ".P" + std::to_string(r), rod + ".Q" + std::to_string(w));
  }
  add_drive(l, "axle w1");
  return l;
}

std::vector<PartState<double>> starts(const Linkage& l) {
  std::vector<PartState<double>> out{{{0, 0}, {1, 0}, {0, 0}, 0, {0, 0}, 0}};
  for (std::size_t b = 1; b < l.bodies.size(); ++b)
    out.push_back({{l.bodies[b].start->x, l.bodies[b].start->y},
                   math::unit(l.bodies[b].start->angle),
                   {0, 0},
                   0,
                   {0, 0},
                   0});
  return out;
}

TEST(Redundant, WithoutJointsThereIsNoRank) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "bar", {{"A", {0, 0}}, {"B", {1, 0}}});
  for (LinkageBody& body : l.bodies) body.start = math::Pose{};
  const std::vector<PartState<double>> bodies(2);
  EXPECT_FALSE(constraint_rank(l, 1, bodies));
  std::string why;
  EXPECT_FALSE(relax_redundant(l, why));
}

TEST(Redundant, RanksOfCoupledWheelsAreThoseOfTheReference) {
  const Value& wanted = at(published_case("planar-machines.json", "coupled-wheels"), "computed.ranks");
  const struct {
    const char* id;
    double angle;
    int rods;
  } cases[] = {{"one_rod_40_deg", 40, 1},
               {"one_rod_0_deg", 0, 1},
               {"two_rods_at_90_deg_40_deg", 40, 2},
               {"two_rods_at_90_deg_0_deg", 0, 2}};
  for (const auto& c : cases) {
    const Linkage l = wheels(c.angle * pi / 180, c.rods);
    const auto rank = constraint_rank(l, size_of(l), starts(l));
    ASSERT_TRUE(rank);
    EXPECT_EQ(rank->coordinates, number_at(wanted, std::string(c.id) + ".coordinates")) << c.id;
    EXPECT_EQ(rank->equations, number_at(wanted, std::string(c.id) + ".equations"));
    EXPECT_EQ(rank->rank, number_at(wanted, std::string(c.id) + ".rank"));
    EXPECT_EQ(rank->freedoms(), number_at(wanted, std::string(c.id) + ".freedoms"));
    EXPECT_EQ(rank->redundant(), number_at(wanted, std::string(c.id) + ".redundant"));
  }
}

TEST(Redundant, CoupledWheelsMoveWithForcesOfLeastSquares) {
  const Value& c = at(published_case("planar-machines.json", "coupled-wheels"), "computed");
  Linkage l = wheels(40 * pi / 180, 1);
  without_mass(l);
  l.torques.push_back({"brake 2", body_index(l, "w2"), 0, -100});
  l.torques.push_back({"brake 3", body_index(l, "w3"), 0, -150});
  ASSERT_FALSE(plan_linkage(l).problems.empty());
  std::string why;
  const auto relaxed = relax_redundant(l, why);
  ASSERT_TRUE(relaxed) << why;
  EXPECT_EQ(relaxed->drawn.joints_in_stress().size(), 6u);
  // The self-stress lies along the cranks.
  const std::vector<double>& stress = relaxed->drawn.self_stress[0];
  const std::vector<double> ratio = numbers(at(c, "self_stress_along_cranks_ratio"));
  const Vec2 crank = math::unit(40 * pi / 180);
  for (int w = 0; w < 3; ++w) {
    const std::size_t row = 6 + 2 * index(w);  // rows of the pins of the rod follow those of the axles
    EXPECT_NEAR(cross(crank, {stress[row], stress[row + 1]}), 0, 1e-12);
    EXPECT_NEAR(dot(crank, {stress[row], stress[row + 1]}) / dot(crank, {stress[6], stress[7]}),
                ratio[index(w)], 1e-9);
  }
  const Linkage& open = relaxed->linkage;
  LinkageMotion motion(relaxed->plan);
  LinkageForces forces;
  // All around, but for the change points.
  for (int i = 0; i < 24; ++i) {
    const InputMotion in{relaxed->plan.drawn_inputs[0] + i * pi / 30, 1, 0};
    solve_motion(relaxed->plan, std::span(&in, 1), motion);
    ASSERT_EQ(motion.status, Status::done) << i;
    EXPECT_LT(relaxed_gap(open, relaxed->plan, motion, relaxed->joint), 1e-12);
    solve_forces(open, relaxed->plan, motion, 0, in.value, forces);
    EXPECT_NEAR(forces.drives[0], number_at(c, "drive_torque_N_m"), 1e-9);
    if (i > 0) continue;
    spread_forces(open, relaxed->plan, motion, relaxed->joint, RedundantForces::least_squares, forces);
    for (const Value::Member& pin : at(c, "least_squares_all_pins_N").as_object()) {
      const int j = joint_index(open, pin.key);
      const std::vector<double> wanted = numbers(pin.value);
      // Of the wheel on the rod, and of the ground on the wheel.
      const bool turned = open.bodies[index(open.joints[index(j)].first.body)].name == "rod 0";
      const Vec2 force = forces.joints[index(j)].force;
      EXPECT_NEAR(turned ? -force.x : force.x, wanted[0], 1e-7) << pin.key;
      EXPECT_NEAR(turned ? -force.y : force.y, wanted[1], 1e-7) << pin.key;
    }
  }
}

// A rod on three parallel cranks of 150 mm.
Linkage three_cranks() {
  Linkage l = grounded({{"A", 0}, {"M", 0.25}, {"B", 0.6}});
  const complex<double> crank = std::polar(0.15, 1.0);
  for (const char* name : {"A", "M", "B"}) {
    add_bar(l, std::string("crank ") + name, "foot", "top", 0.15);
    add_pin(l, name, std::string("ground.") + name, std::string("crank ") + name + ".foot");
    set_start(l, std::string("crank ") + name, l.bodies[0].points[index(point_index(l.bodies[0], name))].at,
              1.0);
  }
  add_body(l, "rod", {{"A", 0}, {"M", 0.25}, {"B", 0.6}, {"F", 0.4}});
  set_start(l, "rod", crank, 0);
  for (const char* name : {"A", "M", "B"})
    add_pin(l, std::string("pin ") + name, std::string("crank ") + name + ".top", std::string("rod.") + name);
  add_drive(l, "A");
  return l;
}

TEST(Redundant, MiddleCrankOfAParallelogramIsTaken) {
  const Linkage l = three_cranks();
  EXPECT_EQ(mobility(l), number_at(published_case("planar-machines.json", "parallelogram-with-middle-crank"),
                                   "computed.gruebler"));
  std::string why;
  const auto relaxed = relax_redundant(l, why);
  ASSERT_TRUE(relaxed) << why;
  EXPECT_EQ(relaxed->drawn.rank, 11);
  EXPECT_EQ(relaxed->drawn.redundant(), 1);
}

// The rod is a rigid beam on three parallel springs: the elongations of the cranks lie on a straight line.
TEST(Redundant, CranksThatGiveWayShareALoadAsSpringsDo) {
  Linkage l = three_cranks();
  without_mass(l);
  const char* names[] = {"A", "M", "B"};
  const double x[] = {0, 0.25, 0.6}, stiffness[] = {1e6, 3e6, 2e6}, load = 100;
  for (int i = 0; i < 3; ++i)
    l.bodies[index(body_index(l, std::string("crank ") + names[i]))].stiffness = stiffness[i];
  const int rod = body_index(l, "rod");
  l.forces.push_back({.name = "load", .point = {rod, 3}, .force = load * std::polar(1.0, 1.0)});
  std::string why;
  const auto relaxed = relax_redundant(l, why);
  ASSERT_TRUE(relaxed) << why;
  EXPECT_TRUE(gives_way(l, relaxed->drawn));
  EXPECT_FALSE(gives_way(three_cranks(), relaxed->drawn));
  LinkageMotion motion(relaxed->plan);
  LinkageForces forces;
  const InputMotion in{relaxed->plan.drawn_inputs[0], 0, 0};
  solve_motion(relaxed->plan, std::span(&in, 1), motion);
  solve_forces(relaxed->linkage, relaxed->plan, motion, 0, in.value, forces);
  spread_forces(relaxed->linkage, relaxed->plan, motion, relaxed->joint, RedundantForces::compliance, forces);
  // Forces k (a + b x) with the sum of the load and its moment about A.
  double k0 = 0, k1 = 0, k2 = 0;
  for (int i = 0; i < 3; ++i) k0 += stiffness[i], k1 += stiffness[i] * x[i], k2 += stiffness[i] * x[i] * x[i];
  const double determinant = k0 * k2 - k1 * k1, a = load * (k2 - 0.4 * k1) / determinant,
               b = load * (0.4 * k0 - k1) / determinant;
  for (int i = 0; i < 3; ++i) {
    const int j = joint_index(relaxed->linkage, std::string("pin ") + names[i]);
    const LinkageJoint& pin = relaxed->linkage.joints[index(j)];
    const double on_rod = pin.second.body == rod ? 1 : -1;
    const Vec2 force = on_rod * forces.joints[index(j)].force;
    EXPECT_NEAR(dot(force, math::unit(1.0)), -stiffness[i] * (a + b * x[i]), 1e-9) << names[i];
    EXPECT_NEAR(cross(force, math::unit(1.0)), 0, 1e-9);
  }
}

TEST(Redundant, EqualComplianceOfAllJointsIsLeastSquares) {
  Linkage l = wheels(40 * pi / 180, 1);
  without_mass(l);
  for (LinkageJoint& j : l.joints) j.compliance = 2e-7;
  l.torques.push_back({.name = "brake 2", .body = body_index(l, "w2"), .torque = -100});
  l.torques.push_back({.name = "brake 3", .body = body_index(l, "w3"), .torque = -150});
  std::string why;
  const auto relaxed = relax_redundant(l, why);
  ASSERT_TRUE(relaxed) << why;
  LinkageMotion motion(relaxed->plan);
  const InputMotion in{relaxed->plan.drawn_inputs[0] + 0.3, 1, 0};
  solve_motion(relaxed->plan, std::span(&in, 1), motion);
  LinkageForces squares, energy;
  for (auto* forces : {&squares, &energy}) {
    solve_forces(relaxed->linkage, relaxed->plan, motion, 0, in.value, *forces);
    spread_forces(relaxed->linkage, relaxed->plan, motion, relaxed->joint,
                  forces == &squares ? RedundantForces::least_squares : RedundantForces::compliance, *forces);
  }
  for (std::size_t j = 0; j < squares.joints.size(); ++j)
    EXPECT_LT(norm(squares.joints[j].force - energy.joints[j].force), 1e-9);
}

// A third crank that is longer, but parallel to the others in the drawing: it can move for an instant alone.
TEST(Redundant, LinkageThatLocksIsNamed) {
  Linkage l = wheels(40 * pi / 180, 1);
  l.bodies[index(body_index(l, "w3"))].points[1].at = 0.25;
  l.bodies[index(body_index(l, "rod 0"))].points[2].at = 2.3 + 0.05 * std::polar(1.0, 40 * pi / 180);
  EXPECT_EQ(constraint_rank(l, size_of(l), starts(l))->redundant(), 1);
  std::string why;
  EXPECT_FALSE(relax_redundant(l, why));
  EXPECT_THAT(why, HasSubstr("the linkage cannot move: with the drive 0.003 away from the drawing"));
}

// Where the third crank is not parallel the joints are a rigid structure.
TEST(Redundant, RigidLinkageIsLeftToThePlan) {
  Linkage l = wheels(40 * pi / 180, 1);
  const complex<double> foot{2.3, 0.05}, top = 2.3 + 0.2 * std::polar(1.0, 40 * pi / 180);
  l.bodies[0].points[2].at = foot;
  l.bodies[index(body_index(l, "w3"))].points[1].at = (top - foot) * std::polar(1.0, -40 * pi / 180);
  set_start(l, "w3", foot, 40 * pi / 180);
  EXPECT_EQ(constraint_rank(l, size_of(l), starts(l))->freedoms(), 0);
  std::string why;
  EXPECT_FALSE(relax_redundant(l, why));
  EXPECT_EQ(why, "");
}

}  // namespace
}  // namespace linkwright::planar
