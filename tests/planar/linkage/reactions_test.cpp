// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/general.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/linkage_changes.h"
#include "planar/linkages.h"
#include "planar/reactions_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;

BodyMass body_mass(const LinkMass& m) {
  return {m.mass, m.inertia, std::polar(m.centre_distance, m.centre_angle)};
}
Linkage linkage_of(const FourBar& b, const FourBarMasses& masses, double gravity) {
  Linkage l = test::linkage_of(b);
  l.bodies[1].mass = body_mass(masses.crank);
  l.bodies[2].mass = body_mass(masses.coupler);
  l.bodies[3].mass = body_mass(masses.rocker);
  l.gravity = {0, -gravity};
  return l;
}

// Joint forces along the groups against those of all equations at once; both against Newton and Euler for
// each body; and the powers against each other. Relative to the largest joint force and, for moments and
// powers, the size of the linkage and its speed.
TEST(LinkageReactions, AgreeByTwoRoutesForEverySample) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan along = planned(s.linkage), at_once = planned(s.linkage, PlanRoute::all_at_once);
    LinkageMotion m(along), n(at_once);
    LinkageForces f, g;
    double last = 0;
    for (int i = 0; i < 360; ++i) {
      const double share = (i + 0.5) / 360;
      ASSERT_NO_FATAL_FAILURE(go_to(s, along, last, share, m));
      last = share;
      const std::vector<InputMotion> in = inputs_at(s, share, i % 2 ? s.speed : -s.speed, 3.0);
      solve_motion(along, in, m);
      ASSERT_EQ(m.status, Status::done) << "at share " << share;
      solve_forces(s.linkage, along, m, 0, in[0].value, f);
      ASSERT_EQ(f.status, Status::done);
      const double largest = largest_force(f), size = std::max(1.0, along.size);
      EXPECT_LE(unbalance(s.linkage, along, m, f), 1e-10 * largest * size);
      const double fastest = std::abs(in[0].rate) * size;
      EXPECT_NEAR(f.drive_power + f.weight_power + f.load_power, f.kinetic_power, 1e-10 * largest * fastest);
      n.parts = m.parts;
      solve_motion(at_once, in, n);
      ASSERT_EQ(n.status, Status::done);
      solve_forces(s.linkage, at_once, n, 0, in[0].value, g);
      EXPECT_LE(unbalance(s.linkage, at_once, n, g), 1e-10 * largest * size);
      for (std::size_t j = 0; j < f.joints.size(); ++j) {
        EXPECT_LE(norm(f.joints[j].force - g.joints[j].force), 1e-10 * largest) << j;
        EXPECT_NEAR(f.joints[j].moment, g.joints[j].moment, 1e-10 * largest * size) << j;
      }
      for (std::size_t d = 0; d < f.drives.size(); ++d)
        EXPECT_NEAR(f.drives[d], g.drives[d], 1e-10 * largest * size);
      EXPECT_LE(norm(f.shaking_force - g.shaking_force), 1e-10 * largest);
      EXPECT_NEAR(f.shaking_moment, g.shaking_moment, 1e-10 * largest * size);
    }
  }
}

// The kinetic energy, momentum and angular momentum of the bodies, differentiated in time by their values
// alone, against the kinetic power, the shaking force less the weight, and the shaking moment less its
// moment.
TEST(LinkageReactions, GiveTheRatesOfEnergyAndMomentum) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    Linkage l = s.linkage;
    l.forces.clear();  // without loads on the ground: they would be no part of the balance
    const LinkagePlan p = planned(l);
    LinkageMotion m(p), n(p);
    LinkageForces f;
    double last = 0;
    for (int i = 0; i < 12; ++i) {
      const double share = (i + 0.4) / 12.5;
      ASSERT_NO_FATAL_FAILURE(go_to(s, p, last, share, m));
      last = share;
      const std::vector<InputMotion> start = inputs_at(s, share, 2, 3);
      const std::vector<PartState<double>> places = m.parts;
      const auto values = [&](std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
        const double t = x[0];
        std::vector<InputMotion> in = start;
        for (InputMotion& k : in)
          k = {k.value + k.rate * t + 0.5 * k.acceleration * t * t, k.rate + k.acceleration * t,
               k.acceleration};
        n.parts = places;
        solve_motion(p, in, n);
        const Momenta now = momenta(l, p, n);
        r[0] = now.kinetic_energy, r[1] = now.momentum.x, r[2] = now.momentum.y, r[3] = now.angular;
        if (jacobian.empty()) return n.status == Status::done;
        solve_forces(l, p, n, 0, 0, f);
        const math::Vec2 weight = now.mass * math::vec(l.gravity);
        jacobian[0] = f.kinetic_power;
        jacobian[1] = weight.x - f.shaking_force.x;
        jacobian[2] = weight.y - f.shaking_force.y;
        jacobian[3] = cross(now.first_moment, math::vec(l.gravity)) - f.shaking_moment_with_drive;
        return n.status == Status::done;
      };
      const std::vector<double> now{0}, scale{0.05};
      const math::JacobianCheck check = math::check_jacobian(values, 4, now, scale);
      EXPECT_TRUE(check.passed) << "share " << share << " row " << check.row << ": " << check.analytic
                                << " against " << check.numeric << ": off by " << check.deviation << " of "
                                << check.tolerance;
    }
  }
}

