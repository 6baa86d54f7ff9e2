// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::ElementsAre;

const Value& computed(const char* id) { return at(published_case("planar-machines.json", id), "computed"); }
double angle_in(const Linkage& l, const LinkagePlan& p, const LinkageMotion& m, const char* body) {
  return angle_of(body_state(p, m, body_index(l, body)).direction);
}
void add_block(Linkage& l, const std::string& name, const char* point) {
  add_body(l, name, {{point, {0, 0}}});
}

// A crank moves the carriage of a pinion between a fixed rack below and a moving one above.
Linkage stroke_doubler() {
  Linkage l = grounded({{"O", {0, 0}}, {"L", {0.25, -0.02}}, {"U", {0.25, 0.02}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "C", 0.2);
  add_block(l, "carriage", "C");
  add_block(l, "pinion", "C");
  add_block(l, "upper", "U");
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "C", "rod.C", "carriage.C");
  add_slide(l, "guide", "ground.O", "carriage.C");
  add_pin(l, "axle", "carriage.C", "pinion.C");
  add_slide(l, "way", "ground.U", "upper.U");
  add_rack(l, "fixed rack", "pinion.C", "ground.L", 0.02);
  // The pinion lies to the right of the moving rack, which is over it.
  add_rack(l, "moving rack", "pinion.C", "upper.U", -0.02);
  add_drive(l, "O");
  set_mode(l, "rod", "carriage", AssemblyMode::plus);
  return l;
}
// A driven pinion moves a rack over many turns.
Linkage driven_rack() {
  Linkage l = grounded({{"O", {0, 0}}, {"L", {0, -0.03}}});
  add_block(l, "pinion", "O");
  add_block(l, "bar", "L");
  add_pin(l, "O", "ground.O", "pinion.O");
  add_slide(l, "way", "ground.L", "bar.L");
  add_rack(l, "teeth", "pinion.O", "bar.L", 0.03);
  add_drive(l, "O");
  return l;
}
// A wheel on a crank rolls on a rack that slides through a block on the ground. Nothing of it is closed.
Linkage tilted_rack() {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.3, 0}}});
  add_bar(l, "crank", "O", "P", 0.1);
  add_body(l, "bar", {{"L", {0, 0}}, {"E", {0.3, 0}}, {"back", {0, 0.02}}});
  add_block(l, "shoe", "P");
  add_block(l, "block", "C");
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "shoe", "crank.P", "shoe.P");
  add_slide(l, "back", "shoe.P", "bar.back");
  add_pin(l, "C", "ground.C", "block.C");
  add_slide(l, "guide", "block.C", "bar.L");
  add_rack(l, "teeth", "crank.P", "bar.L", 0.02, 0, 0.3);
  add_drive(l, "O");
  set_start(l, "bar", {0.1, -0.02}, 0.1), set_start(l, "shoe", {0.1, 0}, 0.1);
  set_start(l, "block", {0.3, 0}, 0.1);
  return l;
}

TEST(PairRows, AStrokeDoublerMovesItsRackTwiceAsFar) {
  Linkage l = stroke_doubler();
  const LinkagePlan p = planned(l);
  EXPECT_TRUE(p.closed_form());
  LinkageMotion m(p);
  double pinion = 0, from = 0;
  for (const Value& row : at(computed("rack-stroke-doubler"), "rows").as_array()) {
    const std::vector<double> v = numbers(row);
    solve_motion(p, std::vector<InputMotion>{{math::radians(v[0]), 1, 0}}, m);
    ASSERT_EQ(m.status, Status::done);
    EXPECT_NEAR(place_of(l, p, m, "pinion.C").x, v[1], 1e-15);
    if (v[0] == 0) from = place_of(l, p, m, "upper.U").x, pinion = angle_in(l, p, m, "pinion");
    EXPECT_NEAR(place_of(l, p, m, "upper.U").x - from, v[2], 1e-14);
    EXPECT_NEAR(math::wrap_angle(angle_in(l, p, m, "pinion") - pinion - v[3]), 0, 1e-12);
    EXPECT_LE(open_joints(l, p, m), 1e-14);
  }
}

