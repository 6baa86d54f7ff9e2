// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/as_linkage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/smooth_branch.h"

namespace linkwright::planar {
namespace {

FourBar lengths(double ground, double crank, double coupler, double rocker) {
  FourBar l{.ground = ground, .crank = crank, .coupler = coupler, .rocker = rocker};
  l.coupler_u = 0.3 * coupler, l.coupler_v = 0.4 * coupler;
  l.pivot_x = 0.2, l.pivot_y = -0.1, l.frame_angle = 0.7;
  return l;
}
const FourBarMasses masses{{0.4, 4e-4, 0.05, 0.2}, {1.3, 2e-2, 0.2, -0.3}, {1.0, 1e-2, 0.16, 0.1}};

// Parallelogram, deltoid of crank and coupler, kite of crank and ground, rhombus.
const std::vector<FourBar> crossing = {lengths(0.6, 0.2, 0.6, 0.2), lengths(0.6, 0.2, 0.2, 0.6),
                                       lengths(0.4, 0.4, 0.6, 0.6), lengths(0.3, 0.3, 0.3, 0.3)};

// A number at 0 from numbers on both sides, to the fourth order.
template <class Of>
double limit_of(Of&& of, double h) {
  const auto mean = [&](double x) { return (of(x) + of(-x)) / 2; };
  return (4 * mean(h) - mean(2 * h)) / 3;
}

// A four-bar as a linkage where its branches meet, on the way that goes on smoothly.
struct OnBothBranches {
  LinkageMotion motion;
  LinkageForces forces;
  double sine() const { return cross(motion.parts[2].direction, motion.parts[3].direction); }
};
// The branch is that of the linkage at `from`, beside `angle`.
OnBothBranches smooth_at(const FourBar& four_bar, const FourBarMasses& of, double gravity, double from,
                         double angle, double speed, double acceleration) {
  Linkage l = linkage_of({four_bar, of});
  l.gravity = {0, -gravity};
  const LinkagePlan planned = plan_linkage(l).plan;
  OnBothBranches out{LinkageMotion(planned), {}};
  const double inputs[] = {from};
  const BranchPath path =
      branch_path(planned, inputs, 0, out.motion.modes, angle - 0.5, angle + 0.5, AtChangePoint::smooth);
  EXPECT_EQ(path.status, Status::done);
  EXPECT_TRUE(
      limit_at_change(planned, path, angle, {angle, speed, acceleration}, out.motion, &l, out.forces));
  return out;
}

// On either side of a change point the smooth branch has the other sign.
TEST(FourBarAsLinkage, HasTheLimitsOfBothSidesWhereBranchesMeet) {
  for (const FourBar& l : crossing) {
    const OnBothBranches here = smooth_at(l, masses, 0, -0.1, 0, 3, 7);
    const auto beside = [&](double angle) {
      FourBar side = l;
      if (angle > 0) side.branch = other(l.branch);
      return side;
    };
    const auto expect = [&](double value, auto&& of, double tolerance, const char* what) {
      EXPECT_NEAR(value, limit_of(of, 2e-3), tolerance) << what << " of " << l.ground << ' ' << l.rocker;
    };
    const auto pose = [&](double angle) { return position(beside(angle), angle); };
    const auto rate = [&](double angle) { return rates(beside(angle), angle, 3, 7); };
    const auto force = [&](double angle) { return reactions(beside(angle), masses, rate(angle), 0); };
    const std::complex<double> frame = std::polar(1.0, l.frame_angle);
    const math::Vec2 pin = point_on(here.motion.parts[3], math::vec(l.rocker * frame)),
                     tracing = point_on(here.motion.parts[2],
                                        math::vec(std::complex<double>(l.coupler_u, l.coupler_v) * frame));
    const auto place = [&](double math::Vec2::*c, std::complex<double> FourBarPosition::*of) {
      return [=](double a) { return c == &math::Vec2::x ? (pose(a).*of).real() : (pose(a).*of).imag(); };
    };
    expect(pin.x, place(&math::Vec2::x, &FourBarPosition::coupler_pin), 1e-10, "B x");
    expect(pin.y, place(&math::Vec2::y, &FourBarPosition::coupler_pin), 1e-10, "B y");
    expect(tracing.x, place(&math::Vec2::x, &FourBarPosition::coupler_point), 1e-10, "C x");
    const auto rate_of = [&](double FourBarRates::*of) { return [=](double a) { return rate(a).*of; }; };
    expect(here.motion.parts[2].speed, rate_of(&FourBarRates::coupler_speed), 1e-8, "speed");
    expect(here.motion.parts[3].speed, rate_of(&FourBarRates::rocker_speed), 1e-8, "speed");
    expect(here.motion.parts[2].angular_acceleration, rate_of(&FourBarRates::coupler_acceleration), 1e-6,
           "acceleration");
    expect(here.motion.parts[3].angular_acceleration, rate_of(&FourBarRates::rocker_acceleration), 1e-6,
           "acceleration");
    EXPECT_NEAR(here.sine(), 0, 1e-9);
    // Without weight some of them have forces there, too.
    if (here.forces.status != Status::done) continue;
    const auto force_of = [&](double FourBarReactions::*of) {
      return [=](double a) { return force(a).*of; };
    };
    expect(here.forces.drives[0], force_of(&FourBarReactions::drive_torque), 1e-5, "torque");
    expect(here.forces.shaking_moment_with_drive, force_of(&FourBarReactions::shaking_moment_with_drive),
           1e-5, "shaking moment");
    expect(
        here.forces.joints[2].force.y, [&](double a) { return force(a).rocker_on_coupler.imag(); }, 1e-4,
        "O3");
  }
}

// Turning uniformly, without weight, a parallelogram of uniform bars has only radial forces at its rocker:
// the coupler's half mass and its own.
TEST(FourBarAsLinkage, ForcesThatStayFiniteAreThere) {
  const FourBar l{.ground = 0.6, .crank = 0.2, .coupler = 0.6, .rocker = 0.2};
  const FourBarMasses uniform{{1, 0.01, 0.1, 0}, {3, 0.09, 0.3, 0}, {1, 0.01, 0.1, 0}};
  for (const double angle : {0.0, pi}) {
    const OnBothBranches here = smooth_at(l, uniform, 0, angle == 0 ? 0.1 : 3, angle, 10, 0);
    ASSERT_EQ(here.forces.status, Status::done) << angle;
    const double sense = std::cos(angle);
    const math::Vec2 on_crank = here.forces.joints[0].force, on_rocker = here.forces.joints[3].force;
    EXPECT_NEAR(on_rocker.x, -sense * 100 * (1 * 0.1 + 1.5 * 0.2), 1e-6);
    EXPECT_NEAR(on_rocker.y, 0, 1e-6);
    EXPECT_NEAR(on_crank.x, on_rocker.x, 1e-6);
    EXPECT_NEAR(here.forces.drives[0], 0, 1e-6);
    EXPECT_NEAR(here.forces.shaking_force.x, 2 * sense * 40, 1e-6);
    EXPECT_NEAR(here.forces.shaking_moment, 0, 1e-6);
  }
  // The weight of the coupler cannot be shared out where all bars lie in line.
  const OnBothBranches heavy = smooth_at(l, uniform, 9.81, 3, pi, 10, 0);
  EXPECT_NEAR(heavy.motion.parts[3].speed, 10, 1e-6);
  EXPECT_EQ(heavy.forces.status, Status::singular);
  EXPECT_TRUE(std::isnan(heavy.forces.joints[3].force.x));
  // The force that lifts and carries all of it does not ask for that.
  EXPECT_NEAR(heavy.forces.drives[0], -9.81 * (3 * 0.2 + 2 * 0.1), 1e-7);
  EXPECT_NEAR(heavy.forces.shaking_force.y, -5 * 9.81, 1e-6);
}

// Two routes to the same motion and forces, at any place and direction of the ground link.
TEST(FourBarAsLinkage, IsTheSameAsInClosedForm) {
  FourBar l = lengths(0.6, 0.1, 0.4, 0.32);
  for (const Branch branch : {Branch::open, Branch::crossed}) {
    l.branch = branch;
    const Linkage linkage = linkage_of({l, masses});
    const PlanResult planned = plan_linkage(linkage);
    ASSERT_TRUE(planned.problems.empty());
    LinkageMotion motion(planned.plan);
    LinkageForces forces;
    for (double angle = 0; angle < 6.3; angle += 0.3) {
      const InputMotion input{angle, 3, 7};
      solve_motion(planned.plan, std::span(&input, 1), motion);
      solve_forces(linkage, planned.plan, motion, 0, input.value, forces);
      const FourBarPosition pose = position(l, angle);
      EXPECT_NEAR(std::remainder(angle_of(motion.parts[1].direction) - angle, 2 * pi), 0, 1e-14);
      EXPECT_NEAR(angle_of(motion.parts[2].direction), pose.coupler_angle, 1e-13);
      EXPECT_NEAR(angle_of(motion.parts[3].direction), pose.rocker_angle, 1e-13);
      const FourBarReactions closed = reactions(l, masses, rates(l, angle, 3, 7), 9.81);
      const std::complex<double> in_closed_form[] = {closed.ground_on_crank, closed.crank_on_coupler,
                                                     closed.rocker_on_coupler, closed.ground_on_rocker};
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_NEAR(forces.joints[j].force.x, in_closed_form[j].real(), 1e-10) << j;
        EXPECT_NEAR(forces.joints[j].force.y, in_closed_form[j].imag(), 1e-10) << j;
      }
      EXPECT_NEAR(forces.drives[0], closed.drive_torque, 1e-11);
      EXPECT_NEAR(forces.shaking_force.x, closed.shaking_force.real(), 1e-10);
      EXPECT_NEAR(forces.shaking_force.y, closed.shaking_force.imag(), 1e-10);
      EXPECT_NEAR(forces.shaking_moment, closed.shaking_moment, 1e-10);
      EXPECT_NEAR(forces.shaking_moment_with_drive, closed.shaking_moment_with_drive, 1e-10);
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