TEST(LinkageReactions, TurnAndMirrorWithTheLinkage) {
  for (const LinkageSample& sample : linkage_samples()) {
    SCOPED_TRACE(sample.name);
    const LinkageSample s = apply(Change{}, sample);  // without loads that go by places
    const LinkagePlan p = planned(s.linkage);
    for (const Change& c : {Change{0.9, {0.3, -0.2}, false}, Change{0.4, {0, 0}, true}}) {
      const LinkageSample changed = apply(c, s);
      const LinkagePlan q = planned(changed.linkage);
      LinkageMotion m(p), n(q);
      LinkageForces f, g;
      ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, 0.21, m));
      ASSERT_NO_FATAL_FAILURE(go_to(changed, q, 0, 0.21, n));
      const std::vector<InputMotion> in = inputs_at(s, 0.21, s.speed, 2);
      solve_motion(p, in, m);
      solve_motion(q, apply(c, s.linkage, in), n);
      solve_forces(s.linkage, p, m, 0, in[0].value, f);
      solve_forces(changed.linkage, q, n, 0, in[0].value, g);
      const double largest = largest_force(f), near = 1e-11 * largest;
      for (std::size_t k = 0; k < f.joints.size(); ++k)
        EXPECT_LE(norm(c.vector(f.joints[k].force) - g.joints[k].force), near);
      EXPECT_LE(norm(c.vector(f.shaking_force) - g.shaking_force), near);
      EXPECT_NEAR(c.sense() * f.drives[0], g.drives[0], near);
      EXPECT_NEAR(f.drive_power, g.drive_power, near * s.speed);
    }
  }
}

// ---- against the closed form of the four-bar

RC_GTEST_PROP(LinkageReactionsOfAFourBar, AgreeWithItsClosedForm, ()) {
  const FourBar b = *turning_four_bar();
  const FourBarMasses masses = *any_masses();
  const double angle = *any_angle(), speed = *between(-5, 5), acceleration = *between(-9, 9),
               gravity = *between(0, 20);
  const FourBarRates r = rates(b, angle, speed, acceleration);
  RC_PRE(r.status == Status::done && std::abs(r.transmission_sine) > 1e-2);
  const FourBarReactions known = reactions(b, masses, r, gravity);
  const Linkage l = linkage_of(b, masses, gravity);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{b.frame_angle + angle, speed, acceleration}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, in[0].value, f);
  RC_ASSERT(f.status == Status::done);
  const double size = b.ground + b.crank + b.coupler + b.rocker,
               ratio = size / std::min({b.crank, b.coupler, b.rocker, b.ground}),
               largest = largest_force(known) + (masses.crank.mass + masses.coupler.mass) * gravity,
               s = std::abs(r.transmission_sine);
  // Rounding of places 1e-15 size, times 1 / s a derivative and once for the forces.
  const double near = 1e-14 * ratio * ratio / (s * s * s) * largest;
  RC_ASSERT(norm(f.joints[0].force - math::vec(known.ground_on_crank)) <= near);
  RC_ASSERT(norm(f.joints[1].force - math::vec(known.crank_on_coupler)) <= near);
  RC_ASSERT(norm(f.joints[2].force - math::vec(known.rocker_on_coupler)) <= near);
  RC_ASSERT(norm(f.joints[3].force - math::vec(known.ground_on_rocker)) <= near);
  RC_ASSERT(norm(f.shaking_force - math::vec(known.shaking_force)) <= 2 * near);
  const double moment = near * (size + masses.crank.centre_distance + masses.coupler.centre_distance) +
                        1e-13 * (masses.crank.inertia + 5 * 9) * std::abs(acceleration);
  RC_ASSERT(std::abs(f.drives[0] - known.drive_torque) <= moment);
  // About O instead of the global origin.
  const double lever = cross(math::vec(crank_pivot(b)), f.shaking_force);
  const double wide = moment + near * (std::abs(b.pivot_x) + std::abs(b.pivot_y));
  RC_ASSERT(std::abs(f.shaking_moment - lever - known.shaking_moment) <= 2 * wide);
  RC_ASSERT(std::abs(f.shaking_moment_with_drive - lever - known.shaking_moment_with_drive) <= 3 * wide);
}