TEST(PairRows, ADrivenPinionMovesItsRackOverManyTurns) {
  Linkage l = driven_rack();
  without_mass(l);
  l.forces.push_back({.name = "load", .point = point_named(l, "bar.L"), .force = {-50, 0}});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  for (const double turns : {0.0, 10.25, -3.5}) {
    solve_motion(p, std::vector<InputMotion>{{turns * full_turn, 2, 3}}, m);
    ASSERT_EQ(m.status, Status::done);
    EXPECT_NEAR(place_of(l, p, m, "bar.L").x, 0.03 * turns * full_turn, 1e-14);
    EXPECT_NEAR(body_state(p, m, 2).velocity.x, 0.06, 1e-15);
    EXPECT_NEAR(body_state(p, m, 2).acceleration.x, 0.09, 1e-15);
    LinkageForces f;
    solve_forces(l, p, m, 0, 0, f);
    EXPECT_NEAR(f.drives[0], 1.5, 1e-13);
    // The rack is pushed with 50 N and pressed away from the pinion by tan 20 deg of it.
    EXPECT_NEAR(f.joints[2].tangential, 50, 1e-12);
    EXPECT_NEAR(f.joints[2].force.y, -50 * std::tan(math::radians(20)), 1e-12);
    EXPECT_NEAR(f.joints[0].force.y, -50 * std::tan(math::radians(20)), 1e-12);
    EXPECT_LE(unbalance(l, p, m, f), 1e-12);
  }
}

// Rates and accelerations agree with differences of positions, and everything with the route that solves all
// parts at once.
void agrees(Linkage l, const std::vector<double>& angles) {
  set_uniform_all(l, 3);
  const LinkagePlan p = planned(l), q = planned(l, PlanRoute::all_at_once);
  ASSERT_EQ(q.groups.size(), 1u);
  LinkageMotion m(p), n(q), low(p), high(p);
  LinkageForces f, g;
  for (const double angle : angles) {
    const double h = 1e-5;
    const auto solve = [&](double t, LinkageMotion& motion) {
      motion.parts = m.parts;
      solve_motion(p, std::vector<InputMotion>{{angle + 2 * t + 0.75 * t * t, 2 + 1.5 * t, 1.5}}, motion);
      ASSERT_EQ(motion.status, Status::done);
    };
    solve_motion(p, std::vector<InputMotion>{{angle, 2, 1.5}}, m);
    ASSERT_EQ(m.status, Status::done) << angle;
    solve(-h, low), solve(h, high);
    for (std::size_t k = 1; k < m.parts.size(); ++k) {
      const PartState<double>&a = low.parts[k], &b = m.parts[k], &c = high.parts[k];
      EXPECT_NEAR(angle_of(rotate_inverse(a.direction, c.direction)) / (2 * h), b.speed, 1e-7) << p.parts[k];
      EXPECT_NEAR((c.speed - a.speed) / (2 * h), b.angular_acceleration, 1e-6) << p.parts[k];
      EXPECT_LE(norm((1 / (2 * h)) * (c.origin - a.origin) - b.velocity), 1e-7) << p.parts[k];
      EXPECT_LE(norm((1 / (2 * h)) * (c.velocity - a.velocity) - b.acceleration), 1e-6) << p.parts[k];
    }
    EXPECT_LE(open_joints(l, p, m), 1e-12);
    n.parts = m.parts;
    for (std::size_t k = 1; k < n.parts.size(); ++k)
      n.parts[k].direction = rotate(n.parts[k].direction, math::unit(1e-3));
    solve_motion(q, std::vector<InputMotion>{{angle, 2, 1.5}}, n);
    ASSERT_EQ(n.status, Status::done);
    for (std::size_t k = 1; k < m.parts.size(); ++k) {
      EXPECT_LE(norm(n.parts[k].direction - m.parts[k].direction), 1e-11) << p.parts[k];
      EXPECT_LE(norm(n.parts[k].acceleration - m.parts[k].acceleration), 1e-9) << p.parts[k];
    }
    solve_forces(l, p, m, 0, 0, f);
    solve_forces(l, q, n, 0, 0, g);
    const double small = 1e-10 * (1 + largest_force(f));
    EXPECT_LE(unbalance(l, p, m, f), small);
    EXPECT_LE(unbalance(l, q, n, g), small);
    EXPECT_NEAR(f.drive_power + f.weight_power + f.load_power, f.kinetic_power, 10 * small);
    for (std::size_t k = 0; k < f.joints.size(); ++k)
      EXPECT_LE(norm(f.joints[k].force - g.joints[k].force), small) << l.joints[k].name;
    for (std::size_t k = 0; k < f.strands.size(); ++k)
      EXPECT_NEAR(f.strands[k].tangential, g.strands[k].tangential, small) << k;
  }
}
TEST(PairRows, RacksAgreeWithDifferencesAndWithAllAtOnce) {
  agrees(stroke_doubler(), {0.4, 1.3, 2.9, 4.4});
  agrees(driven_rack(), {0.4, 1.3, 12.9});
  agrees(tilted_rack(), {0.4, 1.3, 2.2, 2.9, -1});
}

