// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/chain.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/flexible/joint_kernel.h"

namespace linkwright::flexible {

double Chain::length() const {
  double sum = 0;
  for (const Cell& cell : cells) sum += cell.length;
  return sum;
}

ChainState state_at_rest(const Chain& chain) {
  const std::size_t n = coordinates_per_cell * chain.cells.size();
  return {.q = std::vector<double>(n), .v = std::vector<double>(n), .a = std::vector<double>(n)};
}

Chain discretise(const Beam& beam, int divisions, Kinematics kinematics) {
  const auto found = problem(beam);
  LINKWRIGHT_REQUIRE(!found, "{}", *found);
  LINKWRIGHT_REQUIRE(divisions >= 1, "{} divisions: at least 1", divisions);
  const bool printed = kinematics == Kinematics::source_linearised;
  LINKWRIGHT_REQUIRE(!printed || (!beam.extensible && beam.gravity == 0 && beam.mass_damping == 0 &&
                                  beam.stiffness_damping == 0),
                     "source_linearised has no gravity, damping or springs along the link");

  const int count = 2 * divisions;
  const double l = beam.length / count;
  const double bending = beam.bending_stiffness();
  const double shear_ratio = 12 * bending / (beam.shear_stiffness() * l * l);  // Phi
  const double masses = beam.density * beam.area * beam.length / (6 * divisions);
  const double inertias = beam.rotary_inertia() * beam.length / (6 * divisions);

  Chain out{.kinematics = kinematics,
            .hub_radius = beam.hub_radius,
            .hub_inertia = beam.hub_inertia,
            .root_mass = masses,
            .root_inertia = inertias,
            .extensible = beam.extensible,
            .mass_damping = beam.mass_damping,
            .stiffness_damping = beam.stiffness_damping,
            .hub_stiffness = beam.hub_stiffness,
            .hub_damping = beam.hub_damping,
            .gravity = beam.gravity};
  out.cells.resize(count);
  for (int i = 1; i <= count; ++i) {
    const double weight = i % 2 ? 4 : i < count ? 2 : 1;  // Simpson's rule, in sixths
    out.cells[i - 1] = {.length = l,
                        .shortening = 0.5 + 0.1 / ((1 + shear_ratio) * (1 + shear_ratio)),
                        .shear = 12 * bending / (l * l * l * (1 + shear_ratio)),
                        .bending = bending / l,
                        .axial = beam.elastic_modulus * beam.area / l,
                        .mass = weight * masses,
                        .inertia = weight * inertias};
  }
  out.cells.back().mass += beam.tip_mass;
  out.cells.back().inertia += beam.tip_inertia;
  return out;
}

ChainShape shape(const Chain& chain, std::span<const double> q) {
  LINKWRIGHT_REQUIRE(q.size() == coordinates_per_cell * chain.cells.size(), "{} coordinates for {} cells",
                     q.size(), chain.cells.size());
  ChainShape out;
  out.node = {{chain.hub_radius, 0}};
  out.angle = {0};
  math::Vec2 direction{1, 0};
  for (std::size_t s = 0; s < chain.cells.size(); ++s) {
    const JointStep step = joint_step(chain.kinematics, chain.cells[s], &q[coordinates_per_cell * s]);
    out.node.push_back(out.node.back() + step.displacement(direction, out.angle.back()));
    out.angle.push_back(out.angle.back() + q[coordinates_per_cell * s + turn]);
    direction = rotate(step.half, rotate(step.half, direction));
  }
  return out;
}

double largest_kink(const Chain& chain, std::span<const double> q) {
  double most = 0;
  for (std::size_t s = 0; s < chain.cells.size(); ++s)
    if (!chain.cells[s].hinge) most = std::max(most, std::abs(q[coordinates_per_cell * s + turn]));
  return most;
}

}  // namespace linkwright::flexible