// The published four-bar, its crank and rocker given the mass moments that balance the coupler.
TEST(LinkageReactions, OfABalancedFourBarShakeNothing) {
  const Machine machine = test::machine(at(dynamics_case("fourbar-initial-samples"), "inputs"));
  FourBar b = machine.linkage;
  FourBarMasses masses = machine.masses;
  const std::complex<double> coupler =
      masses.coupler.mass * std::polar(masses.coupler.centre_distance, masses.coupler.centre_angle);
  const auto set = [](LinkMass& m, std::complex<double> moment) {
    m.centre_distance = std::abs(moment) / m.mass;
    m.centre_angle = std::arg(moment);
  };
  set(masses.crank, coupler * b.crank / b.coupler - masses.coupler.mass * b.crank);
  set(masses.rocker, -coupler * b.rocker / b.coupler);
  const Linkage l = linkage_of(b, masses, 9.81);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const double weight = 9.81 * (masses.crank.mass + masses.coupler.mass + masses.rocker.mass);
  for (int i = 0; i < 72; ++i) {
    const std::vector<InputMotion> in{{2 * pi * i / 72, 10 * pi, 50}};
    solve_motion(p, in, m);
    solve_forces(l, p, m, 0, 0, f);
    EXPECT_NEAR(f.shaking_force.x, 0, 1e-10);
    EXPECT_NEAR(f.shaking_force.y, -weight, 1e-10);
    EXPECT_GT(largest_force(f), 1);  // the joints are loaded all the same
  }
}

TEST(LinkageReactions, DoNotFeelTheInertiaOfASteadyCrank) {
  const LinkageSample& s = linkage_sample("jansen_leg");
  Linkage l = s.linkage;
  const LinkagePlan p = planned(l);
  l.bodies[1].mass->inertia += 7;
  const LinkagePlan q = planned(l);
  LinkageMotion m(p);
  LinkageForces f, g;
  const std::vector<InputMotion> in{{1.0, 3, 0}};
  solve_motion(p, in, m);
  solve_forces(s.linkage, p, m, 0, 0, f);
  solve_forces(l, q, m, 0, 0, g);
  EXPECT_EQ(f.drives[0], g.drives[0]);
  EXPECT_EQ(f.shaking_force.x, g.shaking_force.x);
}

// Forces are linear in mass, first moment and inertia about the origin of each body; of gears without a
// pressure angle, by which teeth press apart whichever way they push.
TEST(LinkageReactions, AreLinearInTheBaseParameters) {
  for (const char* name : {"jansen_leg", "triad", "whitworth", "geared_five_bar", "inverted_slider_crank"}) {
    SCOPED_TRACE(name);
    LinkageSample s = linkage_sample(name);
    for (LinkageJoint& j : s.linkage.joints) j.pressure_angle = 0;
    LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p);
    ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, 0.3, m));
    const std::vector<InputMotion> in = inputs_at(s, 0.3, s.speed, 4);
    solve_motion(p, in, m);
    LinkageForces base, sum;
    solve_forces(s.linkage, p, m, 0, 0, base);
    const std::vector<PartMass> masses = p.masses;
    std::vector<math::Vec2> joints(base.joints.size(), {0, 0});
    double drive = 0;
    for (std::size_t k = 1; k < masses.size(); ++k)
      for (int what = 0; what < 4; ++what) {
        std::fill(p.masses.begin(), p.masses.end(), PartMass{});
        PartMass& one = p.masses[k];
        if (what == 0) one.mass = masses[k].mass;
        if (what == 1) one.moment.x = masses[k].moment.x;
        if (what == 2) one.moment.y = masses[k].moment.y;
        if (what == 3) one.inertia = masses[k].inertia;
        solve_forces(s.linkage, p, m, 0, 0, sum);
        for (std::size_t j = 0; j < joints.size(); ++j) joints[j] = joints[j] + sum.joints[j].force;
        drive += sum.drives[0];
      }
    const double near = 1e-12 * largest_force(base);
    for (std::size_t j = 0; j < joints.size(); ++j)
      EXPECT_LE(norm(joints[j] - base.joints[j].force), near) << j;
    EXPECT_NEAR(drive, base.drives[0], near);
  }
}

