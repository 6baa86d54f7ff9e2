// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/serial_arm/samples.h"
#include "linkwright/planar/serial_arm/serial_arm.h"
#include "planar/serial_arm_cases.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::at;
using test::dynamics_case;
using test::number_at;
using ::testing::HasSubstr;

// The published task over 201 samples of 10 s.
struct Task {
  std::vector<ArmElement> arm;
  std::array<math::MotionLaw, 2> laws = two_link_motion();
};
struct Peaks {
  std::vector<double> force1, force2, q1, q2, tau1;
};
Peaks run(const Task& task) {
  const math::MotionCurve first(task.laws[0]), second(task.laws[1]);
  Peaks p;
  std::array<ArmLinkRates, 2> r;
  std::array<ArmJointLoads, 2> loads;
  for (int i = 0; i <= 200; ++i) {
    const std::array<math::Motion, 2> motion = {first(0.05 * i), second(0.05 * i)};
    rates(task.arm, 0, motion, r);
    reactions(task.arm, r, 0, loads);
    p.force1.push_back(std::abs(loads[0].force));
    p.force2.push_back(std::abs(loads[1].force));
    p.q1.push_back(loads[0].absolute_torque);
    p.q2.push_back(loads[1].absolute_torque);
    p.tau1.push_back(loads[0].joint_torque);
  }
  return p;
}
// Boskovic 2018, Eq. (2.37) with equal weights.
double objective(const Peaks& p) { return rss_over_n(p.force1) / 2 + rss_over_n(p.force2) / 2; }

Task published_task() { return {elements(serial_arm(two_link_arm()))}; }
Task with_polynomials(double a1, double a2) {
  Task task = published_task();
  task.laws = {math::Polynomial345{0, pi, 0, 10, {a1}}, math::Polynomial345{0, 3 * pi / 2, 0, 10, {a2}}};
  return task;
}
Task with_counterweights(double p, double mass2, double r2) {
  SerialArm arm = serial_arm(two_link_arm());
  const double r1 = 0.5;
  arm.links[0].attached.push_back({p / r1, -r1, 0});
  arm.links[1].attached.push_back({mass2, -r2, 0});
  return {elements(arm)};
}

TEST(SerialArmReactions, ObjectiveOfThePublishedArm) {
  const double computed = number_at(dynamics_case("manipulator-reference"), "computed.F_N");
  EXPECT_NEAR(objective(run(published_task())), 0.220270706547, 1e-11);
  EXPECT_NEAR(objective(run(published_task())), computed, 1e-14);
  // Half a unit of the last digit printed.
  EXPECT_NEAR(objective(run(published_task())), 0.220271, 5e-7);
}

TEST(SerialArmReactions, ObjectiveOfThePublishedPolynomials) {
  EXPECT_NEAR(objective(run(with_polynomials(15.885, -8.7111))), 0.117662134855, 1e-11);
  EXPECT_NEAR(objective(run(with_polynomials(0, 0))),
              0.220270706547 * 0.2030549324372862 / 0.22027070654677583, 1e-11);
  const auto minima = at(dynamics_case("manipulator-polynomial"), "computed.minima_F_a61_a62").as_array();
  ASSERT_EQ(minima.size(), 2u);
  for (const Value& minimum : minima) {
    const auto m = linkwright::test::numbers(minimum);
    EXPECT_NEAR(objective(run(with_polynomials(m[1], m[2]))), m[0], 1e-12);
  }
}