TEST(PairRows, RacksThatDoNothingAreNamed) {
  Linkage l = driven_rack();
  add_drive(l, "way");
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("joint.teeth: a redundant constraint: 'pinion' and 'bar' are placed without the rack "
                  "already; leave the rack or a drive out"));
  l = driven_rack();
  l.joints.back().radius = 0;
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("joint.teeth: its pinion has the radius 0; give the distance of its centre from the "
                  "pitch line, negative to the right of its direction"));
}

// ---- belts
// ---------------------------------------------------------------------------------------------------

Belt belt_over(const Linkage& l, const char* carrier, const std::vector<const char*>& wheels,
               const std::vector<double>& radii) {
  Belt belt{.name = "belt", .carrier = carrier ? body_index(l, carrier) : -1};
  for (std::size_t i = 0; i < wheels.size(); ++i)
    belt.wheels.push_back({point_named(l, wheels[i]), std::abs(radii[i]), radii[i] < 0 ? -1.0 : 1.0});
  return belt;
}
// A pulley that is fixed to the ground, and one at the end of an arm that turns about it.
Linkage belt_on_arm(double radius) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "arm", "O", "H", 0.3);
  add_bar(l, "head", "H", "tip", 0.3);
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "H", "arm.H", "head.H");
  l.belts.push_back(belt_over(l, "arm", {"ground.O", "head.H"}, {0.04, radius}));
  add_drive(l, "O");
  return l;
}
TEST(PairRows, BeltsOnAnArmTurnItsHead) {
  const Value& wanted = computed("belt-on-arm");
  const auto head = [&](double radius, bool tip) {
    const Linkage l = belt_on_arm(radius);
    const LinkagePlan p = planned(l);
    LinkageMotion m(p);
    solve_motion(p, std::vector<InputMotion>{{math::radians(50), 1, 0}}, m);
    if (tip) {
      EXPECT_NEAR(place_of(l, p, m, "head.tip").x, numbers(at(wanted, "straight_line_tip_m"))[0], 1e-15);
      EXPECT_NEAR(place_of(l, p, m, "head.tip").y, 0, 1e-15);
    }
    return math::degrees(angle_in(l, p, m, "head"));
  };
  EXPECT_NEAR(head(0.04, false), number_at(wanted, "open_equal_radius_head_angle_deg"), 1e-12);
  EXPECT_NEAR(head(-0.04, false), number_at(wanted, "crossed_equal_radius_head_angle_deg"), 1e-12);
  EXPECT_NEAR(head(0.02, true), number_at(wanted, "open_half_radius_head_angle_deg"), 1e-12);
}

