// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/friction.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/simulation/simulation.h"
#include "planar/linkages.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

Linkage rubbing(double guide, double pins) {
  LinkageSample s = slider_crank_sample();
  Linkage l = s.linkage;
  for (std::size_t b = 1; b < l.bodies.size(); ++b) l.bodies[b].mass = BodyMass{};
  l.gravity = 0;
  l.forces.push_back({.name = "push", .point = point_named(l, "slider.B"), .force = {-100, 0}});
  for (LinkageJoint& j : l.joints) {
    if (j.type == JointType::prismatic) j.friction = guide;
    if (j.type == JointType::revolute && pins > 0) j.friction = pins, j.pin_radius = 0.01;
  }
  return l;
}
struct Rub {
  LinkageForces forces;
  double unbalanced = 0;
};
Rub rub(const Linkage& l, double angle, double speed) {
  Rub out;
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{angle, speed, 0}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, angle, out.forces);
  out.unbalanced = unbalance(l, p, m, out.forces);
  return out;
}
// Crank up (90 deg) and 0.05 m, rod 0.15 m: the rod falls with sin = 1/3 towards the slider, which moves
// backwards (-x) for a crank that turns forwards. Rod force S along the rod on the slider: S cos - 100 +
// mu N = 0 along the guide with friction forwards, N = S sin.
TEST(LinkageFriction, OfASliderAsByHand) {
  const double sine = 1.0 / 3, cosine = std::sqrt(8.0) / 3, mu = 0.3;
  const Rub r = rub(rubbing(mu, 0), pi / 2, 2);
  ASSERT_EQ(r.forces.status, Status::done);
  const double rod = 100 / (cosine + mu * sine);
  EXPECT_NEAR(std::abs(r.forces.joints[3].force.y), rod * sine, 1e-9);
  EXPECT_NEAR(norm(r.forces.joints[2].force), rod, 1e-9);
  EXPECT_NEAR(r.forces.drives[0], -rod * cosine * 0.05, 1e-10);
  EXPECT_GT(r.forces.iterations, 2);
  EXPECT_LE(r.unbalanced, 1e-9);
  // The other way the rod must overcome friction, too.
  const Rub back = rub(rubbing(mu, 0), pi / 2, -2);
  EXPECT_NEAR(back.forces.drives[0], -100 / (cosine - mu * sine) * cosine * 0.05, 1e-10);
}
// A lever of 0.2 m, pressed with 10 N m onto a running belt with friction 0.4, at an angle from the belt:
// moments about its pin give N l (cos - mu sin) where the belt draws the tip under the pin. From atan(1 / mu)
// on, 68.2 deg, no finite force lets the belt run, as in a sprag clutch.
TEST(LinkageFriction, ALeverOnABeltLocksLikeASprag) {
  const auto pressed = [](double angle, double speed) {
    Linkage l = grounded({{"O", 0}, {"P", {0, 0.2 * std::sin(angle)}}});
    add_body(l, "belt", {{"B", 0}});
    add_bar(l, "lever", "P", "tip", 0.2);
    for (std::size_t b = 1; b < 3; ++b) l.bodies[b].mass = BodyMass{};
    l.gravity = 0;
    add_slide(l, "run", "ground.O", "belt.B");
    add_pin(l, "P", "ground.P", "lever.P");
    add_slot(l, "contact", "belt.B", "lever.tip", 0);
    l.joints[2].friction = 0.4;
    add_drive(l, "run");
    set_start(l, "lever", {0, 0.2 * std::sin(angle)}, -angle);
    l.torques.push_back({.name = "press", .body = 2, .torque = -10});
    return rub(l, 0, speed).forces;
  };
  const double angle = pi / 3, locks = std::atan(1 / 0.4);
  EXPECT_NEAR(locks * 180 / pi, 68.19859051364818, 1e-10);
  EXPECT_NEAR(std::abs(pressed(angle, -1).joints[2].force.y), 325.54236981299033, 1e-9);
  EXPECT_NEAR(std::abs(pressed(angle, 1).joints[2].force.y), 59.07301480239404, 1e-9);
  EXPECT_EQ(pressed(locks - 1e-4, -1).status, Status::done);
  EXPECT_EQ(pressed(locks + 1e-4, -1).status, Status::self_locking);
  EXPECT_EQ(pressed(locks + 1e-4, 1).status, Status::done);
}