// Statics: an arm that holds itself and a payload.
TEST(LinkageReactions, HoldTheirWeightAtRest) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "upper", "O", "A", 2);
  add_bar(l, "lower", "A", "B", 1);
  add_pin(l, "shoulder", "ground.O", "upper.O");
  add_pin(l, "elbow", "upper.A", "lower.A");
  add_drive(l, "shoulder");
  add_drive(l, "elbow");
  set_uniform(l, "upper", 4);
  set_uniform(l, "lower", 2);
  l.bodies[2].attached.push_back({"load", 3, {1, 0}});
  l.gravity = {0, -10};
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{0, 0, 0}, {pi / 3, 0, 0}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.joints[1].force.y, 50, 1e-13);
  EXPECT_NEAR(f.joints[0].force.y, 90, 1e-13);
  EXPECT_NEAR(f.drives[1], 20 * 0.25 + 30 * 0.5, 1e-13);
  EXPECT_NEAR(f.drives[0], 40 * 1 + 20 * 2.25 + 30 * 2.5, 1e-12);
  EXPECT_EQ(f.drives[0], f.joints[0].moment);
  EXPECT_NEAR(f.shaking_moment_with_drive, -f.drives[0], 1e-12);
  EXPECT_NEAR(f.shaking_moment, 0, 1e-12);  // the joint force alone acts at the origin
  EXPECT_EQ(f.drive_power, 0);
  EXPECT_EQ(f.weight_power, 0);
}

// ---- joints of other kinds

// A crank with a weld in its middle, turned steadily without gravity: the weld carries the centripetal force
// of what lies beyond it, and the drive's moment is none.
TEST(LinkageReactions, OfAWeldCarryWhatLiesBeyondIt) {
  for (const bool other_way : {false, true}) {
    SCOPED_TRACE(other_way);
    Linkage l = grounded({{"O", {0, 0}}});
    add_bar(l, "inner", "O", "end", 0.5);
    add_body(l, "outer", {{"start", {0, 0}}, {"end", {0, 0.3}}});
    add_pin(l, "O", "ground.O", "inner.O");
    if (other_way)
      add_weld(l, "weld", "outer.start", "inner.end", pi / 2);
    else
      add_weld(l, "weld", "inner.end", "outer.start", -pi / 2);  // outer's y axis along inner's x axis
    add_drive(l, "O");
    l.bodies[1].mass = BodyMass{1, 0.1, {0.2, 0}};
    l.bodies[2].mass = BodyMass{2, 0.05, {0.04, 0.1}};
    l.gravity = {0, -10};
    const LinkagePlan p = planned(l);
    LinkageMotion m(p);
    LinkageForces f;
    const double angle = 0.7, speed = 3, acceleration = 5;
    const std::vector<InputMotion> in{{angle, speed, acceleration}};
    solve_motion(p, in, m);
    solve_forces(l, p, m, 0, 0, f);
    EXPECT_LE(unbalance(l, p, m, f), 1e-13);
    // Along and across the bar: the mass centre of `outer` at 0.6 along, -0.04 across.
    const std::complex<double> u = std::polar(1.0, angle), c = u * std::complex<double>(0.6, -0.04),
                               a = std::complex<double>(-speed * speed, acceleration) * c;
    const std::complex<double> force = 2.0 * (a + std::complex<double>(0, 10));
    const std::complex<double> arm = c - 0.5 * u;
    const double moment = 0.05 * acceleration + (std::conj(arm) * force).imag();
    const double side = other_way ? -1 : 1;
    EXPECT_NEAR(f.joints[1].force.x, side * force.real(), 1e-13);
    EXPECT_NEAR(f.joints[1].force.y, side * force.imag(), 1e-13);
    EXPECT_NEAR(f.joints[1].moment, side * moment, 1e-13);
  }
}
// A post welded to the ground carries a pin of the mechanism.
TEST(LinkageReactions, OfAWeldToTheGroundCarryTheRest) {
  for (const bool other_way : {false, true}) {
    Linkage l = grounded({{"foot", {0.2, 0}}});
    add_bar(l, "post", "foot", "top", 1);
    add_bar(l, "bar", "O", "end", 0.6);
    if (other_way)
      add_weld(l, "weld", "post.foot", "ground.foot", -pi / 2);
    else
      add_weld(l, "weld", "ground.foot", "post.foot", pi / 2);
    add_pin(l, "O", "post.top", "bar.O");
    add_drive(l, "O");
    set_uniform(l, "post", 5);
    set_uniform(l, "bar", 2);
    l.gravity = {0, -10};
    const LinkagePlan p = planned(l);
    EXPECT_EQ(p.parts[0], "ground + post");
    LinkageMotion m(p);
    LinkageForces f;
    const std::vector<InputMotion> in{
        {-pi / 2, 0, 0}};  // the drive's angle is from the post: bar to the right
    solve_motion(p, in, m);
    solve_forces(l, p, m, 0, 0, f);
    const double side = other_way ? -1 : 1;
    EXPECT_NEAR(f.joints[0].force.y, side * 70, 1e-12);
    EXPECT_NEAR(f.joints[0].moment, side * 20 * 0.3, 1e-12);
    EXPECT_LE(unbalance(l, p, m, f), 1e-12);
    EXPECT_NEAR(f.shaking_force.y, -70, 1e-12);  // load of the weld
  }
}

