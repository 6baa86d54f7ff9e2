// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/sincos.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/four_bar/detail/forces_kernel.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// A link as Newton and Euler see it.
struct Body {
  math::Vec2 line;          // own joint to far joint
  math::Vec2 arm;           // own joint to mass centre
  math::Vec2 velocity;      // velocity of the mass centre
  math::Vec2 acceleration;  // acceleration of the mass centre
  double speed, angular_acceleration;
};
struct Bodies {
  Body crank, coupler, rocker;
};

// `length` along `direction`; the own joint moves with `velocity` and `acceleration`.
Body body(double length, std::complex<double> direction, const LinkMass& mass, double speed,
          double angular_acceleration, math::Vec2 velocity, math::Vec2 acceleration) {
  const math::Vec2 e = math::vec(direction);
  const math::Vec2 centre =
      mass.centre_angle == 0
          ? math::Vec2{mass.centre_distance, 0}
          : mass.centre_distance * math::Vec2{std::cos(mass.centre_angle), std::sin(mass.centre_angle)};
  const math::Vec2 arm = centre.x * e + centre.y * perpendicular(e);
  return {length * e,
          arm,
          velocity + speed * perpendicular(arm),
          acceleration + angular_acceleration * perpendicular(arm) - (speed * speed) * arm,
          speed,
          angular_acceleration};
}

Bodies bodies(const FourBar& l, const FourBarMasses& m, const FourBarRates& r) {
  Bodies b;
  b.crank = body(l.crank, r.crank_direction, m.crank, r.crank_speed, r.crank_acceleration, {}, {});
  const math::Vec2 pin_velocity = r.crank_speed * perpendicular(b.crank.line);
  const math::Vec2 pin_acceleration =
      r.crank_acceleration * perpendicular(b.crank.line) - (r.crank_speed * r.crank_speed) * b.crank.line;
  b.coupler = body(l.coupler, r.coupler_direction, m.coupler, r.coupler_speed, r.coupler_acceleration,
                   pin_velocity, pin_acceleration);
  b.rocker = body(l.rocker, r.rocker_direction, m.rocker, r.rocker_speed, r.rocker_acceleration, {}, {});
  return b;
}

void require_masses(const FourBarMasses& masses, double gravity) {
  for (const LinkMass* m : {&masses.crank, &masses.coupler, &masses.rocker})
    LINKWRIGHT_REQUIRE(m->mass >= 0 && m->inertia >= 0 && m->centre_distance >= 0 &&
                           std::isfinite(m->mass + m->inertia + m->centre_distance + m->centre_angle),
                       "mass {}, inertia {} and centre distance {} must be finite and not negative, centre "
                       "angle {} finite",
                       m->mass, m->inertia, m->centre_distance, m->centre_angle);
  LINKWRIGHT_REQUIRE(std::isfinite(gravity), "gravity {} must be finite", gravity);
}

// Adds the shaking force and moments on the ground, from the forces on it.
void add_shaking(FourBarReactions& out, const FourBar& linkage, const FourBarRates& rates) {
  const math::Vec2 ground = linkage.ground * math::vec(rates.ground_direction);
  out.shaking_force = -(out.ground_on_crank + out.ground_on_rocker);
  out.shaking_moment = -cross(ground, math::vec(out.ground_on_rocker));
  out.shaking_moment_with_drive = out.shaking_moment - out.drive_torque;
}

// The base parameters of a link whose masses have been checked.
LinkBase<double> link_base(const LinkMass& m) {
  double sine = 0, cosine = 1;
  if (m.centre_angle != 0) math::sincos_of_any(m.centre_angle, sine, cosine);
  const double moment = m.mass * m.centre_distance;
  return {m.mass, moment * cosine, moment * sine, m.inertia + moment * m.centre_distance};
}

// Inertia force and support of the weight.
math::Vec2 load(const LinkMass& mass, const Body& body, double gravity) {
  return mass.mass * (body.acceleration + math::Vec2{0, gravity});
}

}  // namespace