TEST(LinkageFriction, TakesPower) {
  const Linkage dry = rubbing(0, 0);
  for (const auto& [guide, pins] : {std::pair{0.2, 0.0}, {0.0, 0.1}, {0.2, 0.1}})
    for (const double speed : {3.0, -3.0})
      for (double angle = 0.1; angle < 6.2; angle += 0.5) {
        const Rub with = rub(rubbing(guide, pins), angle, speed), without = rub(dry, angle, speed);
        ASSERT_EQ(with.forces.status, Status::done);
        EXPECT_LT(with.forces.load_power, without.forces.load_power);
        EXPECT_GT(with.forces.drive_power, without.forces.drive_power);
        EXPECT_LE(with.unbalanced, 1e-9);
        EXPECT_NEAR(with.forces.drive_power + with.forces.load_power, with.forces.kinetic_power, 1e-9);
      }
}
TEST(LinkageFriction, OfZeroOrAtRestChangesNothing) {
  const Rub dry = rub(rubbing(0, 0), 1, 2);
  EXPECT_EQ(dry.forces.iterations, 0);
  const Rub rest = rub(rubbing(0.3, 0.1), 1, 0), dry_rest = rub(rubbing(0, 0), 1, 0);
  EXPECT_EQ(rest.forces.drives[0], dry_rest.forces.drives[0]);
}
// A guide of finite length that is pushed outside of its middle: the moment adds to the forces at its ends.
TEST(LinkageFriction, OfAGuideFeelsTheMoment) {
  Linkage l = grounded({{"guide", {0, 0}}});
  add_body(l, "slider", {{"middle", {0, 0}}, {"side", {0, 0.2}}});
  add_slide(l, "guide", "ground.guide", "slider.middle");
  add_drive(l, "guide");
  l.bodies[1].mass = BodyMass{};
  l.gravity = 0;
  l.forces.push_back({.name = "push", .point = {1, 1}, .force = {-50, 0}});
  l.joints[0].friction = 0.1;
  l.joints[0].guide_length = 0.4;
  Rub r = rub(l, 0.3, 1);
  ASSERT_EQ(r.forces.status, Status::done);
  // 50 N x 0.2 m on 0.4 m: 25 N at each end.
  EXPECT_NEAR(r.forces.drives[0], 50 + 0.1 * 50, 1e-12);
  // Two guide forces, 80 N across in the middle: 40 + 25 N and 40 - 25 N, as many as without the moment.
  l.forces.push_back({.name = "across", .point = {1, 0}, .force = {0, 80}});
  EXPECT_NEAR(rub(l, 0.3, 1).forces.drives[0], 50 + 0.1 * 80, 1e-12);
  l.forces.pop_back();
  l.joints[0].guide_length = 0;
  EXPECT_NEAR(rub(l, 0.3, 1).forces.drives[0], 50, 1e-12);
}
// Driven back, the rod overcomes the friction of the slider as long as mu tan < 1: S = 100 / (cos - mu sin).
// Near that and beyond it, forwards as well, the passes of an iteration go astray.
TEST(LinkageFriction, IsFoundUpToWhereItLocks) {
  const double sine = 1.0 / 3, cosine = std::sqrt(8.0) / 3;
  for (const double share : {0.5, 0.89, 0.94, 0.97, 0.99, 0.999}) {
    const double mu = share * cosine / sine;
    const Rub r = rub(rubbing(mu, 0), pi / 2, -2);
    ASSERT_EQ(r.forces.status, Status::done) << share;
    const double rod = 100 / (cosine - mu * sine);
    EXPECT_NEAR(norm(r.forces.joints[2].force), rod, 1e-9 * rod) << share;
    EXPECT_LE(r.unbalanced, 1e-9 * rod) << share;
  }
  for (const double share : {1.5, 3.0, 10.0}) {
    const double mu = share * cosine / sine;
    const Rub r = rub(rubbing(mu, 0), pi / 2, 2);
    ASSERT_EQ(r.forces.status, Status::done) << share;
    EXPECT_NEAR(norm(r.forces.joints[2].force), 100 / (cosine + mu * sine), 1e-9) << share;
  }
}
TEST(LinkageFriction, ThatBlocksIsSelfLocking) {
  const double sine = 1.0 / 3, cosine = std::sqrt(8.0) / 3;
  for (const double share : {1.001, 1.01, 1.414, 5.0}) {
    const Rub r = rub(rubbing(share * cosine / sine, 0), pi / 2, -2);
    EXPECT_EQ(r.forces.status, Status::self_locking) << share;
    EXPECT_TRUE(std::isnan(r.forces.drives[0]));
    EXPECT_TRUE(std::isnan(r.forces.joints[0].force.x));
  }
}

