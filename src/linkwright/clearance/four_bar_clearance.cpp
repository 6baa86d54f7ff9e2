// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/four_bar_clearance.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/kernel.h"
#include "linkwright/planar/loop_gap.h"

namespace linkwright::clearance {
namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};

double dot(const Complex& a, const Complex& b) { return a.real() * b.real() + a.imag() * b.imag(); }
double cross(const Complex& a, const Complex& b) { return a.real() * b.imag() - a.imag() * b.real(); }
Complex unit(double angle) { return {std::cos(angle), std::sin(angle)}; }
// Without the care that operator* takes of infinities.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
Complex perpendicular(const Complex& a) { return {-a.imag(), a.real()}; }

void require_mass(const planar::BodyMass& m, const char* name) {
  LINKWRIGHT_REQUIRE(m.mass >= 0 && std::isfinite(m.mass) && m.inertia >= 0 && std::isfinite(m.inertia) &&
                         std::isfinite(m.centre.real()) && std::isfinite(m.centre.imag()),
                     "{}: mass {} kg, inertia {} kg m2, centre ({}, {}) m", name, m.mass, m.inertia,
                     m.centre.real(), m.centre.imag());
}

}  // namespace

void require_valid(const ClearanceFourBar& model) {
  const planar::FourBar& l = model.linkage;
  planar::require_lengths(l);
  const double shortest = std::min({l.ground, l.crank, l.coupler, l.rocker});
  LINKWRIGHT_REQUIRE(model.clearance >= 0 && model.clearance < shortest,
                     "clearance {} m must be at least 0 and less than the shortest link, {} m",
                     model.clearance, shortest);
  for (const double number : {l.coupler_u, l.coupler_v, l.pivot_x, l.pivot_y, l.frame_angle,
                              model.gravity.real(), model.gravity.imag()})
    LINKWRIGHT_REQUIRE(std::isfinite(number), "a number of the linkage is {}", number);
  require_mass(model.coupler, "coupler");
  require_mass(model.rocker, "rocker");
  for (const double c : {model.coupler_damping, model.rocker_damping, model.link_damping})
    LINKWRIGHT_REQUIRE(c >= 0 && std::isfinite(c), "damping {} N m s must be at least 0", c);
}

bool turns_fully(const ClearanceFourBar& model) {
  const planar::FourBar& l = model.linkage;
  const double r = model.clearance;
  // Distance of A' from O4 over all angles: from |L1 - L2| - r to L1 + L2 + r.
  return l.ground + l.crank + r < l.coupler + l.rocker &&
         std::abs(l.ground - l.crank) - r > std::abs(l.coupler - l.rocker);
}

ClearancePosition clearance_position(const ClearanceFourBar& model, double crank_angle, double link_angle) {
  const planar::FourBar& l = model.linkage;
  ClearancePosition p;
  const Complex pivot{l.pivot_x, l.pivot_y};
  const Complex arm = l.crank * unit(crank_angle);
  const Complex way = model.clearance > 0 ? arm + model.clearance * unit(link_angle) : arm;
  const Complex ground = l.ground * unit(l.frame_angle);
  p.pin = pivot + arm;
  p.bush = pivot + way;
  p.gap = planar::loop_gap(std::abs(ground - way), l.coupler, l.rocker);
  const planar::Closure<double> closure = planar::close_loop(ground.real(), ground.imag(), way.real(),
                                                             way.imag(), l.coupler, l.rocker, sign(l.branch));
  if (p.gap > 0) {
    p.status = Status::no_assembly;
    return p;
  }
  const math::Vec2 d = planar::coupler_direction(closure, l.coupler);
  const Complex along = Complex{d.x, d.y} / std::hypot(d.x, d.y);
  p.joint = p.bush + l.coupler * along;
  p.point = p.bush + times(along, {l.coupler_u, l.coupler_v});
  p.coupler_angle = std::arg(along);
  const Complex rocker = way + l.coupler * along - ground;
  p.rocker_angle = std::arg(rocker);
  p.sine = -cross(along, rocker) / std::abs(rocker);
  if (!(std::abs(p.sine) >= singular_sine)) p.status = Status::singular;
  return p;
}

ClearanceInfluence clearance_influence(const ClearanceFourBar& model, const ClearancePosition& p,
                                       double crank_angle, double link_angle) {
  const planar::FourBar& l = model.linkage;
  const double a3 = 1 / (l.coupler * p.sine), a4 = 1 / (l.rocker * p.sine);
  return {-model.clearance * std::sin(link_angle - p.rocker_angle) * a3,
          -model.clearance * std::sin(link_angle - p.coupler_angle) * a4,
          -l.crank * std::sin(crank_angle - p.rocker_angle) * a3,
          -l.crank * std::sin(crank_angle - p.coupler_angle) * a4};
}