// All eight printed coefficients, which meet the end conditions to their rounding only: a law of its own.
TEST(SerialArmReactions, ObjectiveOfThePrintedCoefficients) {
  const Value& reference = dynamics_case("manipulator-polynomial");
  const std::vector<ArmElement> arm = published_task().arm;
  std::array<ArmLinkRates, 2> r;
  std::array<ArmJointLoads, 2> loads;
  Peaks p;
  for (int i = 0; i <= 200; ++i) {
    std::array<math::Motion, 2> motion;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto a = linkwright::test::numbers(at(reference, k == 0 ? "published.a1" : "published.a2"));
      const double x = i / 200.0, stroke = k == 0 ? pi : 3 * pi / 2;
      for (std::size_t j = 0; j < 4; ++j) {
        const double n = static_cast<double>(j) + 3;
        motion[k].value += stroke * a[j] * std::pow(x, n);
        motion[k].rate += stroke / 10 * a[j] * n * std::pow(x, n - 1);
        motion[k].acceleration += stroke / 100 * a[j] * n * (n - 1) * std::pow(x, n - 2);
      }
    }
    rates(arm, 0, motion, r);
    reactions(arm, r, 0, loads);
    p.force1.push_back(std::abs(loads[0].force));
    p.force2.push_back(std::abs(loads[1].force));
  }
  EXPECT_NEAR(objective(p), 0.117664853, 1e-8);
}

TEST(SerialArmReactions, CounterweightsUnloadTheFirstJoint) {
  const Peaks p = run(with_counterweights(11.5, 7, 0.5));
  EXPECT_NEAR(objective(p), 0.074888265539, 1e-11);
  EXPECT_LT(max_abs(p.force1), 1e-12);
}

TEST(SerialArmReactions, PeaksOfThePublishedMotions) {
  const auto compare = [](const Task& task, std::string_view id) {
    const Value& reference = dynamics_case(id);
    const Peaks p = run(task);
    for (const auto& [values, key] : {std::pair{&p.force1, "R_O1_max_N"},
                                      {&p.force2, "R_O2_max_N"},
                                      {&p.q1, "Q1_max_Nm"},
                                      {&p.q2, "Q2_max_Nm"},
                                      {&p.tau1, "tau1_joint_motor_max_Nm"}})
      EXPECT_NEAR(max_abs(*values), number_at(reference, std::string("computed.") + key), 1e-12)
          << id << " " << key;
    for (const auto& [i, sample] : {std::pair{50u, "computed.sample_i50"}, {130u, "computed.sample_i130"}}) {
      EXPECT_NEAR(p.q1[i], number_at(at(reference, sample), "Q1_Nm"), 1e-12) << id;
      EXPECT_NEAR(p.q2[i], number_at(at(reference, sample), "Q2_Nm"), 1e-12) << id;
      EXPECT_NEAR(
          p.force2[i],
          std::hypot(number_at(at(reference, sample), "X_O2_N"), number_at(at(reference, sample), "Y_O2_N")),
          1e-12)
          << id;
    }
  };
  compare(published_task(), "manipulator-reference_motion");
  compare(with_polynomials(15.885, -8.7111), "manipulator-polynomial_motion");
  compare(with_counterweights(11.5, 7, 0.5), "manipulator-counterweighted_r1_0.5m");
}

// Signs and axes, which magnitudes do not show.
TEST(SerialArmReactions, ComponentsOfThePublishedMotion) {
  const Value& sample = at(dynamics_case("manipulator-reference_motion"), "computed.sample_i50");
  const std::vector<ArmElement> arm = published_task().arm;
  const auto laws = two_link_motion();
  const std::array<math::Motion, 2> motion = {math::MotionCurve(laws[0])(2.5),
                                              math::MotionCurve(laws[1])(2.5)};
  std::array<ArmLinkRates, 2> r;
  std::array<ArmJointLoads, 2> loads;
  rates(arm, 0, motion, r);
  reactions(arm, r, 0, loads);
  EXPECT_NEAR(loads[0].force.real(), number_at(sample, "X_O1_N"), 1e-13);
  EXPECT_NEAR(loads[0].force.imag(), number_at(sample, "Y_O1_N"), 1e-13);
  EXPECT_NEAR(loads[1].force.real(), number_at(sample, "X_O2_N"), 1e-13);
  EXPECT_NEAR(loads[1].force.imag(), number_at(sample, "Y_O2_N"), 1e-13);
}