// Two wheels on fixed axles: torque times speed is the same on both sides of the gear, but for inertia.
TEST(LinkageReactions, OfAGearBalanceByPower) {
  Linkage l = grounded({{"A", {0, 0}}, {"B", {0.3, 0}}});
  add_body(l, "small", {{"A", {0, 0}}});
  add_body(l, "large", {{"B", {0, 0}}});
  add_pin(l, "A", "ground.A", "small.A");
  add_pin(l, "B", "ground.B", "large.B");
  add_gear(l, "gear", "small", "large", -0.5);
  add_drive(l, "A");
  l.bodies[1].mass = BodyMass{1, 0.02, {0, 0}};
  l.bodies[2].mass = BodyMass{3, 0.3, {0, 0}};
  l.torques.push_back({.name = "load", .body = 2, .torque = 8});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{0.3, 6, 4}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.joints[2].moment, 0.3 * -2 - 8, 1e-13);
  EXPECT_NEAR(f.drives[0], 0.02 * 4 + 0.5 * 8.6, 1e-13);
  EXPECT_NEAR(f.drive_power + f.load_power, f.kinetic_power, 1e-12);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);
}
// A planet on an arm rolls round a fixed sun: its speed is (1 - ratio) times that of the arm.
TEST(LinkageReactions, OfAPlanetGear) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "arm", "O", "C", 0.3);
  add_body(l, "planet", {{"C", {0, 0}}, {"rim", {0.1, 0}}});
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "C", "arm.C", "planet.C");
  add_gear(l, "gear", "ground", "planet", -2, 0, "arm");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{0.3, 6, 4}};
  solve_motion(p, in, m);
  EXPECT_NEAR(body_state(p, m, 2).speed, 18, 1e-14);
  EXPECT_LE(norm(body_state(p, m, 2).direction - math::unit(0.9)), 1e-14);
  EXPECT_LE(open_joints(l, p, m), 1e-14);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);
  EXPECT_NEAR(f.drive_power + f.weight_power, f.kinetic_power, 1e-11);
}