ClearanceInstant clearance_instant(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                                   double crank_acceleration, const LinkState& link) {
  const planar::FourBar& l = model.linkage;
  ClearanceInstant out;
  out.position = clearance_position(model, crank_angle, link.angle);
  const ClearancePosition& p = out.position;
  out.status = p.status;
  if (p.status != Status::done) return out;

  const bool ideal = model.clearance == 0;
  const double link_rate = ideal ? 0 : link.rate;
  const ClearanceInfluence by = clearance_influence(model, p, crank_angle, link.angle);
  const Complex e2 = unit(crank_angle), eg = unit(link.angle), e3 = unit(p.coupler_angle),
                e4 = unit(p.rocker_angle);
  const double w3 = by.coupler_by_crank * crank_rate + by.coupler_by_link * link_rate;
  const double w4 = by.rocker_by_crank * crank_rate + by.rocker_by_link * link_rate;
  out.coupler_rate = w3;
  out.rocker_rate = w4;

  // Accelerations without that of the link.
  const Complex crank_part = times(l.crank * e2, {-crank_rate * crank_rate, crank_acceleration});
  const Complex link_part = -model.clearance * link_rate * link_rate * eg;
  const Complex bias = crank_part + link_part - l.coupler * w3 * w3 * e3 + l.rocker * w4 * w4 * e4;
  const double a3 = dot(bias, e4) / (l.coupler * p.sine), a4 = dot(bias, e3) / (l.rocker * p.sine);

  const planar::BodyMass &m3 = model.coupler, &m4 = model.rocker;
  const Complex c3 = times(m3.centre, e3), c4 = times(m4.centre, e4);
  const Complex bush_by_link = model.clearance * perpendicular(eg);
  const Complex g3_by = bush_by_link + by.coupler_by_link * perpendicular(c3),
                g4_by = by.rocker_by_link * perpendicular(c4);
  const Complex b3 = crank_part + link_part + times(c3, {-w3 * w3, a3}), b4 = times(c4, {-w4 * w4, a4});

  double acceleration = 0;
  if (!ideal) {
    out.link_inertia = m3.inertia * by.coupler_by_link * by.coupler_by_link +
                       m4.inertia * by.rocker_by_link * by.rocker_by_link + m3.mass * std::norm(g3_by) +
                       m4.mass * std::norm(g4_by);
    const double rest = m3.inertia * by.coupler_by_link * a3 + m4.inertia * by.rocker_by_link * a4 +
                        m3.mass * dot(g3_by, b3 - model.gravity) + m4.mass * dot(g4_by, b4 - model.gravity) +
                        model.coupler_damping * w3 * by.coupler_by_link +
                        model.rocker_damping * w4 * by.rocker_by_link + model.link_damping * link_rate;
    if (!(out.link_inertia > 0)) {
      out.status = Status::singular;
      return out;
    }
    acceleration = -rest / out.link_inertia;
  } else {
    out.link_inertia = 0;
  }
  out.link_acceleration = acceleration;
  out.coupler_acceleration = a3 + by.coupler_by_link * acceleration;
  out.rocker_acceleration = a4 + by.rocker_by_link * acceleration;

  const Complex arm = times(e3, {l.coupler_u, l.coupler_v});
  out.bush_velocity =
      l.crank * crank_rate * perpendicular(e2) + model.clearance * link_rate * perpendicular(eg);
  out.point_velocity = out.bush_velocity + w3 * perpendicular(arm);
  out.point_acceleration =
      crank_part + link_part + acceleration * bush_by_link + times(arm, {-w3 * w3, out.coupler_acceleration});

  // The demand of the links: forces at the mass centres, moments about A' and O4.
  const Complex f3 = m3.mass * (b3 + acceleration * g3_by - model.gravity);
  const Complex f4 = m4.mass * (b4 + acceleration * g4_by - model.gravity);
  const double t3 = m3.inertia * out.coupler_acceleration + cross(c3, f3) + model.coupler_damping * w3;
  const double t4 = m4.inertia * out.rocker_acceleration + cross(c4, f4) + model.rocker_damping * w4;
  // L3 e3 x F = t3 and L4 e4 x F = -t4, with cross(e4, e3) = sine.
  out.joint_force = (t3 / l.coupler * e4 + t4 / l.rocker * e3) / -p.sine;
  out.pin_force = f3 - out.joint_force;
  out.pivot_force = f4 + out.joint_force;
  out.tension = ideal ? std::abs(out.pin_force) : -dot(out.pin_force, eg);
  out.tangential = ideal ? 0 : dot(out.pin_force, perpendicular(eg));
  out.drive_torque = l.crank * cross(e2, out.pin_force);
  return out;
}

double force_direction(const ClearanceFourBar& model, double crank_angle, double crank_rate,
                       double crank_acceleration) {
  ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  const ClearanceInstant now = clearance_instant(ideal, crank_angle, crank_rate, crank_acceleration, {});
  if (now.status != Status::done || now.pin_force == Complex{0, 0}) return nan;
  return std::arg(-now.pin_force);
}

}  // namespace linkwright::clearance