// Two pulleys on the ground.
Linkage two_pulleys(double tension) {
  Linkage l = grounded({{"A", {0, 0}}, {"B", {0.4, 0}}});
  add_block(l, "first", "A");
  add_block(l, "second", "B");
  add_pin(l, "A", "ground.A", "first.A");
  add_pin(l, "B", "ground.B", "second.B");
  l.belts.push_back(belt_over(l, "ground", {"first.A", "second.B"}, {0.1, 0.05}));
  l.belts[0].tension = tension;
  add_drive(l, "A");
  return l;
}
TEST(PairRows, StrandsOfABeltShareItsTension) {
  const Value& wanted = computed("belt-tensions");
  Linkage l = two_pulleys(100);
  without_mass(l);
  // The belt turns the second wheel with -1.5 N m where the first one is driven with 3 N m.
  l.torques.push_back({.name = "load", .body = 2, .torque = number_at(wanted, "torque_on_wheel_2_N_m")});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  solve_motion(p, std::vector<InputMotion>{{0.4, 1, 0}}, m);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.drives[0], 3, 1e-13);
  ASSERT_EQ(f.strands.size(), 2u);
  const double tight = std::max(f.strands[0].tangential, f.strands[1].tangential),
               slack = std::min(f.strands[0].tangential, f.strands[1].tangential);
  EXPECT_NEAR(tight, number_at(wanted, "tight_N"), 1e-12);
  EXPECT_NEAR(slack, number_at(wanted, "slack_N"), 1e-12);
  // Both strands pull the wheels towards each other, with the cosine of the angle of the strands.
  const double cosine = std::sqrt(0.4 * 0.4 - 0.05 * 0.05) / 0.4;
  EXPECT_NEAR(f.joints[0].force.x, -200 * cosine, 1e-12);
  EXPECT_NEAR(f.joints[1].force.x, 200 * cosine, 1e-12);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);

  l.belts[0].tension.reset();
  solve_forces(l, planned(l), m, 0, 0, f);
  EXPECT_NEAR(f.strands[0].tangential + f.strands[1].tangential, 0, 1e-12);
  EXPECT_NEAR(std::abs(f.strands[0].tangential), 15, 1e-12);
}