RC_GTEST_PROP(SerialArmReactionsProperty, AgreeWithRedundantCoordinates, ()) {
  const auto rod = [] {
    return TwoRods::Rod{*test::log_between(0.1, 3), *test::between(0.1, 9), *test::between(0, 2)};
  };
  const TwoRods arm{{rod(), rod()}, *test::between(0, 5)};
  const std::vector<math::Motion> motion = test::any_motion(2);
  const auto b = reactions_redundant(arm, {motion[0], motion[1]});
  const std::vector<ArmElement> e = elements(serial_arm(arm));
  std::array<ArmLinkRates, 2> r;
  std::array<ArmJointLoads, 2> a;
  rates(e, 0, motion, r);
  reactions(e, r, 0, a);
  // Accelerations of up to 100 rad/s2 cancel between the links; 1e-13 of the sum of what is added.
  double size = 0;
  for (std::size_t k = 0; k < 2; ++k)
    size += (arm.rods[0].mass + arm.rods[1].mass + arm.payload) * arm.rods[k].length *
                (std::abs(motion[k].acceleration) + motion[k].rate * motion[k].rate) +
            arm.rods[k].inertia;
  const double length = arm.rods[0].length + arm.rods[1].length + 1;
  for (std::size_t k = 0; k < 2; ++k) {
    RC_ASSERT(std::abs(a[k].force - b[k].force) <= 1e-13 * size);
    RC_ASSERT(std::abs(a[k].absolute_torque - b[k].absolute_torque) <= 1e-13 * size * length);
    RC_ASSERT(std::abs(a[k].joint_torque - b[k].joint_torque) <= 1e-13 * size * length);
  }
}

// Newton and Euler, body by body, every attached mass a body of its own: knows neither base parameters nor
// the joint as a point of reference.
std::vector<ArmJointLoads> newton_euler(const SerialArm& arm, const std::vector<math::Motion>& motion,
                                        double gravity) {
  struct Particle {
    std::complex<double> position, acceleration;
    double mass, inertia;
  };
  const std::complex<double> i(0, 1);
  const std::size_t n = arm.links.size();
  std::vector<std::complex<double>> joints = {arm.base};
  std::vector<std::vector<Particle>> bodies(n);
  std::complex<double> acceleration = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const ArmLink& link = arm.links[k];
    const math::Motion& m = motion[k];
    const auto place = [&](double distance, double angle) {
      return std::polar(1.0, m.value + angle) * distance;
    };
    const auto felt = [&](std::complex<double> v) { return (i * m.acceleration - m.rate * m.rate) * v; };
    const auto add = [&](std::complex<double> v, double mass, double inertia) {
      bodies[k].push_back({joints[k] + v, acceleration + felt(v), mass, inertia});
    };
    add(place(link.body.centre_distance, link.body.centre_angle), link.body.mass, link.body.inertia);
    for (const PointMass& a : link.attached) add(place(a.distance, a.angle), a.mass, 0);
    joints.push_back(joints[k] + place(link.length, 0));
    acceleration += felt(place(link.length, 0));
  }
  std::vector<ArmJointLoads> loads(n);
  std::complex<double> force = 0;  // on the next link
  double torque = 0;               // torque of the motor in the next joint, standing on this link
  for (std::size_t k = n; k-- > 0;) {
    std::complex<double> own = force;
    for (const Particle& p : bodies[k]) own += p.mass * (p.acceleration + i * gravity);
    // Moments about the global origin.
    const auto cross = [](std::complex<double> a, std::complex<double> b) {
      return (std::conj(a) * b).imag();
    };
    double moment = cross(joints[k + 1], force) - cross(joints[k], own);
    for (const Particle& p : bodies[k])
      moment +=
          cross(p.position, p.mass * (p.acceleration + i * gravity)) + p.inertia * motion[k].acceleration;
    loads[k] = {own, moment, torque + moment};
    force = own;
    torque += moment;
  }
  return loads;
}