// ---- free inputs

// A slider-crank whose crank forces move: flywheel on the crank, weightless rod, slider of 2 kg that rubs; a
// torque on the crank, -100 N on the slider. By hand: rod force S on the slider, positive when it presses, in
// J a = T + S q cos(psi) and m x'' = S cos(psi) + P - mu |S sin(psi)| sign(x'), with x' = -q w.
struct FreeCrank {
  double flywheel = 1, friction = 0, torque = 0;
  static constexpr double crank = 0.05, rod = 0.15, mass = 2, push = -100;

  Linkage linkage() const {
    Linkage l = rubbing(friction, 0);
    l.bodies[index(body_index(l, "crank"))].mass = BodyMass{0, flywheel, 0};
    l.bodies[index(body_index(l, "slider"))].mass = BodyMass{mass, 0, 0};
    l.torques.push_back({.name = "drive", .body = body_index(l, "crank"), .from = 0, .torque = torque});
    return l;
  }
  double sine(double angle) const { return crank * std::sin(angle) / rod; }
  /// dx/d(angle), negative, for which a fall of the angle moves the slider out.
  double lever(double angle) const {
    const double s = sine(angle), c = std::sqrt(1 - s * s);
    return crank * (std::sin(angle) + std::cos(angle) * s / c);
  }
  double lever_rate(double angle) const {
    const double h = 1e-5;
    return (8 * (lever(angle + h) - lever(angle - h)) - (lever(angle + 2 * h) - lever(angle - 2 * h))) /
           (12 * h);
  }
  /// The acceleration if the guide carries a side force of that sign; nothing where it would not.
  std::optional<double> acceleration(double angle, double speed, double side) const {
    const double s = sine(angle), c = std::sqrt(1 - s * s), q = lever(angle), sense = speed < 0 ? 1 : -1,
                 inertia = c + mass * q * q * c / flywheel - friction * side * sense * s,
                 force = -(push + mass * q * torque / flywheel + mass * speed * speed * lever_rate(angle)) /
                         inertia;
    return force * s * side < 0 ? std::nullopt : std::optional((torque + force * q * c) / flywheel);
  }
  /// Nothing unless there is exactly one.
  std::optional<double> acceleration(double angle, double speed) const {
    const auto pressed = acceleration(angle, speed, 1), pulled = acceleration(angle, speed, -1);
    return pressed && pulled ? std::nullopt : pressed ? pressed : pulled;
  }
  /// The friction at which pressing outwards has no answer any more.
  double locking(double angle) const {
    const double s = sine(angle), c = std::sqrt(1 - s * s), q = lever(angle);
    return c / s * (1 + mass * q * q / flywheel);
  }
};

// The answer by hand up to where friction locks: far beyond mu tan(psi) = 1 where the slider is most of what
// moves, for then it decelerates instead.
TEST(LinkageFriction, OfFreeInputsIsFoundUpToWhereItLocks) {
  for (const double flywheel : {1e-3, 1e-2, 1.0, 100.0})
    for (const double share : {0.3, 0.7, 0.89, 0.94, 0.97, 0.99, 0.999})
      for (const double angle : {1.0, pi / 2, 2.0}) {
        FreeCrank by_hand{.flywheel = flywheel, .torque = -3};
        by_hand.friction = share * by_hand.locking(angle);
        const Linkage l = by_hand.linkage();
        const LinkagePlan p = planned(l);
        LinkageDynamics dynamics(l, p, {true});
        InputMotion input{angle, -1.5, 0};
        ASSERT_EQ(dynamics.solve(0, std::span(&input, 1)), Status::done) << flywheel << ' ' << share;
        const auto expected = by_hand.acceleration(angle, -1.5);
        ASSERT_TRUE(expected);
        EXPECT_NEAR(input.acceleration, *expected, 1e-9 * std::abs(*expected) + 1e-9)
            << flywheel << ' ' << share << ' ' << angle;
      }
}
TEST(LinkageFriction, OfFreeInputsThatJamsIsSelfLocking) {
  for (const double flywheel : {1e-2, 1.0, 100.0})
    for (const double share : {1.001, 1.1, 5.0}) {
      FreeCrank by_hand{.flywheel = flywheel};
      by_hand.friction = share * by_hand.locking(pi / 2);
      EXPECT_FALSE(by_hand.acceleration(pi / 2, -1.5));
      const Linkage l = by_hand.linkage();
      const LinkagePlan p = planned(l);
      LinkageDynamics dynamics(l, p, {true});
      InputMotion input{pi / 2, -1.5, 0};
      EXPECT_EQ(dynamics.solve(0, std::span(&input, 1)), Status::self_locking) << flywheel << ' ' << share;
      EXPECT_TRUE(std::isnan(input.acceleration));
      // Going back there are two answers; that with the side force of no friction is the one.
      input = {pi / 2, 1.5, 0};
      ASSERT_EQ(dynamics.solve(0, std::span(&input, 1)), Status::done);
      EXPECT_TRUE(by_hand.acceleration(pi / 2, 1.5, -1));
      EXPECT_NEAR(input.acceleration, by_hand.acceleration(pi / 2, 1.5, 1).value(),
                  1e-9 * std::abs(input.acceleration));
    }
}