// A sun of 20, planet of 30 and ring of 80 teeth, module 2 mm, 10 N m on the sun, nothing has mass: the teeth
// carry 10 N m / 20 mm = 500 N, the planet's pin both meshes, the sun's bearing one tooth force.
Linkage epicyclic(double pressure_angle) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "sun", {{"O", {0, 0}}});
  add_bar(l, "arm", "O", "C", 0.050);
  add_body(l, "planet", {{"C", {0, 0}}});
  add_pin(l, "sun bearing", "ground.O", "sun.O");
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "C", "arm.C", "planet.C");
  // ring -> planet: 80 / 30, internal; planet -> sun: -30 / 20.
  add_gear(l, "ring mesh", "ground", "planet", 80.0 / 30, 0, "arm");
  add_gear(l, "sun mesh", "planet", "sun", -1.5, 0, "arm");
  add_drive(l, "O");
  for (LinkageBody& b : l.bodies) b.mass = BodyMass{};
  for (LinkageJoint& j : l.joints) j.pressure_angle = pressure_angle;
  l.gravity = 0;
  l.torques.push_back({.name = "motor", .body = 1, .torque = 10});
  return l;
}
TEST(LinkageReactions, TeethLoadTheBearings) {
  for (const double angle : {0.0, 0.7}) {
    SCOPED_TRACE(angle);
    const Linkage l = epicyclic(20 * pi / 180);
    const LinkagePlan p = planned(l);
    LinkageMotion m(p);
    LinkageForces f;
    solve_motion(p, std::vector<InputMotion>{{angle, 1, 0}}, m);
    EXPECT_NEAR(body_state(p, m, 1).speed, 5, 1e-14);
    EXPECT_NEAR(body_state(p, m, 3).speed, -5 / 3.0, 1e-14);
    solve_forces(l, p, m, 0, 0, f);
    const auto force = [&](const char* joint) { return f.joints[index(joint_index(l, joint))]; };
    EXPECT_NEAR(f.drives[0], -50, 1e-12);
    EXPECT_NEAR(std::abs(force("sun mesh").tangential), 500, 1e-11);
    EXPECT_NEAR(std::abs(force("ring mesh").tangential), 500, 1e-11);
    EXPECT_NEAR(norm(force("sun mesh").force), 532.088886, 1e-6);  // 500 / cos 20 deg
    EXPECT_NEAR(norm(force("sun bearing").force), 532.088886, 1e-6);
    EXPECT_NEAR(norm(force("C").force), 1000, 1e-11);  // its outward and inward loads cancel
    EXPECT_LE(unbalance(l, p, m, f), 1e-11);
  }
  const Linkage l = epicyclic(0);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  solve_motion(p, std::vector<InputMotion>{{0, 1, 0}}, m);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(norm(f.joints[0].force), 500, 1e-11);
  EXPECT_NEAR(f.joints[index(joint_index(l, "sun mesh"))].separating, 0, 0);
}
// A planet that rolls about a wheel at rest, arm 2 m, 4/3 N m on the planet of 2 m: 2/3 N at its pin.
TEST(LinkageReactions, APlanetPinCarriesTheToothForce) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "arm", "O", "C", 3);
  add_body(l, "planet", {{"C", {0, 0}}});
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "C", "arm.C", "planet.C");
  add_gear(l, "gear", "ground", "planet", -0.5, 0, "arm");  // radii 1 m and 2 m
  add_drive(l, "O");
  for (LinkageBody& b : l.bodies) b.mass = BodyMass{};
  l.joints.back().pressure_angle = 0;
  l.gravity = 0;
  l.torques.push_back({.name = "load", .body = 2, .torque = 4.0 / 3});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  solve_motion(p, std::vector<InputMotion>{{0.4, 1, 0}}, m);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(norm(f.joints[1].force), 2 / 3.0, 1e-15);
  EXPECT_LE(unbalance(l, p, m, f), 1e-14);
}
TEST(LinkageReactions, GearsWithoutRadiiAreNamed) {
  Linkage l = grounded({{"O", {0, 0}}, {"P", {1, 0}}});
  add_bar(l, "crank", "O", "A", 0.3);
  add_bar(l, "wheel", "P", "B", 0.3);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "P", "ground.P", "wheel.P");
  add_gear(l, "belt", "crank", "wheel", 1);
  add_drive(l, "O");
  EXPECT_EQ(
      planned(l).torque_gears,
      std::vector<std::string>{"'belt': a ratio of 1 is that of no two wheels that mesh; a belt has it, or "
                               "an idler between them"});
  l.joints.back().ratio = -2;
  EXPECT_TRUE(planned(l).torque_gears.empty());
}

// The same gear between bodies that are welded to others, at angles of their own.
TEST(LinkageReactions, OfAPlanetGearBetweenWeldedBodies) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "hub", "O", "end", 0.1);
  add_bar(l, "arm", "start", "C", 0.3);
  add_bar(l, "pointer", "C", "end", 0.2);
  add_body(l, "planet", {{"C", {0, 0}}, {"rim", {0.1, 0}}});
  add_pin(l, "O", "ground.O", "hub.O");
  add_weld(l, "weld", "hub.end", "arm.start", 0.3);
  add_weld(l, "weld 2", "pointer.C", "planet.C", -0.7);
  add_pin(l, "C", "arm.C", "pointer.C");
  add_gear(l, "gear", "ground", "planet", -2, 0.2, "arm");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{0.3, 6, 4}};
  solve_motion(p, in, m);
  // The arm stands at 0.6: the planet at 0.6 - 2 (0 - 0.6) + 0.2.
  EXPECT_LE(norm(body_state(p, m, 4).direction - math::unit(2.0)), 1e-14);
  EXPECT_LE(open_joints(l, p, m), 1e-14);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12 * largest_force(f));
}
TEST(LinkageReactions, OfADrivenSlideStayInTheShakingMoment) {
  Linkage l = grounded({{"guide", {0, 0.5}}});
  add_body(l, "slider", {{"middle", {0, 0}}});
  add_slide(l, "guide", "ground.guide", "slider.middle");
  add_drive(l, "guide");
  l.bodies[1].mass = BodyMass{2, 0, {0, 0}};
  l.gravity = 0;
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{0.1, 0, 3}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.shaking_force.x, -6, 1e-15);
  EXPECT_NEAR(f.shaking_moment, 3, 1e-15);  // -6 N at 0.5 m above the origin
  EXPECT_EQ(f.shaking_moment, f.shaking_moment_with_drive);
}