double size_of(const SerialArm& arm, const std::vector<math::Motion>& motion, double gravity) {
  double mass = 0, felt = gravity, reach = 0, inertia = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const ArmLink& link = arm.links[k];
    const double spin = std::abs(motion[k].acceleration) + motion[k].rate * motion[k].rate;
    mass += link.body.mass;
    for (const PointMass& a : link.attached) mass += a.mass;
    felt += spin * (link.length + 3);
    reach += link.length + 3;
    inertia += link.body.inertia * spin;
  }
  return mass * felt * (reach + std::abs(arm.base) + 1) + inertia;
}

RC_GTEST_PROP(SerialArmReactionsProperty, AgreeWithNewtonAndEuler, ()) {
  const std::size_t n = static_cast<std::size_t>(*rc::gen::inRange(1, 7));
  const SerialArm arm = test::any_arm(n);
  const std::vector<math::Motion> motion = test::any_motion(n);
  const double gravity = *test::between(0, 20), size = size_of(arm, motion, gravity);
  const std::vector<ArmElement> e = elements(arm);
  std::vector<ArmLinkRates> r(n);
  std::vector<ArmJointLoads> a(n);
  rates(e, arm.base, motion, r);
  reactions(e, r, gravity, a);
  const auto b = newton_euler(arm, motion, gravity);
  for (std::size_t k = 0; k < n; ++k) {
    RC_ASSERT(std::abs(a[k].force - b[k].force) <= 1e-13 * size);
    RC_ASSERT(std::abs(a[k].absolute_torque - b[k].absolute_torque) <= 1e-13 * size);
    RC_ASSERT(std::abs(a[k].joint_torque - b[k].joint_torque) <= 1e-13 * size);
  }
}

// One chain of four links with attached masses, relative to the values themselves.
TEST(SerialArmReactions, OfFourLinksAgreeWithNewtonAndEulerTo1e12) {
  const SerialArm arm{{0.3, -0.2},
                      {{0.7, {3, 0.2, 0.3, 0.4}, {{1.5, -0.2, 0}}},
                       {0.5, {2, 0.1, 0.25, -0.7}, {{0.4, 0.5, 0}, {0.9, 0.3, 2}}},
                       {0.4, {1.2, 0.05, 0.15, 3}, {}},
                       {0.3, {0.8, 0.02, 0.1, 0}, {{2.5, 0.3, 0.1}}}}};
  const std::vector<math::Motion> motion = {
      {0.4, 3, -5, 0}, {-1.3, -2, 8, 0}, {2.2, 4, 1, 0}, {5, -6, -12, 0}};
  const std::vector<ArmElement> e = elements(arm);
  std::vector<ArmLinkRates> r(4);
  std::vector<ArmJointLoads> a(4);
  rates(e, arm.base, motion, r);
  const std::size_t before = test::allocations();
  reactions(e, r, 9.81, a);
  EXPECT_EQ(test::allocations(), before);
  const auto b = newton_euler(arm, motion, 9.81);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT(std::abs(a[k].force - b[k].force), 1e-12 * std::abs(b[k].force));
    EXPECT_NEAR(a[k].absolute_torque, b[k].absolute_torque, 1e-12 * std::abs(b[k].absolute_torque));
    EXPECT_NEAR(a[k].joint_torque, b[k].joint_torque, 1e-12 * std::abs(b[k].joint_torque));
  }
}