struct Turn {
  SimulationReport report;
  InputMotion last;
};
Turn simulated(const FreeCrank& crank, double angle, double speed, double time) {
  const Linkage l = crank.linkage();
  const LinkagePlan p = planned(l);
  Turn out;
  const InputDrive free{{}, angle, speed};
  const std::vector<double> times{0, time / 2, time};
  out.report = simulate(l, p, std::span(&free, 1), times, {}, [&](const SimulationInstant& now) {
    out.last = now.inputs[0];
    return true;
  });
  return out;
}
// The same by the fourth order of Runge and Kutta over the equation by hand.
InputMotion by_steps(const FreeCrank& crank, double angle, double speed, double time, int steps) {
  const double h = time / steps;
  const auto a = [&](double x, double v) { return crank.acceleration(x, v).value(); };
  for (int i = 0; i < steps; ++i) {
    const double a1 = a(angle, speed), v2 = speed + h / 2 * a1, a2 = a(angle + h / 2 * speed, v2),
                 v3 = speed + h / 2 * a2, a3 = a(angle + h / 2 * v2, v3), v4 = speed + h * a3,
                 a4 = a(angle + h * v3, v4);
    angle += h / 6 * (speed + 2 * v2 + 2 * v3 + v4);
    speed += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return {angle, speed, 0};
}

// A flywheel presses the slider out through the place where it nearly locks.
TEST(LinkageFriction, NearSelfLockingInASimulation) {
  for (const double flywheel : {0.05, 100.0})
    for (const double share : {0.5, 0.89, 0.99}) {
      FreeCrank crank{.flywheel = flywheel};
      crank.friction = share * crank.locking(1.65);  // nearly the largest inclination of the rod
      const double speed = flywheel < 1 ? -300 : -10, time = 1.5 / std::abs(speed);
      const Turn turn = simulated(crank, 2.2, speed, time);
      ASSERT_EQ(turn.report.status, Status::done)
          << flywheel << ' ' << share << ' ' << to_string(turn.report.message);
      const InputMotion expected = by_steps(crank, 2.2, speed, time, 20000);
      EXPECT_NEAR(turn.last.value, expected.value, 1e-7) << flywheel << ' ' << share;
      EXPECT_NEAR(turn.last.rate, expected.rate, 1e-6 * std::abs(speed)) << flywheel << ' ' << share;
    }
}

TEST(LinkageFriction, JamsASimulation) {
  FreeCrank crank{.flywheel = 100};
  crank.friction = 1.02 * crank.locking(1.65);
  const Turn turn = simulated(crank, 2.2, -10, 0.15);
  EXPECT_EQ(turn.report.status, Status::self_locking);
  EXPECT_THAT(to_string(turn.report.message), ::testing::HasSubstr("friction locks the linkage at 0.0"));
  EXPECT_THAT(to_string(turn.report.message),
              ::testing::HasSubstr("it jams, for no finite joint forces go with motion in this sense"));
  // The friction at hand is here that which locks.
  double low = 1.65, high = 2.2;
  for (int i = 0; i < 60; ++i)
    (crank.locking((low + high) / 2) < crank.friction ? low : high) = (low + high) / 2;
  EXPECT_NEAR(turn.report.time, (2.2 - low) / 10, 1e-3);
}

}  // namespace
}  // namespace linkwright::planar
