// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <complex>
#include <string_view>

#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/four_bars.h"
#include "support/published.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

using linkwright::test::at;
using linkwright::test::number_at;

inline const Value& dynamics_case(std::string_view id) {
  return linkwright::test::published_case("planar-dynamics-balancing.json", id);
}

/// A four-bar in the notation of the published designs: L1 crank ... L4 ground.
struct Machine {
  FourBar linkage;
  FourBarMasses masses;
};
inline Machine machine(const Value& d) {
  Machine m;
  m.linkage = {.ground = number_at(d, "L4_m"),
               .crank = number_at(d, "L1_m"),
               .coupler = number_at(d, "L2_m"),
               .rocker = number_at(d, "L3_m")};
  m.masses.crank = {number_at(d, "m1_kg"), number_at(d, "J_C1_kg_m2"), number_at(d, "d1_m"),
                    number_at(d, "alpha1_rad")};
  m.masses.coupler = {number_at(d, "m2_kg"), number_at(d, "J_C2_kg_m2"), number_at(d, "d2_m"),
                      number_at(d, "alpha2_rad")};
  m.masses.rocker = {number_at(d, "m3_kg"), number_at(d, "J_C3_kg_m2"), number_at(d, "d3_m"),
                     number_at(d, "alpha3_rad")};
  return m;
}

/// The thirteen quantities of the published tables.
inline constexpr std::array<std::string_view, 13> quantity_names = {"X_O1",
                                                                    "Y_O1",
                                                                    "X_O2",
                                                                    "Y_O2",
                                                                    "X_O3",
                                                                    "Y_O3",
                                                                    "X_O4",
                                                                    "Y_O4",
                                                                    "M_1",
                                                                    "F_shx",
                                                                    "F_shy",
                                                                    "M_sh",
                                                                    "M_sh_forces_only"};
inline std::array<double, 13> quantities(const FourBarReactions& r) {
  return {r.ground_on_crank.real(),  r.ground_on_crank.imag(),   r.crank_on_coupler.real(),
          r.crank_on_coupler.imag(), r.rocker_on_coupler.real(), r.rocker_on_coupler.imag(),
          r.ground_on_rocker.real(), r.ground_on_rocker.imag(),  r.drive_torque,
          r.shaking_force.real(),    r.shaking_force.imag(),     r.shaking_moment_with_drive,
          r.shaking_moment};
}
inline double largest_force(const FourBarReactions& r) {
  return std::max({std::abs(r.ground_on_crank), std::abs(r.crank_on_coupler), std::abs(r.rocker_on_coupler),
                   std::abs(r.ground_on_rocker)});
}

inline rc::Gen<LinkMass> any_mass() {
  return rc::gen::build<LinkMass>(rc::gen::set(&LinkMass::mass, between(0, 5)),
                                  rc::gen::set(&LinkMass::inertia, between(0, 2)),
                                  rc::gen::set(&LinkMass::centre_distance, between(0, 3)),
                                  rc::gen::set(&LinkMass::centre_angle, any_angle()));
}
inline rc::Gen<FourBarMasses> any_masses() {
  return rc::gen::build<FourBarMasses>(rc::gen::set(&FourBarMasses::crank, any_mass()),
                                       rc::gen::set(&FourBarMasses::coupler, any_mass()),
                                       rc::gen::set(&FourBarMasses::rocker, any_mass()));
}

}  // namespace linkwright::planar::test

namespace linkwright::planar {

inline void showValue(const FourBarMasses& masses, std::ostream& out) {
  for (const LinkMass* m : {&masses.crank, &masses.coupler, &masses.rocker})
    out << "{mass " << m->mass << ", inertia " << m->inertia << ", centre " << m->centre_distance << ", "
        << m->centre_angle << "} ";
}

}  // namespace linkwright::planar
