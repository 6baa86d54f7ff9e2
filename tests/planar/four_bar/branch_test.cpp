#include "linkwright/planar/four_bar/branch.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {
namespace {

using ::testing::ElementsAre;

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

// On either side of a change point the smooth branch has the other sign.
TEST(FourBarBranch, HasTheLimitsOfBothSides) {
  for (const FourBar& l : crossing) {
    const FourBarBranch branch(l, masses, 0, -0.5, 0.5, AtChangePoint::smooth);
    const FourBarInstant here = branch.at(0, 3, 7);
    ASSERT_TRUE(here.change_point) << l.ground << ' ' << l.rocker;
    EXPECT_EQ(here.pose.status, Status::done);
    EXPECT_EQ(here.rates.status, Status::done);
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
    expect(
        here.pose.coupler_pin.real(), [&](double a) { return pose(a).coupler_pin.real(); }, 1e-10, "B x");
    expect(
        here.pose.coupler_pin.imag(), [&](double a) { return pose(a).coupler_pin.imag(); }, 1e-10, "B y");
    expect(
        here.pose.coupler_point.real(), [&](double a) { return pose(a).coupler_point.real(); }, 1e-10, "C");
    expect(
        here.rates.coupler_speed, [&](double a) { return rate(a).coupler_speed; }, 1e-8, "speed");
    expect(
        here.rates.rocker_speed, [&](double a) { return rate(a).rocker_speed; }, 1e-8, "speed");
    expect(
        here.rates.coupler_acceleration, [&](double a) { return rate(a).coupler_acceleration; }, 1e-6,
        "acceleration");
    expect(
        here.rates.rocker_acceleration, [&](double a) { return rate(a).rocker_acceleration; }, 1e-6,
        "acceleration");
    EXPECT_NEAR(here.rates.transmission_sine, 0, 1e-9);
    EXPECT_NEAR(std::abs(here.pose.coupler_pin - rocker_pivot(l)), l.rocker, 1e-9);
    EXPECT_NEAR(std::abs(here.pose.coupler_pin - here.pose.crank_pin), l.coupler, 1e-9);
    // Without weight some of them have forces there, too.
    if (here.forces.status != Status::done) continue;
    expect(
        here.forces.drive_torque, [&](double a) { return force(a).drive_torque; }, 1e-5, "torque");
    expect(
        here.forces.shaking_moment_with_drive, [&](double a) { return force(a).shaking_moment_with_drive; },
        1e-5, "shaking moment");
    expect(
        here.forces.rocker_on_coupler.imag(), [&](double a) { return force(a).rocker_on_coupler.imag(); },
        1e-4, "O3");
  }
}

// Turning uniformly, without weight, a parallelogram of uniform bars has only radial forces at its rocker:
// the coupler's half mass and its own.
TEST(FourBarBranch, ForcesThatStayFiniteAreThere) {
  const FourBar l{.ground = 0.6, .crank = 0.2, .coupler = 0.6, .rocker = 0.2};
  const FourBarMasses uniform{{1, 0.01, 0.1, 0}, {3, 0.09, 0.3, 0}, {1, 0.01, 0.1, 0}};
  const FourBarBranch branch(l, uniform, 0, 0, 2 * pi, AtChangePoint::smooth);
  for (const double angle : {0.0, pi, 2 * pi}) {
    const FourBarInstant at = branch.at(angle, 10, 0);
    ASSERT_TRUE(at.change_point) << angle;
    ASSERT_EQ(at.forces.status, Status::done) << angle;
    const double sense = std::cos(angle);
    EXPECT_NEAR(at.forces.ground_on_rocker.real(), -sense * 100 * (1 * 0.1 + 1.5 * 0.2), 1e-6);
    EXPECT_NEAR(at.forces.ground_on_rocker.imag(), 0, 1e-6);
    EXPECT_NEAR(at.forces.ground_on_crank.real(), at.forces.ground_on_rocker.real(), 1e-6);
    EXPECT_NEAR(at.forces.drive_torque, 0, 1e-6);
    EXPECT_NEAR(at.forces.shaking_force.real(), 2 * sense * 40, 1e-6);
    EXPECT_NEAR(at.forces.shaking_moment, 0, 1e-6);
  }
  // The weight of the coupler cannot be shared out where all bars lie in line.
  const FourBarInstant heavy =
      FourBarBranch(l, uniform, 9.81, 0, 2 * pi, AtChangePoint::smooth).at(pi, 10, 0);
  EXPECT_EQ(heavy.rates.status, Status::done);
  EXPECT_NEAR(heavy.rates.rocker_speed, 10, 1e-6);
  EXPECT_EQ(heavy.forces.status, Status::singular);
  EXPECT_TRUE(std::isnan(heavy.forces.ground_on_rocker.real()));
  // What it takes to lift all of it, and to carry it, does not ask for that.
  EXPECT_NEAR(heavy.forces.drive_torque, -9.81 * (3 * 0.2 + 2 * 0.1), 1e-7);
  EXPECT_NEAR(heavy.forces.shaking_force.imag(), -5 * 9.81, 1e-6);
}

TEST(FourBarBranch, GoesOnSmoothlyOverTheTurn) {
  const FourBar parallelogram{.ground = 0.6, .crank = 0.2, .coupler = 0.6, .rocker = 0.2, .frame_angle = 2};
  const FourBarBranch smooth(parallelogram, {}, 0, 0, 4 * pi, AtChangePoint::smooth);
  EXPECT_THAT(smooth.change_points(),
              ElementsAre(::testing::DoubleNear(0, 1e-9), ::testing::DoubleNear(pi, 1e-9)));
  const FourBarBranch kinked(parallelogram, {}, 0, 0, 4 * pi, AtChangePoint::keep_sign),
      stopped(parallelogram, {}, 0, 0.1, 4 * pi, AtChangePoint::stop);
  for (int i = 0; i <= 720; ++i) {
    const double angle = i * pi / 180;
    const FourBarInstant at = smooth.at(angle, 2, 0);
    ASSERT_EQ(at.rates.status, Status::done) << i;
    EXPECT_NEAR(math::wrap_angle(at.pose.rocker_angle - angle), 0, 1e-7) << i;
    EXPECT_NEAR(at.pose.coupler_angle, 0, 1e-7) << i;
    EXPECT_NEAR(at.rates.rocker_speed, 2, 1e-5) << i;
    // Keeping its sign it is an antiparallelogram in every other half turn; where the halves meet the
    // position is known, the speeds are not.
    const FourBarInstant other = kinked.at(angle, 2, 0);
    EXPECT_EQ(other.rates.status, i % 180 == 0 ? Status::singular : Status::done) << i;
    EXPECT_EQ(std::abs(other.pose.coupler_angle) < 1e-7, i % 360 <= 180) << i;
    EXPECT_EQ(std::isnan(other.rates.rocker_speed), i % 180 == 0) << i;
    // And where the motion stops, it is over.
    const Status status = stopped.at(angle + 0.1, 2, 0).pose.status;
    EXPECT_EQ(status, angle + 0.1 < pi ? Status::done : Status::limit_reached) << i;
  }
}

// Other linkages are on their branch throughout, and say where they cannot be.
TEST(FourBarBranch, LeavesOthersAsTheyAre) {
  for (const FourBar& l : {lengths(0.6, 0.1, 0.4, 0.32), lengths(1, 1, 0.6, 0.7)}) {
    const FourBarBranch branch(l, masses, 9.81, 0, 2 * pi, AtChangePoint::smooth);
    EXPECT_TRUE(branch.change_points().empty());
    for (double angle = 0; angle < 6.3; angle += 0.1) {
      const FourBarInstant at = branch.at(angle, 3, 0);
      const FourBarPosition pose = position(l, angle);
      const FourBarReactions forces = reactions(l, masses, rates(l, angle, 3, 0), 9.81);
      EXPECT_EQ(at.pose.status, pose.status);
      EXPECT_EQ(at.forces.status, forces.status);
      if (pose.status != Status::done) continue;
      EXPECT_EQ(at.pose.coupler_point, pose.coupler_point);
      EXPECT_EQ(at.forces.drive_torque, forces.drive_torque);
    }
  }
}

// Two routes to the same forces, at any place.
TEST(FourBarBranch, AsALinkageItIsTheSame) {
  const FourBar l = lengths(0.6, 0.1, 0.4, 0.32);
  const Linkage linkage = linkage_of(l, &masses, 9.81);
  const PlanResult planned = plan_linkage(linkage);
  ASSERT_TRUE(planned.problems.empty());
  LinkageMotion motion(planned.plan);
  LinkageForces forces;
  for (double angle = 0; angle < 6.3; angle += 0.3) {
    const InputMotion input{l.frame_angle + angle, 3, 7};
    solve_motion(planned.plan, std::span(&input, 1), motion);
    solve_forces(linkage, planned.plan, motion, 0, input.value, forces);
    const FourBarReactions closed = reactions(l, masses, rates(l, angle, 3, 7), 9.81);
    EXPECT_NEAR(forces.drives[0], closed.drive_torque, 1e-11);
    EXPECT_NEAR(forces.joints[2].force.x, closed.rocker_on_coupler.real(), 1e-10);
    EXPECT_NEAR(forces.joints[3].force.y, closed.ground_on_rocker.imag(), 1e-10);
    EXPECT_NEAR(forces.shaking_force.y, closed.shaking_force.imag(), 1e-10);
  }
}

}  // namespace
}  // namespace linkwright::planar
