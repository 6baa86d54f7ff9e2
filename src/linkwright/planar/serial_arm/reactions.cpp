// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {
namespace {

double cross(std::complex<double> a, std::complex<double> b) {
  return a.real() * b.imag() - a.imag() * b.real();
}
double dot(std::complex<double> a, std::complex<double> b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
// Products without the care that std::complex takes of infinities.
std::complex<double> turned(std::complex<double> a, std::complex<double> direction) {
  return {a.real() * direction.real() - a.imag() * direction.imag(),
          a.real() * direction.imag() + a.imag() * direction.real()};
}
// (i epsilon - omega^2) v
std::complex<double> spun(const ArmLinkRates& r, std::complex<double> v) {
  const double w = r.speed * r.speed, e = r.acceleration;
  return {-e * v.imag() - w * v.real(), e * v.real() - w * v.imag()};
}

}  // namespace

void reactions(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity,
               std::span<ArmJointLoads> loads) {
  LINKWRIGHT_REQUIRE(rates.size() == arm.size() && loads.size() == arm.size(),
                     "{} rates and {} loads for {} links", rates.size(), loads.size(), arm.size());
  LINKWRIGHT_REQUIRE(std::isfinite(gravity), "gravity {} must be finite", gravity);
  std::complex<double> outer = 0;  // force on the next link in its own joint
  double torque = 0;
  for (std::size_t k = arm.size(); k-- > 0;) {
    const BaseParameters& b = arm[k].base;
    const ArmLinkRates& r = rates[k];
    const std::complex<double> moment = turned(b.moment, r.direction);
    const std::complex<double> felt = r.joint.acceleration + std::complex<double>(0, gravity);
    const double q =
        b.inertia * r.acceleration + cross(moment, felt) + cross(arm[k].length * r.direction, outer);
    outer += b.mass * felt + spun(r, moment);
    torque += q;
    loads[k] = {outer, q, torque};
  }
}

ArmEnergy energy(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity) {
  LINKWRIGHT_REQUIRE(rates.size() == arm.size(), "{} rates for {} links", rates.size(), arm.size());
  ArmEnergy sum;
  for (std::size_t k = 0; k < arm.size(); ++k) {
    const BaseParameters& b = arm[k].base;
    const ArmLinkRates& r = rates[k];
    const std::complex<double> moment = turned(b.moment, r.direction);
    sum.kinetic += b.mass * std::norm(r.joint.velocity) / 2 + r.speed * cross(moment, r.joint.velocity) +
                   b.inertia * r.speed * r.speed / 2;
    sum.potential += gravity * (b.mass * r.joint.position.imag() + moment.imag());
  }
  return sum;
}

double energy_rate(std::span<const ArmElement> arm, std::span<const ArmLinkRates> rates, double gravity) {
  LINKWRIGHT_REQUIRE(rates.size() == arm.size(), "{} rates for {} links", rates.size(), arm.size());
  double sum = 0;
  for (std::size_t k = 0; k < arm.size(); ++k) {
    const BaseParameters& b = arm[k].base;
    const ArmLinkRates& r = rates[k];
    const std::complex<double> moment = turned(b.moment, r.direction);
    sum += b.mass * dot(r.joint.velocity, r.joint.acceleration) +
           r.speed * cross(moment, r.joint.acceleration) + dot(r.joint.velocity, spun(r, moment)) +
           b.inertia * r.speed * r.acceleration +
           gravity * (b.mass * r.joint.velocity.imag() + r.speed * moment.real());
  }
  return sum;
}

SerialArm serial_arm(const TwoRods& arm) {
  SerialArm out;
  for (const TwoRods::Rod& rod : arm.rods)
    out.links.push_back({rod.length, {rod.mass, rod.inertia, rod.length / 2, 0}, {}});
  out.links[1].attached = {{arm.payload, arm.rods[1].length, 0}};
  return out;
}

std::array<ArmJointLoads, 2> reactions_redundant(const TwoRods& arm,
                                                 const std::array<math::Motion, 2>& motion) {
  for (const TwoRods::Rod& rod : arm.rods)
    LINKWRIGHT_REQUIRE(rod.length > 0 && rod.mass > 0 && rod.inertia >= 0,
                       "length {} and mass {} of a rod must be positive, its inertia {} not negative",
                       rod.length, rod.mass, rod.inertia);
  // Coordinates y = (x, y) of the masses 1, 2 of rod 1, of 3, 4 of rod 2 and of the payload. Distance of each
  // along rod 1 and rod 2:
  const auto pair = [&](std::size_t rod, double sign) {
    const TwoRods::Rod& r = arm.rods[rod];
    return r.length / 2 + sign * std::sqrt(r.inertia / r.mass);
  };
  const double l1 = arm.rods[0].length, l2 = arm.rods[1].length;
  const double along[5][2] = {
      {pair(0, -1), 0}, {pair(0, 1), 0}, {l1, pair(1, -1)}, {l1, pair(1, 1)}, {l1, l2}};
  const double masses[5] = {arm.rods[0].mass / 2, arm.rods[0].mass / 2, arm.rods[1].mass / 2,
                            arm.rods[1].mass / 2, arm.payload};
  Eigen::Matrix<double, 10, 2> B, B_dot;
  Eigen::Matrix<double, 10, 4> B1 = Eigen::Matrix<double, 10, 4>::Zero();
  Eigen::Matrix<double, 10, 1> M;
  for (int p = 0; p < 5; ++p) {
    for (int j = 0; j < 2; ++j) {
      const math::Motion& m = motion[static_cast<std::size_t>(j)];
      const double c = std::cos(m.value), s = std::sin(m.value), r = along[p][j];
      B(2 * p, j) = -r * s, B(2 * p + 1, j) = r * c;
      B_dot(2 * p, j) = -r * c * m.rate, B_dot(2 * p + 1, j) = -r * s * m.rate;
    }
    for (int k = 0; k < 2; ++k) {
      M(2 * p + k) = masses[p];
      B1(2 * p + k, k) = 1;                  // s1, s2: rod 1 against the ground moves everything
      if (p >= 2) B1(2 * p + k, 2 + k) = 1;  // s3, s4: rod 2 against rod 1
    }
  }
  using JointVector = Eigen::Matrix<double, 2, 1>;  // one entry a joint
  const JointVector rate(motion[0].rate, motion[1].rate),
      acceleration(motion[0].acceleration, motion[1].acceleration);
  const Eigen::Matrix<double, 10, 1> inertia = M.asDiagonal() * (B * acceleration + B_dot * rate);
  const Eigen::Vector4d multipliers = B1.transpose() * inertia;
  const JointVector torques = B.transpose() * inertia;
  return {ArmJointLoads{{multipliers[0], multipliers[1]}, torques[0], torques[0] + torques[1]},
          ArmJointLoads{{multipliers[2], multipliers[3]}, torques[1], torques[1]}};
}

}  // namespace linkwright::planar