TEST(LinkageReactions, OfASlotAreNormalToIt) {
  const LinkageSample& s = linkage_sample("whitworth");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  LinkageForces f;
  const int slot = joint_index(s.linkage, "slot");
  for (int i = 0; i < 36; ++i) {
    const std::vector<InputMotion> in{{2 * pi * i / 36, 6, 2}};
    solve_motion(p, in, m);
    solve_forces(s.linkage, p, m, 0, 0, f);
    const JointReaction& r = f.joints[index(slot)];
    const math::Vec2 along = body_state(p, m, body_index(s.linkage, "lever")).direction;
    EXPECT_NEAR(dot(along, r.force), 0, 1e-12 * norm(r.force));
    EXPECT_NEAR(r.moment, 0, 1e-15 * norm(r.force));
    EXPECT_LE(norm(r.point - place_of(s.linkage, p, m, "crank.A")), 1e-15);
  }
}

// ---- loads

// One bar on a pin and a slider, which distinguish springs and forces.
Linkage loaded_bar() {
  Linkage l = grounded({{"O", {0, 0}}, {"hook", {0.3, 0.4}}});
  add_bar(l, "bar", "O", "end", 0.5);
  add_pin(l, "O", "ground.O", "bar.O");
  add_drive(l, "O");
  set_uniform(l, "bar", 2);
  l.gravity = 0;
  return l;
}
double drive_of(const Linkage& l, const InputMotion& in, double time = 0) {
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> inputs{in};
  solve_motion(p, inputs, m);
  solve_forces(l, p, m, time, in.value, f);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12 * (1 + largest_force(f)));
  EXPECT_NEAR(f.drive_power + f.load_power + f.weight_power, f.kinetic_power, 1e-11 * (1 + largest_force(f)));
  return f.drives[0];
}