// A weight on a rope over a loose pulley that hangs in two strands.
Linkage hoist() {
  Linkage l = grounded({{"A", {-0.1, 0}}, {"D", {0.1, 0}}, {"W", {0, -0.4}}, {"S", {0.5, 0.3}}});
  add_block(l, "drum", "D");
  add_body(l, "hook", {{"C", {0, 0}}});
  add_block(l, "sheave", "C");
  for (const auto& [name, x, y] : {std::tuple{"drum", 0.1, 0.0}, {"hook", 0.0, -0.4}, {"sheave", 0.0, -0.4}})
    set_start(l, name, {x, y}, 0);
  add_pin(l, "D", "ground.D", "drum.D");
  add_slide(l, "fall", "ground.W", "hook.C", pi / 2, pi / 2);
  add_pin(l, "C", "hook.C", "sheave.C");
  // Down from A, under the sheave and up to the drum: the sheave lies to the left, and so does the drum.
  l.belts.push_back(belt_over(l, nullptr, {"ground.A", "sheave.C", "drum.D"}, {0, 0.06, 0.04}));
  l.belts[0].closed = false;
  add_drive(l, "D");
  return l;
}
// A closed belt between pulleys on the ground with an idler on a lever, which its spring pulls.
Linkage tensioner(double stiffness) {
  Linkage l = grounded({{"A", {0, 0}}, {"B", {0.5, 0.05}}, {"L", {0.25, -0.25}}, {"S", {0.1, -0.2}}});
  add_block(l, "first", "A");
  add_block(l, "second", "B");
  add_body(l, "lever", {{"L", {0, 0}}, {"I", {0.02, 0.16}}});
  add_block(l, "idler", "I");
  set_start(l, "first", {0, 0}, 0), set_start(l, "second", {0.5, 0.05}, 0);
  set_start(l, "lever", {0.25, -0.25}, 0), set_start(l, "idler", {0.27, -0.09}, 0);
  add_pin(l, "A", "ground.A", "first.A");
  add_pin(l, "B", "ground.B", "second.B");
  add_pin(l, "L", "ground.L", "lever.L");
  add_pin(l, "I", "lever.I", "idler.I");
  l.belts.push_back(belt_over(l, nullptr, {"first.A", "idler.I", "second.B"}, {0.1, -0.03, 0.07}));
  l.springs.push_back({.name = "spring",
                       .first = point_named(l, "ground.S"),
                       .second = point_named(l, "lever.I"),
                       .stiffness = stiffness});
  add_drive(l, "A");
  return l;
}
TEST(PairRows, BeltsAndRopesAgreeWithDifferencesAndWithAllAtOnce) {
  agrees(belt_on_arm(0.04), {0.4, 1.3, 2.9, 4.4});
  agrees(belt_on_arm(-0.015), {0.4, 1.3});
  agrees(two_pulleys(80), {0.4, 1.3});
  agrees(hoist(), {0.0, 0.4, 1.3, -0.7});
  agrees(tensioner(900), {0.0, 0.4, 0.9});
}
TEST(PairRows, ALooseSheaveTakesTwiceTheTension) {
  Linkage l = hoist();
  without_mass(l);
  l.forces.push_back({.name = "load", .point = point_named(l, "hook.C"), .force = {0, -500}});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  solve_motion(p, std::vector<InputMotion>{{0, 1, 0}}, m);
  ASSERT_EQ(m.status, Status::done);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.strands[0].tangential, f.strands[1].tangential, 1e-11);
  EXPECT_NEAR(f.strands[0].tangential * 0.04, std::abs(f.drives[0]), 1e-12);
  EXPECT_NEAR(f.drive_power, 500 * body_state(p, m, body_index(l, "hook")).velocity.y, 1e-11);
  EXPECT_LE(unbalance(l, p, m, f), 1e-11);
}
TEST(PairRows, BeltsThatCannotBeAreNamed) {
  // A belt between a wheel on the ground and one on a crank's coupler.
  Linkage l = grounded({{"O", {0, 0}}, {"Q", {-0.3, 0}}});
  add_bar(l, "crank", "O", "A", 0.1);
  add_block(l, "wheel", "A");
  add_block(l, "motor", "Q");
  set_start(l, "crank", {0, 0}, 0), set_start(l, "wheel", {0.1, 0}, 0), set_start(l, "motor", {-0.3, 0}, 0);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "wheel.A");
  add_pin(l, "Q", "ground.Q", "motor.Q");
  l.belts.push_back(belt_over(l, nullptr, {"motor.Q", "wheel.A"}, {0.05, 0.05}));
  add_drive(l, "O");
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("belt.belt: belt 'belt' cannot stay tight: no body holds both 'motor.Q' and 'wheel.A', "
                  "whose distance changes; join both wheels to one body by pins, add an idler on a "
                  "spring, or write a rope"));
  l.belts[0].closed = false;
  l.belts[0].wheels[0].radius = 0.5;
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("belt.belt: wheels of belt 'belt' overlap; move them apart; crossed belts need more "
                  "than the sum of both radii"));
  l.bodies[1].start.reset();
  EXPECT_THAT(planning_problems(l),
              ElementsAre("belt.belt: wheels of belt 'belt' overlap; move them apart; crossed "
                          "belts need more than the sum of both radii"));
  l.bodies[2].start.reset();
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("belt.belt: the length of 'belt' is not known; draw the linkage (drawn = true), or give "
                  "the bodies of its wheels a start"));
}

// ---- wheels that are not circular
// ---------------------------------------------------------------------------------------

