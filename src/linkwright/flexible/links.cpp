// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/links.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::flexible {

namespace {

Chain outer_chain(const Chain& inner, const Beam& outer, int divisions) {
  LINKWRIGHT_REQUIRE(inner.kinematics != Kinematics::source_linearised,
                     "source_linearised has one link only");
  LINKWRIGHT_REQUIRE(outer.hub_radius == 0 && outer.hub_inertia == 0 && outer.hub_stiffness == 0 &&
                         outer.hub_damping == 0 && outer.gravity == 0,
                     "hub and gravity belong to the first link");
  LINKWRIGHT_REQUIRE(
      outer.mass_damping == inner.mass_damping && outer.stiffness_damping == inner.stiffness_damping &&
          outer.extensible == inner.extensible,
      "links in a row share damping {} 1/s, {} s and extension", inner.mass_damping, inner.stiffness_damping);
  return discretise(outer, divisions, inner.kinematics);
}

void add_cells(Chain& chain, const Chain& outer) {
  chain.cells.insert(chain.cells.end(), outer.cells.begin(), outer.cells.end());
}

}  // namespace

Chain weld(const Chain& inner, const Beam& outer, int divisions) {
  const Chain next = outer_chain(inner, outer, divisions);
  Chain out = inner;
  out.cells.back().mass += next.root_mass;
  out.cells.back().inertia += next.root_inertia;
  add_cells(out, next);
  return out;
}

Chain hinge(const Chain& inner, const Hinge& joint, const Beam& outer, int divisions) {
  for (const double value :
       {joint.stiffness, joint.damping, joint.mass, joint.inner_inertia, joint.outer_inertia})
    LINKWRIGHT_REQUIRE(value >= 0 && std::isfinite(value), "{} at a hinge: it must not be negative", value);
  const Chain next = outer_chain(inner, outer, divisions);
  Chain out = inner;
  out.cells.back().inertia += joint.inner_inertia;
  out.cells.push_back({.bending = joint.stiffness,
                       .mass = next.root_mass + joint.mass,
                       .inertia = next.root_inertia + joint.outer_inertia,
                       .damping = joint.damping,
                       .hinge = true});
  add_cells(out, next);
  return out;
}

std::vector<std::size_t> hinges(const Chain& chain) {
  std::vector<std::size_t> out;
  for (std::size_t s = 0; s < chain.cells.size(); ++s)
    if (chain.cells[s].hinge) out.push_back(s);
  return out;
}

}  // namespace linkwright::flexible