// The work of the drive against a conservative load is the change of its potential energy.
TEST(LinkageLoads, OfSpringsComeFromTheirEnergy) {
  Linkage l = loaded_bar();
  l.springs.push_back({"spring", {1, 1}, {0, 1}, 200, 0.1, 0});
  l.torsion_springs.push_back({"torsion", 0, 1, 7, 0.2, 0});
  const auto energy = [](double angle) {
    const double length = std::abs(std::polar(0.5, angle) - std::complex<double>(0.3, 0.4));
    return 100 * (length - 0.1) * (length - 0.1) + 3.5 * (angle - 0.2) * (angle - 0.2);
  };
  for (double angle : {-1.0, 0.1, 0.8, 2.0}) {
    // Central difference, step 1e-5: truncation 1e-10 times the third derivative, rounding 1e-16 / 1e-5 x 50.
    const double slope = (energy(angle + 1e-5) - energy(angle - 1e-5)) / 2e-5;
    EXPECT_NEAR(drive_of(l, {angle, 0, 0}), slope, 1e-6);
  }
}
TEST(LinkageLoads, OfDampersTakePower) {
  Linkage l = loaded_bar();
  l.torsion_springs.push_back({"torsion", 1, 0, 0, 0, 3});  // listed from bar to ground: all the same
  EXPECT_NEAR(drive_of(l, {0.5, 4, 0}), 12, 1e-13);
  EXPECT_NEAR(drive_of(l, {0.5, -4, 0}), -12, 1e-13);
  l.torsion_springs.clear();
  l.springs.push_back({"damper", {0, 1}, {1, 1}, 0, 0, 5});
  // At angle 0: from hook to end (0.2, -0.4) / sqrt 0.2; the end moves up with 0.5 x 2 m/s.
  const double along = -0.4 / std::sqrt(0.2) * 1.0;
  EXPECT_NEAR(drive_of(l, {0, 2, 0}), 5 * along * along / 2, 1e-13);
}
TEST(LinkageLoads, OfASpringWithoutLengthAreNone) {
  Linkage l = loaded_bar();
  l.springs.push_back({"spring", {1, 1}, {0, 1}, 200, 0, 0});
  const double there = std::atan2(0.4, 0.3);
  EXPECT_NEAR(drive_of(l, {there, 0, 0}), 0, 1e-12);
}
TEST(LinkageLoads, OfForcesTurnOrNot) {
  Linkage l = loaded_bar();
  l.forces.push_back({.name = "f", .point = {1, 1}, .force = {0, 6}});
  EXPECT_NEAR(drive_of(l, {pi / 3, 0, 0}), -6 * 0.25, 1e-14);
  l.forces[0].turns_with_body = true;
  EXPECT_NEAR(drive_of(l, {pi / 3, 0, 0}), -6 * 0.5, 1e-14);
}
TEST(LinkageLoads, FollowTheirTables) {
  Linkage l = loaded_bar();
  l.torques.push_back({.name = "t", .body = 1, .torque = 10});
  EXPECT_NEAR(drive_of(l, {0.25, 0, 0}), -10, 1e-14);
  LoadFactor& f = l.torques[0].factor;
  f = {LoadArgument::input, {0, 0.5, 1}, {1, 3, 0}};
  EXPECT_NEAR(drive_of(l, {0.25, 0, 0}), -20, 1e-13);
  EXPECT_NEAR(drive_of(l, {0.75, 0, 0}), -15, 1e-13);
  EXPECT_NEAR(drive_of(l, {-2, 0, 0}), -10, 1e-13);  // held at the ends
  EXPECT_NEAR(drive_of(l, {2, 0, 0}), 0, 1e-13);
  f.against = LoadArgument::time;
  EXPECT_NEAR(drive_of(l, {2, 0, 0}, 0.1), -14, 1e-13);
  l.torques.clear();
  // At the point: y = 0.5 sin.
  l.forces.push_back(
      {.name = "f", .point = {1, 1}, .force = {0, 4}, .factor = {LoadArgument::y, {0, 0.5}, {0, 1}}});
  EXPECT_NEAR(drive_of(l, {pi / 6, 0, 0}), -4 * 0.5 * 0.5 * std::cos(pi / 6), 1e-14);
  l.forces[0].factor.against = LoadArgument::x;
  EXPECT_NEAR(drive_of(l, {pi / 3, 0, 0}), -4 * 0.5 * 0.25, 1e-14);
}

// The load on the ground is that of its joints, of bodies that are welded to it as well.
TEST(LinkageReactions, ShakingForceIsThatOfTheGroundsJoints) {
  Linkage l = linkage_sample("four_bar").linkage;
  // The rocker's pivot stands on a bracket of 3 kg that is welded to the ground.
  const LinkagePoint pivot = l.bodies[0].points[index(l.joints[index(joint_index(l, "B0"))].first.point)];
  const int bracket = add_body(l, "bracket", {{"foot", {0, 0}}, {"top", {0.1, 0.2}}});
  l.bodies[index(bracket)].mass = BodyMass{3, 0.01, {0.05, 0.1}};
  l.bodies[0].points.push_back({"foot", pivot.at - std::complex<double>(0.1, 0.2)});
  add_weld(l, "weld", "ground.foot", "bracket.foot");
  l.joints[index(joint_index(l, "B0"))].first = point_named(l, "bracket.top");
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  const std::vector<InputMotion> in{{1.1, 20, 3}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, in[0].value, f);
  ASSERT_EQ(f.status, Status::done);
  math::Vec2 sum{0, 0};
  double moment = 0;
  for (std::size_t j = 0; j < l.joints.size(); ++j) {
    if (l.joints[j].first.body != 0 && l.joints[j].second.body != 0) continue;
    const double side = l.joints[j].first.body == 0 ? -1 : 1;
    sum = sum + side * f.joints[j].force;
    moment += side * (f.joints[j].moment + cross(f.joints[j].point, f.joints[j].force));
  }
  EXPECT_LE(norm(sum - f.shaking_force), 1e-10 * norm(sum));
  EXPECT_NEAR(moment, f.shaking_moment_with_drive, 1e-10 * (1 + std::abs(moment)));
}

TEST(LinkageReactions, NeedMasses) {
  Linkage l = linkage_sample("four_bar").linkage;
  l.bodies[2].mass.reset();
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  EXPECT_THAT(test::message([&] { solve_forces(l, p, m, 0, 0, f); }),
              HasSubstr("forces need the mass of every body: 'coupler' has none"));
}

}  // namespace
}  // namespace linkwright::planar