RC_GTEST_PROP(SerialArmReactionsProperty, TheMotorsFeedTheEnergy, ()) {
  const std::size_t n = static_cast<std::size_t>(*rc::gen::inRange(1, 6));
  const SerialArm arm = test::any_arm(n);
  const std::vector<math::Motion> motion = test::any_motion(n);
  const double gravity = *test::between(0, 20), size = 30 * size_of(arm, motion, gravity);
  const std::vector<ArmElement> e = elements(arm);
  std::vector<ArmLinkRates> r(n);
  std::vector<ArmJointLoads> loads(n);
  rates(e, arm.base, motion, r);
  reactions(e, r, gravity, loads);
  double absolute = 0, joint = 0;
  for (std::size_t k = 0; k < n; ++k) {
    absolute += loads[k].absolute_torque * motion[k].rate;
    joint += loads[k].joint_torque * (motion[k].rate - (k == 0 ? 0 : motion[k - 1].rate));
  }
  const double power = energy_rate(e, r, gravity);
  RC_ASSERT(std::abs(absolute - power) <= 1e-13 * size);
  RC_ASSERT(std::abs(joint - power) <= 1e-13 * size);
}

// Energy against its rate over a motion: trapezoids converge as the square of the step.
TEST(SerialArmReactions, WorkIsTheGainOfEnergy) {
  SerialArm arm = serial_arm(two_link_arm());
  arm.base = {0, 1};
  const std::vector<ArmElement> e = elements(arm);
  const auto laws = two_link_motion();
  const math::MotionCurve first(laws[0]), second(laws[1]);
  const auto gap = [&](int steps) {
    std::array<ArmLinkRates, 2> r;
    double work = 0, gain = 0;
    for (int i = 0; i <= steps; ++i) {
      const std::array<math::Motion, 2> motion = {first(4.0 * i / steps), second(4.0 * i / steps)};
      rates(e, arm.base, motion, r);
      const ArmEnergy energies = energy(e, r, 9.81);
      const double total = energies.kinetic + energies.potential;
      if (i == 0) gain -= total;
      if (i == steps) gain += total;
      work += energy_rate(e, r, 9.81) * 4 / steps * (i == 0 || i == steps ? 0.5 : 1);
    }
    return std::abs(work - gain);
  };
  EXPECT_NEAR(gap(100) / gap(200), 4, 0.05);
  EXPECT_LT(gap(200), 0.05);
}

TEST(SerialArmReactions, AtRestCarryTheWeight) {
  const SerialArm arm{0, {{2, {3, 0.1, 1, 0}, {}}, {1, {1.5, 0.1, 0.5, 0}, {{0.5, 1, 0}}}}};
  const std::vector<ArmElement> e = elements(arm);
  const std::vector<math::Motion> motion(2);  // stretched along x
  std::array<ArmLinkRates, 2> r;
  std::array<ArmJointLoads, 2> loads;
  rates(e, 0, motion, r);
  reactions(e, r, 10, loads);
  EXPECT_EQ(loads[0].force, std::complex<double>(0, 50));
  EXPECT_EQ(loads[1].force, std::complex<double>(0, 20));
  EXPECT_NEAR(loads[1].joint_torque, 10 * (1.5 * 0.5 + 0.5), 1e-13);
  EXPECT_NEAR(loads[0].joint_torque, 10 * (3 + 1.5 * 2.5 + 0.5 * 3), 1e-13);
}

TEST(SerialArmReactions, RejectWhatDoesNotFit) {
  const std::vector<ArmElement> e = published_task().arm;
  std::vector<ArmLinkRates> r(2);
  std::vector<ArmJointLoads> loads(1);
  EXPECT_THAT(test::message([&] { reactions(e, r, 0, loads); }),
              HasSubstr("2 rates and 1 loads for 2 links"));
  loads.resize(2);
  EXPECT_THAT(test::message([&] { reactions(e, r, NAN, loads); }), HasSubstr("gravity nan must be finite"));
  EXPECT_THAT(test::message([] { reactions_redundant({}, {}); }),
              HasSubstr("length 0 and mass 0 of a rod must be positive"));
}

}  // namespace
}  // namespace linkwright::planar