// Equal ellipses that turn about a focus each: the angle of the second wheel by that of the first.
double elliptical(double first, double eccentricity) {
  const double turns = std::round(first / full_turn), rest = first - turns * full_turn;
  return -2 * std::atan((1 + eccentricity) / (1 - eccentricity) * std::tan(rest / 2)) - turns * full_turn;
}
Linkage elliptical_wheels(int rows) {
  Linkage l = grounded({{"A", {0, 0}}, {"B", {0.2, 0}}});
  add_block(l, "first", "A");
  add_block(l, "second", "B");
  add_pin(l, "A", "ground.A", "first.A");
  add_pin(l, "B", "ground.B", "second.B");
  add_gear(l, "ellipses", "first", "second", -1);
  RatioCurve curve;
  for (int k = 0; k <= rows; ++k) {
    curve.first.push_back(full_turn * k / rows);
    curve.second.push_back(elliptical(curve.first.back(), 0.4));
  }
  l.joints.back().curve = std::move(curve);
  add_drive(l, "A");
  return l;
}
TEST(PairRows, EllipticalWheelsHaveTheirRatio) {
  const Linkage l = elliptical_wheels(72), fine = elliptical_wheels(720);
  const LinkagePlan p = planned(l), q = planned(fine);
  EXPECT_TRUE(p.closed_form());
  LinkageMotion m(p), n(q);
  for (const Value& row : at(computed("gear-elliptical"), "rows").as_array()) {
    const std::vector<double> v = numbers(row);
    for (const int turns : {0, 1, -7}) {
      const std::vector<InputMotion> in{{math::radians(v[0]) + turns * full_turn, 1, 0}};
      solve_motion(p, in, m), solve_motion(q, in, n);
      ASSERT_EQ(m.status, Status::done);
      EXPECT_NEAR(math::wrap_angle(angle_in(l, p, m, "second") + math::radians(v[1])), 0, 1e-5) << v[0];
      EXPECT_NEAR(body_state(p, m, 2).speed, -v[2], 1e-5 * v[2]) << v[0];
      EXPECT_NEAR(body_state(q, n, 2).speed, -v[2], 1e-10) << v[0];
    }
  }
}
TEST(PairRows, WheelsThatAreNotCircularPressAtTheirPitchPoint) {
  Linkage l = elliptical_wheels(72);
  without_mass(l);
  l.torques.push_back({.name = "load", .body = 2, .torque = 3});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  for (const double angle : {0.3, 2.0, 4.0}) {
    solve_motion(p, std::vector<InputMotion>{{angle, 1, 0}}, m);
    solve_forces(l, p, m, 0, 0, f);
    const double ratio = body_state(p, m, 2).speed;
    EXPECT_NEAR(f.drives[0], -3 * ratio, 1e-12);
    const double second_radius = 0.2 / (1 - ratio);
    EXPECT_NEAR(f.joints[2].point.x, 0.2 - second_radius, 1e-14);
    EXPECT_NEAR(std::abs(f.joints[2].tangential), 3 / second_radius, 1e-11);
    EXPECT_LE(unbalance(l, p, m, f), 1e-11);
  }
}
// The ellipses in a four-bar whose rocker turns the first of them: a sector.
Linkage curve_on_rocker() {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.6, 0}}, {"Q", {0.7, 0.1}}});
  add_bar(l, "crank", "O", "A", 0.1);
  add_bar(l, "coupler", "A", "B", 0.4);
  add_bar(l, "rocker", "C", "B", 0.32);
  add_body(l, "wheel", {{"Q", {0, 0}}, {"tip", {0.1, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "C", "ground.C", "rocker.C");
  add_pin(l, "Q", "ground.Q", "wheel.Q");
  add_gear(l, "wheels", "rocker", "wheel", -1, 0.2);
  l.joints.back().curve = RatioCurve{{1.8, 2.2, 2.6, 3.2}, {0, -0.5, -1.2, -2.5}};
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  return l;
}
TEST(PairRows, CurvesAgreeWithDifferencesAndWithAllAtOnce) {
  agrees(elliptical_wheels(72), {0.4, 1.3, 2.9, 4.4, 9.5});
  agrees(curve_on_rocker(), {0.4, 1.3, 2.9, 4.4});
}
TEST(PairRows, CurvesThatCannotBeAreNamed) {
  Linkage l = elliptical_wheels(12);
  l.joints[2].curve->second[3] = 0;
  EXPECT_THAT(planning_problems(l),
              ElementsAre("joint.ellipses: its ratio curve turns back behind row 3; the first "
                          "angles rise, the second ones all rise or all fall"));
  l = elliptical_wheels(12);
  l.joints[2].curve->second.back() -= 1;
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("joint.ellipses: 'second' turns by -1.15915 turns for one of 'first': the wheels do not "
                  "come back; a curve over a whole turn ends a whole number of turns on"));
}

}  // namespace
}  // namespace linkwright::planar