FourBarReactions reactions(const FourBar& linkage, const FourBarMasses& masses, const FourBarRates& rates,
                           double gravity) {
  require_masses(masses, gravity);
  FourBarReactions out;
  out.status = rates.status;
  if (rates.status != Status::done) return out;
  const std::complex<double> ground = linkage.ground * rates.ground_direction;
  const FourBarShape<double> shape = four_bar_shape(ground.real(), ground.imag(), linkage.crank,
                                                    linkage.coupler, linkage.rocker, sign(linkage.branch));
  const FourBarDirections<double> e = {rates.crank_direction.real(),   rates.crank_direction.imag(),
                                       rates.coupler_direction.real(), rates.coupler_direction.imag(),
                                       rates.rocker_direction.real(),  rates.rocker_direction.imag()};
  const auto [ax, ay] =
      crank_pin_acceleration(linkage.crank, e.e1x, e.e1y, rates.crank_speed, rates.crank_acceleration);
  const FourBarTurning<double> turning = {rates.crank_speed,
                                          rates.coupler_speed,
                                          rates.rocker_speed,
                                          rates.crank_acceleration,
                                          rates.coupler_acceleration,
                                          rates.rocker_acceleration,
                                          ax,
                                          ay};
  const FourBarForces<double> f = four_bar_forces(
      shape, e, 1 / rates.transmission_sine, turning,
      {link_base(masses.crank), link_base(masses.coupler), link_base(masses.rocker)}, gravity);
  out.ground_on_crank = {f.ground_on_crank_x, f.ground_on_crank_y};
  out.crank_on_coupler = {f.crank_on_coupler_x, f.crank_on_coupler_y};
  out.rocker_on_coupler = {f.rocker_on_coupler_x, f.rocker_on_coupler_y};
  out.ground_on_rocker = {f.ground_on_rocker_x, f.ground_on_rocker_y};
  out.drive_torque = f.drive_torque;
  out.shaking_force = {f.shaking_x, f.shaking_y};
  out.shaking_moment = f.shaking_moment;
  out.shaking_moment_with_drive = f.shaking_moment_with_drive;
  return out;
}

FourBarReactions reactions_newton_euler(const FourBar& linkage, const FourBarMasses& masses,
                                        const FourBarRates& rates, double gravity) {
  require_masses(masses, gravity);
  FourBarReactions out;
  out.status = rates.status;
  if (rates.status != Status::done) return out;
  const Bodies b = bodies(linkage, masses, rates);
  // Unknowns, as the source has them: crank on ground, coupler on crank, rocker on coupler, ground on rocker
  // (x, y each), torque on the crank.
  Eigen::Matrix<double, 9, 9> a = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> rhs;
  const std::array<const Body*, 3> body = {&b.crank, &b.coupler, &b.rocker};
  const std::array<const LinkMass*, 3> mass = {&masses.crank, &masses.coupler, &masses.rocker};
  // Force `sign` * unknowns (column, column + 1) on body i, at the lever from its mass centre.
  const auto act = [&](int i, int column, double sign, math::Vec2 lever) {
    a(3 * i, column) += sign;
    a(3 * i + 1, column + 1) += sign;
    a(3 * i + 2, column) -= sign * lever.y;
    a(3 * i + 2, column + 1) += sign * lever.x;
  };
  const auto own = [&](int i) { return -1.0 * body[static_cast<std::size_t>(i)]->arm; };
  const auto far = [&](int i) {
    return body[static_cast<std::size_t>(i)]->line - body[static_cast<std::size_t>(i)]->arm;
  };
  act(0, 0, -1, own(0));
  act(0, 2, +1, far(0));
  a(2, 8) = 1;
  act(1, 2, -1, own(1));
  act(1, 4, +1, far(1));
  act(2, 4, -1, far(2));
  act(2, 6, +1, own(2));
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const math::Vec2 force = load(*mass[k], *body[k], gravity);
    rhs.segment<3>(3 * i) << force.x, force.y, mass[k]->inertia * body[k]->angular_acceleration;
  }
  const Eigen::Matrix<double, 9, 1> x = a.partialPivLu().solve(rhs);
  out.ground_on_crank = {-x[0], -x[1]};
  out.crank_on_coupler = {-x[2], -x[3]};
  out.rocker_on_coupler = {x[4], x[5]};
  out.ground_on_rocker = {x[6], x[7]};
  out.drive_torque = x[8];
  add_shaking(out, linkage, rates);
  return out;
}

double energy_rate(const FourBar& linkage, const FourBarMasses& masses, const FourBarRates& rates,
                   double gravity) {
  require_masses(masses, gravity);
  if (rates.status != Status::done) return nan;
  const Bodies b = bodies(linkage, masses, rates);
  const auto of = [&](const LinkMass& mass, const Body& body) {
    return dot(load(mass, body, gravity), body.velocity) +
           mass.inertia * body.angular_acceleration * body.speed;
  };
  return of(masses.crank, b.crank) + of(masses.coupler, b.coupler) + of(masses.rocker, b.rocker);
}

}  // namespace linkwright::planar
